// Small solids for tests.
#pragma once
#include "core/solid/solid.hpp"
#include "core/solid/surface.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::testing {

inline solid::SolidConfig one_material(Real density, Real young_modulus, Real poisson_ratio) {
  solid::SolidConfig config;
  config.material["m"] = {density, young_modulus, poisson_ratio, {}};
  config.links.emplace();
  return config;
}

inline solid::BodyConfig box(Vec3 const& low, Vec3 const& high, std::array<Index, 3> const& cells) {
  solid::BodyConfig body;
  body.material = "m";
  body.low = low;
  body.high = high;
  body.cells = cells;
  return body;
}

/// All particles on this rank when `ranks` is 1, else dealt along the numbering.
inline std::vector<int> slices(solid::Mesh const& mesh, int ranks) {
  std::vector<int> owner;
  for (GlobalId p = 0; p < mesh.size(); ++p) owner.push_back(static_cast<int>(p * ranks / mesh.size()));
  return owner;
}

/// A solid on one rank, with its mesh.
struct Lone {
  solid::Mesh mesh;
  std::unique_ptr<parallel::Comm> comm = parallel::serial();
  solid::Solid solid;
  explicit Lone(solid::SolidConfig const& config, int dimension = 3)
      : mesh(solid::build_mesh(config, dimension)), solid(mesh, config, slices(mesh, 1), *comm, dimension) {}

  solid::Measures measure() const {
    solid::Measures m;
    solid.measure(m);
    return m;
  }
  Real energy() const {
    auto const m = measure();
    return m.value(solid::Measures::kinetic) + m.value(solid::Measures::elastic);
  }
};

/// Uniform in [-1, 1], the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  Real operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<Real>(state_ >> 11) * 0x1p-52 - 1;
  }
  Vec3 vector() {
    Real const x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::uint64_t state_;
};

/// Rotation by the vector `r` (rad).
inline Quaternion rotation(Vec3 const& r) {
  Real const angle = norm(r);
  if (angle == 0) return {};
  return {std::cos(angle / 2), (std::sin(angle / 2) / angle) * r};
}

}  // namespace brisance::testing
