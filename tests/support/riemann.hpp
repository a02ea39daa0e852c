// Exact solution of the Riemann problem of an ideal gas, vacuum included, and its cell means.
#pragma once
#include <vector>

namespace brisance::testing {

struct Primitive {
  double density, velocity, pressure;
};

/// Source: Toro 1999, chapter 4. A side of density 0 is vacuum.
class RiemannProblem {
 public:
  RiemannProblem(Primitive left, Primitive right, double gamma);
  double star_pressure() const { return star_pressure_; }
  double star_velocity() const { return star_velocity_; }
  /// State on the ray x/t = speed.
  Primitive at(double speed) const;
  /// Speeds between which the solution is smooth, in increasing order.
  std::vector<double> breaks() const;
  /// Mean density over [low, high] at time t, the jump having stood at 0: Gauss quadrature between the breaks.
  double mean_density(double low, double high, double t) const;

 private:
  struct Side {
    Primitive state;
    double sound, sign;  // sign: -1 left, +1 right
  };
  bool empty(Side const& s) const { return !(s.state.density > 0); }
  double velocity_change(Side const& s, double p) const;
  Primitive behind(Side const& s, double speed) const;  // within or before the wave of this side
  double head(Side const& s) const;
  double tail(Side const& s) const;

  double gamma_;
  Side left_, right_;
  bool vacuum_ = false;
  double star_pressure_ = 0, star_velocity_ = 0;
};

}  // namespace brisance::testing
