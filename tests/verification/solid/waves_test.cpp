// S6, S7 and S17 of theory/solid.md section 19: plane waves in cubes against the lattice formulas, surface waves.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/evidence.hpp"
#include "tests/support/linear_solid.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

constexpr Real pi = std::numbers::pi;

std::string short_number(Real x) { return std::to_string(x).substr(0, 5); }

/// A block of cubes in which the forces on the middle one know nothing of the sides: those of an unbounded lattice.
class Lattice {
 public:
  explicit Lattice(Real poisson_ratio, int dimension = 3) {
    SolidConfig config = testing::one_material(1, 1, poisson_ratio);
    std::array<Index, 3> cells{5, dimension > 1 ? 5 : 1, dimension > 2 ? 5 : 1};
    config.body.push_back(testing::box({-2.5, -2.5, -2.5}, {2.5, 2.5, 2.5}, cells));
    testing::Lone block(config, dimension);
    linear_ = testing::linearise(block.solid);
    Vec3 const middle{0, dimension > 1 ? 0 : 0.5, dimension > 2 ? 0 : 0.5};  // slabs lie in [0, 1]
    for (std::size_t s = 0; s < linear_.count(); ++s)
      if (norm(linear_.centre[s] - middle) < 0.1) middle_ = s;
  }
  /// omega^2 of all waves, ascending.
  Eigen::VectorXd eigenvalues(Vec3 const& wave_vector) const {
    return testing::bloch_waves(
        linear_, {middle_}, [](std::size_t) { return 0; }, wave_vector);
  }
  /// omega of the two S waves and the P wave, ascending.
  std::array<Real, 3> omega(Vec3 const& wave_vector) const {
    Eigen::VectorXd const omega2 = eigenvalues(wave_vector);
    return {std::sqrt(omega2(0)), std::sqrt(omega2(1)), std::sqrt(omega2(2))};
  }

 private:
  testing::LinearSolid linear_;
  std::size_t middle_ = 0;
};

/// Theory section 13.2 for h = rho = 1.
Real p_wave(Material const& m, Real k) {
  Real const s = std::sin(k / 2), c = std::cos(k / 2);
  return std::sqrt(4 * s * s * (2 * m.shear() + m.lame() * c * c));
}
Real s_wave(Material const& m, Real k) {
  Real const s = std::sin(k / 2), c = std::cos(k / 2), g = m.shear();
  // (8 G s2 - w)(d - w/6) = (4 G s c)^2
  Real const a = 8 * g * s * s, d = 2 * g * (1 + c * c) + m.young_modulus / 3 * s * s;
  Real const sum = 6 * d + a, product = 6 * (a * d - square(4 * g * s * c));
  return std::sqrt(0.5 * (sum - std::sqrt(sum * sum - 4 * product)));
}

TEST(PlaneWaves, FollowTheLatticeFormulasAlongTheAxes) {
  for (Real nu : {0.0, 0.25, 0.3, 0.45}) {
    Material const m{"m", 1, 1, nu};
    Lattice const lattice(nu);
    for (int cells : {10, 20, 40}) {
      Real const k = 2 * pi / cells;
      auto const omega = lattice.omega({k, 0, 0});
      std::string const variant = "[100] nu " + short_number(nu) + " " + std::to_string(cells) + " cells";
      EXPECT_TRUE(evidence::at_most("S6", "P wave", variant, "|omega / lattice formula - 1|",
                                    std::abs(omega[2] / p_wave(m, k) - 1), 1e-6));
      for (std::size_t polarisation : {0u, 1u})
        EXPECT_TRUE(evidence::at_most("S7", "S wave", variant + (polarisation ? " second" : " first"),
                                      "|omega / lattice formula - 1|", std::abs(omega[polarisation] / s_wave(m, k) - 1),
                                      1e-6));
    }
  }
}

TEST(PlaneWaves, AreTheSameInSlabs) {
  for (Real nu : {-0.9, 0.3, 0.49}) {
    Material const m{"m", 1, 1, nu};
    Real const k = 2 * pi / 20;
    std::string const variant = "[100] nu " + short_number(nu) + " 20 cells";
    // Ascending: in 1D the P wave alone, in 2D the S wave of the plane and the P wave.
    auto const line = Lattice(nu, 1).eigenvalues({k, 0, 0}), plane = Lattice(nu, 2).eigenvalues({k, 0, 0});
    EXPECT_TRUE(evidence::at_most("S6", "P wave", "1D " + variant, "|omega / lattice formula - 1|",
                                  std::abs(std::sqrt(line(0)) / p_wave(m, k) - 1), 1e-6));
    EXPECT_TRUE(evidence::at_most("S6", "P wave", "2D " + variant, "|omega / lattice formula - 1|",
                                  std::abs(std::sqrt(plane(1)) / p_wave(m, k) - 1), 1e-6));
    EXPECT_TRUE(evidence::at_most("S7", "S wave", "2D " + variant, "|omega / lattice formula - 1|",
                                  std::abs(std::sqrt(plane(0)) / s_wave(m, k) - 1), 1e-6));
  }
}

TEST(PlaneWaves, AreFastOrSlowByTheCoefficientsOfTheTable) {
  struct Row {
    Real nu, p, s100, s110_low, s110_high, s111;
  };
  for (Row const& row : {Row{0.25, -1.0 / 24 - 0.25 / 6, 0.0260, -0.0156, 0.0130, -0.0104},
                         Row{0.3, -1.0 / 24 - 0.3 / 5.6, 0.0271, -0.0146, 0.0135, -0.0097}}) {
    Material const m{"m", 1, 1, row.nu};
    Lattice const lattice(row.nu);
    Real const c_p = std::sqrt(m.lame() + 2 * m.shear()), c_s = std::sqrt(m.shear());
    struct Direction {
      char const* name;
      Vec3 along;
      std::array<Real, 3> expected;
    };
    for (Direction const& d : {Direction{"[100]", {1, 0, 0}, {row.s100, row.s100, row.p}},
                               Direction{"[110]", {1, 1, 0}, {row.s110_low, row.s110_high, row.p / 2}},
                               Direction{"[111]", {1, 1, 1}, {row.s111, row.s111, row.p / 3}}}) {
      Real const k = 0.03;
      auto const omega = lattice.omega(k * normalized(d.along));
      for (std::size_t w = 0; w < 3; ++w) {
        Real const coefficient = (omega[w] / (k * (w < 2 ? c_s : c_p)) - 1) / (k * k);
        // The table has four decimals: half of the last one is added to its 1 %.
        EXPECT_TRUE(evidence::near(w < 2 ? "S7" : "S6", w < 2 ? "S wave" : "P wave",
                                   std::string(d.name) + " nu " + short_number(row.nu) +
                                       (w == 0   ? " first"
                                        : w == 1 ? " second"
                                                 : ""),
                                   "speed error / (k h)^2", coefficient, d.expected[w],
                                   0.01 * std::abs(d.expected[w]) + (w < 2 ? 5e-5 : 0)));
      }
    }
  }
}

/// Lowest wave along x of a strip 60 cells deep, free above and clamped below; in 2D (plane strain) or 3D.
Real surface_speed(Real poisson_ratio, int dimension, int cells_per_wavelength) {
  Index const depth = 3 * cells_per_wavelength, wide = dimension == 3 ? 5 : 1;
  // The depth along y, so that the strip is the same in 2D.
  SolidConfig config = testing::one_material(1, 1, poisson_ratio);
  config.body.push_back(
      testing::box({0, 0, 0}, {5, static_cast<Real>(depth), static_cast<Real>(wide)}, {5, depth, wide}));
  config.body[0].clamp.push_back({{0, 0, 0}, {5, 0, static_cast<Real>(wide)}});
  testing::Lone strip(config, dimension);
  auto const linear = testing::linearise(strip.solid);
  std::vector<std::size_t> column(static_cast<std::size_t>(depth));
  for (std::size_t s = 0; s < linear.count(); ++s) {
    Vec3 const& x = linear.centre[s];
    if (std::abs(x.x - 2.5) < 0.1 && std::abs(x.z - 0.5 * wide) < 0.1) column[static_cast<std::size_t>(x.y)] = s;
  }
  Real const k = 2 * pi / cells_per_wavelength;
  auto const omega2 = testing::bloch_waves(
      linear, column, [&](std::size_t s) { return static_cast<int>(linear.centre[s].y); }, {k, 0, 0});
  return std::sqrt(omega2(0)) / k;
}

TEST(SurfaceWave, RunsAtTheSpeedOfRayleigh) {
  struct Row {
    Real nu, speed;
  };
  for (Row const& row : {Row{0, 0.874032}, Row{0.25, 0.919402}, Row{0.3, 0.927413}, Row{1.0 / 3, 0.932526},
                         Row{0.45, 0.948960}, Row{-0.5, 0.774239}}) {
    Real const c_s = std::sqrt(Material{"m", 1, 1, row.nu}.shear());
    auto check = [&](int dimension, int cells) {
      Real const speed = surface_speed(row.nu, dimension, cells) / c_s;
      EXPECT_TRUE(evidence::near("S17", "Rayleigh wave",
                                 std::to_string(dimension) + "D nu " + short_number(row.nu) + " " +
                                     std::to_string(cells) + " cells per wavelength",
                                 "c_R / c_s", speed, row.speed, 0.01 * row.speed));
      return std::abs(speed - row.speed);
    };
    Real const coarse = check(2, 20);
    if (row.nu == 0.25 || evidence::full()) check(3, 20);
    if (row.nu == 0.25 || evidence::full()) {
      EXPECT_TRUE(evidence::at_most("S17", "Rayleigh wave", "2D nu " + short_number(row.nu),
                                    "error at 40 / at 20 cells", check(2, 40) / coarse, 1 / 3.3));
    }
  }
}

}  // namespace
}  // namespace brisance::solid
