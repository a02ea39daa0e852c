#include "core/solid/supports/rigid_motion.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::solid {
namespace {

constexpr Real turn_of_a_step = 0.02;  // rad

Vec3 mix(Vec3 const& a, Vec3 const& b, Real share) { return (1 - share) * a + share * b; }

Quaternion exponential(Vec3 const& turn) {
  Real const half = 0.5 * norm(turn);
  Real const over = half > 1e-4 ? std::sin(half) / half : 1 - half * half / 6;
  return {std::cos(half), (0.5 * over) * turn};
}

Quaternion normalized(Quaternion const& q) {
  Real const size = std::sqrt(q.w * q.w + norm2(q.v));
  return {q.w / size, q.v / size};
}

/// Turn during `h` while the spin goes linearly from a to b: Magnus expansion to fourth order; exact if a and b are
/// parallel.
Quaternion turn(Vec3 const& a, Vec3 const& b, Real h) {
  return exponential((0.5 * h) * (a + b) - (h * h / 12) * cross(a, b));
}

bool parallel(Vec3 const& a, Vec3 const& b) { return norm2(cross(a, b)) == 0; }

}  // namespace

RigidMotion::RigidMotion(DrivenConfig const& config, int dimension) : centre_(config.centre.value_or(Vec3{})) {
  std::vector<TimedMotion> entries = config.history;
  if (entries.empty()) entries.push_back({0, config.velocity, config.spin, {}});
  auto const at_zero = [&] {
    auto const above = std::upper_bound(entries.begin(), entries.end(), 0.0,
                                        [](Real t, TimedMotion const& entry) { return t < entry.time; });
    if (above == entries.begin()) return TimedMotion{0, entries.front().velocity, entries.front().spin, {}};
    if (above == entries.end()) return TimedMotion{0, entries.back().velocity, entries.back().spin, {}};
    TimedMotion const &a = above[-1], &b = above[0];
    Real const share = (0 - a.time) / (b.time - a.time);
    return TimedMotion{0, mix(a.velocity, b.velocity, share), mix(a.spin, b.spin, share), {}};
  }();
  std::vector<TimedMotion> all{at_zero};
  for (TimedMotion const& entry : entries)
    if (entry.time > 0) all.push_back(entry);

  for (int d = dimension; d < 3; ++d) centre_[d] = 0;
  for (TimedMotion& entry : all) {
    for (int d = dimension; d < 3; ++d) entry.velocity[d] = 0;
    if (dimension < 3) entry.spin = {0, 0, dimension == 2 ? entry.spin.z : 0};
  }
  // Where the axis changes, knots between the entries, so that one step of the expansion is enough from each.
  knots_.push_back({0, all[0].velocity, all[0].spin, centre_, {}});
  for (std::size_t i = 1; i < all.size(); ++i) {
    TimedMotion const &a = all[i - 1], &b = all[i];
    Real const angle = max(norm(a.spin), norm(b.spin)) * (b.time - a.time);
    int const pieces = parallel(a.spin, b.spin) ? 1 : static_cast<int>(min(1e6, std::ceil(angle / turn_of_a_step)));
    for (int piece = 1; piece <= pieces; ++piece) {
      Real const share = static_cast<Real>(piece) / pieces;
      Knot const& from = knots_.back();
      Knot to{piece == pieces ? b.time : a.time + share * (b.time - a.time), mix(a.velocity, b.velocity, share),
              mix(a.spin, b.spin, share)};
      Real const h = to.time - from.time;
      to.x = from.x + (0.5 * h) * (from.velocity + to.velocity);
      to.q = normalized(turn(from.spin, to.spin, h) * from.q);
      knots_.push_back(to);
    }
  }
}

RigidMotion::State RigidMotion::at(Real time) const {
  auto const above =
      std::upper_bound(knots_.begin(), knots_.end(), time, [](Real t, Knot const& knot) { return t < knot.time; });
  Knot const& from = above == knots_.begin() ? knots_.front() : above[-1];
  Knot const& to = above == knots_.end() ? knots_.back() : above[0];
  Real const h = time - from.time, length = to.time - from.time;
  Real const share = length > 0 ? h / length : 0;
  Vec3 const v = mix(from.velocity, to.velocity, share), omega = mix(from.spin, to.spin, share);
  return {from.x + (0.5 * h) * (from.velocity + v), turn(from.spin, omega, h) * from.q, v, omega};
}

}  // namespace brisance::solid
