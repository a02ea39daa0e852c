// Where the solid will be at the end of a step, for the boundary that the fluid meets.
#include <cmath>

#include "core/solid/solid.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Quaternion turn_by(Vec3 const& angle) {
  Real const size = norm(angle);
  if (size == 0) return {1, {}};
  return {std::cos(0.5 * size), (std::sin(0.5 * size) / size) * angle};
}

}  // namespace

void Solid::predict(Real dt, int steps) {
  Real const h = dt / steps;
  if (steps == 1) {
    half_kick(h);
    drift(h);
    exchange_pose();
    return;
  }
  // What is not links: contact, sources, dashpots. It stays as it is, so that nothing of its owners has to be undone.
  std::vector<Wrench> const now = wrench_;
  compute_forces();
  std::vector<Wrench> other(at(owned_));
  for (std::size_t p = 0; p < other.size(); ++p) {
    other[p].force = now[p].force - wrench_[p].force;
    other[p].torque = now[p].torque - wrench_[p].torque;
  }
  wrench_ = now;
  std::vector<Wall> const walls = walls_;
  std::vector<HalfVelocity> mean(half_.size());
  for (int s = 0; s < steps; ++s) {
    half_kick(h);
    drift(h);
    exchange_pose();
    for (std::size_t p = 0; p < mean.size(); ++p) {
      mean[p].v += half_[p].v / static_cast<Real>(steps);
      mean[p].omega += half_[p].omega / static_cast<Real>(steps);
    }
    if (s + 1 == steps) break;
    for (Wall& wall : walls_) {
      wall.to.x += h * wall.v;
      wall.to.q = turn_by(h * wall.omega) * wall.to.q;
    }
    compute_forces();
    for (std::size_t p = 0; p < other.size(); ++p) {
      wrench_[p].force += other[p].force;
      wrench_[p].torque += other[p].torque;
    }
    half_kick(h);
  }
  walls_ = walls;
  half_ = mean;
}

}  // namespace brisance::solid
