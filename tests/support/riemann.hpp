// Exact solution of the Riemann problem of gases with a reference curve (ideal, stiffened, JWL), vacuum included, and
// its cell means.
#pragma once
#include <vector>

#include "fluid/gas/gas.hpp"

namespace brisance::testing {

struct Primitive {
  double density, velocity, pressure;
};

/// The states one wave can leave behind it. With phi = internal energy above the reference curve, isentropes are
/// phi = K rho^(Gamma+1), because the curve itself is one; the shock adiabat gives the pressure as a function of
/// density.
class WaveCurve {
 public:
  /// `sign`: -1 for the wave that runs to the left, +1 to the right.
  WaveCurve(Primitive ahead, fluid::Gas const& gas, double sign);
  bool empty() const { return !(ahead_.density > 0); }
  Primitive const& ahead() const { return ahead_; }
  /// Pressure of the gas when it has expanded to density 0, Pa.
  double floor() const { return gas_.reference_pressure(0); }
  /// Density and velocity behind the wave that leads to this pressure.
  Primitive behind(double pressure) const;
  /// State in the fan where its characteristic has this speed; `behind` is its end.
  Primitive fan(double speed) const;
  /// Speed of the shock or of the head of the fan that leads to `behind`, and where that wave ends.
  double head(Primitive const& behind) const;
  double tail(Primitive const& behind) const;

 private:
  // Along the isentrope s = (density / density ahead)^(Gamma/2) in [0, 1]: the sound speed is s times a smooth
  // function.
  double density(double s) const;
  double sound(double s) const;
  double velocity(double s) const;
  double pressure(double s) const;
  double shock_pressure(double density) const;
  bool shock(Primitive const& behind) const { return behind.pressure > ahead_.pressure; }

  Primitive ahead_;
  fluid::Gas gas_;
  double sign_, isentrope_ = 0;  // K
};

/// Source: Toro 1999, chapter 4; theory/fluid.md 1.2. A side of density 0 is vacuum. A vacuum opens when both gases
/// have reached their lowest common pressure and still part.
class RiemannProblem {
 public:
  RiemannProblem(Primitive left, Primitive right, fluid::Gas const& gas) : RiemannProblem(left, right, gas, gas) {}
  RiemannProblem(Primitive left, Primitive right, fluid::Gas const& left_gas, fluid::Gas const& right_gas);
  RiemannProblem(Primitive left, Primitive right, double gamma);
  bool vacuum() const { return vacuum_; }
  double star_pressure() const { return left_star_.pressure; }
  double star_velocity() const { return left_star_.velocity; }
  double left_density() const { return left_star_.density; }    ///< between left wave and contact
  double right_density() const { return right_star_.density; }  ///< between contact and right wave
  /// State on the ray x/t = speed.
  Primitive at(double speed) const;
  /// Speeds between which the solution is smooth, in increasing order.
  std::vector<double> breaks() const;
  /// Mean density over [low, high] at time t, the jump having stood at 0: Gauss quadrature between the breaks.
  double mean_density(double low, double high, double t) const;

 private:
  WaveCurve left_, right_;
  bool vacuum_ = false;
  Primitive left_star_{}, right_star_{};
};

}  // namespace brisance::testing
