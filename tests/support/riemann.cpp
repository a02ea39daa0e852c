#include "tests/support/riemann.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/quadrature.hpp"

namespace brisance::testing {
namespace {

/// Zero of an increasing function by bisection to the last bit.
template <class F>
double increasing_root(F const& f, double low, double high) {
  for (;;) {
    double const middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (f(middle) < 0 ? low : high) = middle;
  }
}

}  // namespace

WaveCurve::WaveCurve(Primitive ahead, fluid::Gas const& gas, double sign) : ahead_(ahead), gas_(gas), sign_(sign) {
  if (empty()) return;
  double const phi = (ahead.pressure - gas.reference_pressure(ahead.density)) / gas.kappa();
  isentrope_ = phi / std::pow(ahead.density, gas.gamma);
}

double WaveCurve::density(double s) const { return ahead_.density * std::pow(s, 2 / gas_.kappa()); }

double WaveCurve::pressure(double s) const {
  double const rho = density(s);
  return gas_.reference_pressure(rho) + gas_.kappa() * isentrope_ * std::pow(rho, gas_.gamma);
}

double WaveCurve::sound(double s) const {
  double const rho = density(s);
  if (!(rho > 0)) return 0;
  return std::sqrt(gas_.reference_slope(rho) + gas_.gamma * gas_.kappa() * isentrope_ * std::pow(rho, gas_.kappa()));
}

double WaveCurve::velocity(double s) const {
  // c d(rho)/rho = (2/Gamma) (c/s) ds, and c/s is a constant where the curve has no exponential
  auto const c_over_s = [&](double z) { return sound(z) / z; };
  return ahead_.velocity - sign_ * 2 / gas_.kappa() * integral(c_over_s, s, 1, gas_.curve.exponential() ? 24 : 1);
}

double WaveCurve::shock_pressure(double rho) const {
  // e - e0 = (p + p0)(v0 - v)/2 with e = (p - p_ref)/(Gamma rho) + e_ref is linear in p
  double const half = 0.5 * (1 / ahead_.density - 1 / rho);
  auto const energy = [&](double density, double p) {
    return (p - gas_.reference_pressure(density)) / (gas_.kappa() * density) + gas_.reference_energy(density) / density;
  };
  double const e0 = energy(ahead_.density, ahead_.pressure);
  return (e0 + half * ahead_.pressure - energy(rho, 0)) / (1 / (gas_.kappa() * rho) - half);
}

Primitive WaveCurve::behind(double p) const {
  double const p0 = ahead_.pressure;
  if (p > p0) {
    double const densest = ahead_.density * (gas_.kappa() + 2) / gas_.kappa();
    double const rho =
        increasing_root([&](double density) { return shock_pressure(density) - p; }, ahead_.density, densest);
    double const shrink = std::max(1 / ahead_.density - 1 / rho, 0.0);
    return {rho, ahead_.velocity + sign_ * std::sqrt((p - p0) * shrink), p};
  }
  double const s = increasing_root([&](double z) { return pressure(z) - p; }, 0, 1);
  return {density(s), velocity(s), p};
}

Primitive WaveCurve::fan(double speed) const {
  // sign (u + sign c) falls from the head inwards
  double const s = increasing_root([&](double z) { return sign_ * (velocity(z) - speed) + sound(z); }, 0, 1);
  return {density(s), velocity(s), pressure(s)};
}

double WaveCurve::head(Primitive const& b) const {
  double const shrink = b.density > 0 ? 1 / ahead_.density - 1 / b.density : 0;
  if (!shock(b) || !(shrink > 0)) return ahead_.velocity + sign_ * sound(1);
  return ahead_.velocity + sign_ * std::sqrt((b.pressure - ahead_.pressure) / shrink) / ahead_.density;
}

double WaveCurve::tail(Primitive const& b) const {
  if (shock(b)) return head(b);
  return b.velocity + sign_ * sound(std::pow(b.density / ahead_.density, gas_.kappa() / 2));
}

RiemannProblem::RiemannProblem(Primitive left, Primitive right, double gamma)
    : RiemannProblem(left, right, fluid::Gas{gamma, 0, 0}) {}

RiemannProblem::RiemannProblem(Primitive left, Primitive right, fluid::Gas const& left_gas, fluid::Gas const& right_gas)
    : left_(left, left_gas, -1), right_(right, right_gas, 1) {
  double const lowest = std::max(left_.floor(), right_.floor());
  auto const approach = [&](double p) { return right_.behind(p).velocity - left_.behind(p).velocity; };
  vacuum_ = left_.empty() || right_.empty() || approach(lowest) >= 0;
  if (vacuum_) {
    bool const alone = left_.empty() || right_.empty();
    if (!left_.empty()) left_star_ = left_.behind(alone ? left_.floor() : lowest);
    if (!right_.empty()) right_star_ = right_.behind(alone ? right_.floor() : lowest);
    return;
  }
  double high = std::max({left.pressure, right.pressure, lowest + 1});
  while (approach(high) < 0) high += high - lowest;
  double const p = increasing_root(approach, lowest, high);
  left_star_ = left_.behind(p), right_star_ = right_.behind(p);
  left_star_.velocity = right_star_.velocity = 0.5 * (left_star_.velocity + right_star_.velocity);
}

Primitive RiemannProblem::at(double speed) const {
  auto const within = [&](WaveCurve const& wave, Primitive const& star, double sign) -> Primitive {
    if (sign * (speed - wave.head(star)) >= 0) return wave.ahead();
    if (sign * (speed - wave.tail(star)) > 0) return wave.fan(speed);
    return star;
  };
  if (vacuum_) {
    if (!left_.empty() && speed < left_star_.velocity) return within(left_, left_star_, -1);
    if (!right_.empty() && speed > right_star_.velocity) return within(right_, right_star_, 1);
    return {0, 0, 0};
  }
  return speed < left_star_.velocity ? within(left_, left_star_, -1) : within(right_, right_star_, 1);
}

std::vector<double> RiemannProblem::breaks() const {
  std::vector<double> list;
  auto const add = [&](WaveCurve const& wave, Primitive const& star) {
    if (wave.empty()) return;
    for (double const speed : {wave.head(star), wave.tail(star), star.velocity}) list.push_back(speed);
  };
  add(left_, left_star_), add(right_, right_star_);
  std::sort(list.begin(), list.end());
  return list;
}

double RiemannProblem::mean_density(double low, double high, double t) const {
  std::vector<double> ends{low};
  for (double const speed : breaks())
    if (double const x = speed * t; x > low && x < high) ends.push_back(x);
  ends.push_back(high);
  double mass = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    mass += integral([&](double x) { return at(x / t).density; }, ends[i], ends[i + 1], 1);
  return mass / (high - low);
}

}  // namespace brisance::testing
