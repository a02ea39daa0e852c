// The patch test on meshes that are not orthogonal: tetrahedra with their mass centres as poles deviate by some per
// cent, whatever their size (theory/solid.md section 9).
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/evidence.hpp"
#include "tests/support/uniaxial.hpp"

namespace brisance::solid {
namespace {

/// A box in the format OFF, for the product to fill with Delaunay tetrahedra.
void write_box(std::string const& path, Vec3 const& half) {
  std::ofstream file(path);
  file << "OFF\n8 12 0\n";
  for (int c = 0; c < 8; ++c)
    file << (c & 1 ? half.x : -half.x) << ' ' << (c & 2 ? half.y : -half.y) << ' ' << (c & 4 ? half.z : -half.z)
         << '\n';
  for (auto const& q : {std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}, std::array{0, 1, 5, 4}, std::array{2, 6, 7, 3},
                        std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}}) {
    file << "3 " << q[0] << ' ' << q[1] << ' ' << q[2] << '\n';
    file << "3 " << q[0] << ' ' << q[2] << ' ' << q[3] << '\n';
  }
}

/// The same box as regular bricks of six tetrahedra each, nodes jittered, in the format of Gmsh 2.2.
void write_gmsh(std::string const& path, Vec3 const& half, std::array<int, 3> const& n, Real jitter) {
  std::ofstream file(path);
  file.precision(17);
  auto id = [&](int i, int j, int k) { return 1 + i + (n[0] + 1) * (j + (n[1] + 1) * k); };
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << (n[0] + 1) * (n[1] + 1) * (n[2] + 1) << '\n';
  testing::Random random(5);
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) {
        std::array<int, 3> const at{i, j, k};
        Vec3 x, off = random.vector();
        for (int d = 0; d < 3; ++d) {
          auto const e = static_cast<std::size_t>(d);
          bool const inner = at[e] > 0 && at[e] < n[e];
          x[d] = half[d] * (2 * (at[e] + (inner ? jitter * off[d] : 0)) / n[e] - 1);
        }
        file << id(i, j, k) << ' ' << x.x << ' ' << x.y << ' ' << x.z << '\n';
      }
  file << "$EndNodes\n$Elements\n" << 6 * n[0] * n[1] * n[2] << '\n';
  int element = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        // From corner 000 to 111 along the edges, in all six orders of the axes.
        for (auto const& order : {std::array{0, 1, 2}, std::array{1, 2, 0}, std::array{2, 0, 1}, std::array{0, 2, 1},
                                  std::array{2, 1, 0}, std::array{1, 0, 2}}) {
          std::array<int, 3> at{i, j, k};
          std::array<int, 4> node{id(i, j, k)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[static_cast<std::size_t>(order[step])];
            node[step + 1] = id(at[0], at[1], at[2]);
          }
          if ((order[1] - order[0] + 3) % 3 == 2) std::swap(node[1], node[2]);  // an odd order turns it inside out
          file << ++element << " 4 2 0 1 " << node[0] << ' ' << node[1] << ' ' << node[2] << ' ' << node[3] << '\n';
        }
  file << "$EndElements\n";
}

TEST(Tetrahedra, DeviateFromHookeBySomePerCent) {
  Vec3 const half{2, 0.5, 0.5};
  auto const folder = std::filesystem::temp_directory_path() / "brisance-tetrahedra-test";
  std::filesystem::create_directories(folder);
  std::string const surface = (folder / "box.off").string(), elements = (folder / "box.msh").string();
  write_box(surface, half);
  write_gmsh(elements, half, {12, 3, 3}, 0.15);
  for (std::string const& path : {elements, surface})
    for (Real nu : {-0.9, 0.0, 0.3, 0.49}) {
      SolidConfig config = testing::one_material(1, 1, nu);
      BodyConfig body;
      body.material = "m";
      body.shape = "mesh";
      body.mesh.emplace();
      body.mesh->file = path;
      if (path == surface) {
        body.tessellation = "tetrahedra";
        body.particles = 1500;
      }
      config.body.push_back(body);
      testing::Lone bar(config);
      testing::AffineFit const fit = testing::small_strain(bar, -half.x, half.x);
      std::string const variant = (path == surface ? "Delaunay tetrahedra nu " : "bricks of six tetrahedra nu ") +
                                  std::to_string(nu).substr(0, 5);
      // What is known are periodic meshes: E + 3.2 % and nu_eff 0.294 at nu = 0.3. The bounds are about twice what bars
      // of some hundred cells show; beyond moderate ratios such meshes are not for use, which `check` tells.
      bool const moderate = nu > -0.5 && nu < 0.45;
      EXPECT_TRUE(evidence::near("S5", "patch test", variant, "E e_xx / sigma - 1", fit.gradient[0][0] - 1, 0,
                                 moderate ? 0.07 : 0.3));
      EXPECT_TRUE(evidence::near("S5", "patch test", variant, "-e_yy / e_xx - nu",
                                 -0.5 * (fit.gradient[1][1] + fit.gradient[2][2]) / fit.gradient[0][0] - nu, 0,
                                 moderate ? 0.05 : 0.2));
    }
}

}  // namespace
}  // namespace brisance::solid
