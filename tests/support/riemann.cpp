#include "tests/support/riemann.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::testing {

RiemannProblem::RiemannProblem(Primitive left, Primitive right, double gamma) : gamma_(gamma) {
  auto sound = [&](Primitive const& s) { return s.density > 0 ? std::sqrt(gamma * s.pressure / s.density) : 0.0; };
  left_ = {left, sound(left), -1}, right_ = {right, sound(right), 1};
  double const k = gamma - 1, gap = right.velocity - left.velocity;
  vacuum_ = empty(left_) || empty(right_) || 2 * (left_.sound + right_.sound) / k <= gap;
  if (vacuum_) return;
  // f(p) = du_L(p) + du_R(p) + u_R - u_L increases and is concave: Newton from the left of the root converges without
  // overshoot; the two-rarefaction pressure lies left of or at it.
  double const z = k / (2 * gamma);
  double p = std::pow((left_.sound + right_.sound - 0.5 * k * gap) /
                          (left_.sound / std::pow(left.pressure, z) + right_.sound / std::pow(right.pressure, z)),
                      1 / z);
  double low = 0, high = 0;
  auto f = [&](double q) { return velocity_change(left_, q) + velocity_change(right_, q) + gap; };
  for (high = std::max({p, left.pressure, right.pressure}); f(high) < 0;) high *= 2;
  for (int turn = 0; turn < 400; ++turn) {
    double const value = f(p);
    (value < 0 ? low : high) = p;
    double const step = 1e-7 * p, slope = (f(p + step) - value) / step;
    double next = p - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - p) <= 1e-15 * p) break;
    p = next;
  }
  star_pressure_ = p;
  star_velocity_ = 0.5 * (left.velocity + right.velocity + velocity_change(right_, p) - velocity_change(left_, p));
}

double RiemannProblem::velocity_change(Side const& s, double p) const {
  double const k = gamma_ - 1, p0 = s.state.pressure;
  if (p > p0) {
    double const a = 2 / ((gamma_ + 1) * s.state.density), b = k / (gamma_ + 1) * p0;
    return (p - p0) * std::sqrt(a / (p + b));
  }
  return 2 * s.sound / k * (std::pow(p / p0, k / (2 * gamma_)) - 1);
}

double RiemannProblem::head(Side const& s) const {
  if (!vacuum_ && star_pressure_ > s.state.pressure)
    return s.state.velocity +
           s.sign * s.sound *
               std::sqrt((gamma_ + 1) / (2 * gamma_) * star_pressure_ / s.state.pressure + (gamma_ - 1) / (2 * gamma_));
  return s.state.velocity + s.sign * s.sound;
}

double RiemannProblem::tail(Side const& s) const {
  double const k = gamma_ - 1;
  if (vacuum_) return s.state.velocity - s.sign * 2 * s.sound / k;
  if (star_pressure_ > s.state.pressure) return head(s);
  return star_velocity_ + s.sign * s.sound * std::pow(star_pressure_ / s.state.pressure, k / (2 * gamma_));
}

Primitive RiemannProblem::behind(Side const& s, double speed) const {
  double const k = gamma_ - 1;
  if (s.sign * (speed - head(s)) >= 0) return s.state;
  if (s.sign * (speed - tail(s)) > 0) {  // fan
    double const share = 2 / (gamma_ + 1) - s.sign * k / ((gamma_ + 1) * s.sound) * (s.state.velocity - speed);
    double const c = std::max(share, 0.0);
    return {s.state.density * std::pow(c, 2 / k),
            2 / (gamma_ + 1) * (-s.sign * s.sound + 0.5 * k * s.state.velocity + speed),
            s.state.pressure * std::pow(c, 2 * gamma_ / k)};
  }
  if (vacuum_) return {0, 0, 0};
  double const ratio = star_pressure_ / s.state.pressure, m = k / (gamma_ + 1);
  double const density =
      ratio > 1 ? s.state.density * (ratio + m) / (m * ratio + 1) : s.state.density * std::pow(ratio, 1 / gamma_);
  return {density, star_velocity_, star_pressure_};
}

Primitive RiemannProblem::at(double speed) const {
  if (vacuum_) {
    if (!empty(left_) && speed < tail(left_)) return behind(left_, speed);
    if (!empty(right_) && speed > tail(right_)) return behind(right_, speed);
    return {0, 0, 0};
  }
  return behind(speed < star_velocity_ ? left_ : right_, speed);
}

std::vector<double> RiemannProblem::breaks() const {
  std::vector<double> list;
  for (Side const& s : {left_, right_})
    if (!empty(s)) list.insert(list.end(), {head(s), tail(s)});
  if (!vacuum_) list.push_back(star_velocity_);
  std::sort(list.begin(), list.end());
  return list;
}

double RiemannProblem::mean_density(double low, double high, double t) const {
  static double const node[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  static double const weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  std::vector<double> ends{low};
  for (double const speed : breaks())
    if (double const x = speed * t; x > low && x < high) ends.push_back(x);
  ends.push_back(high);
  double mass = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    double const middle = 0.5 * (ends[i] + ends[i + 1]), half = 0.5 * (ends[i + 1] - ends[i]);
    for (int n = 0; n < 4; ++n)
      mass +=
          half * weight[n] * (at((middle - half * node[n]) / t).density + at((middle + half * node[n]) / t).density);
  }
  return mass / (high - low);
}

}  // namespace brisance::testing
