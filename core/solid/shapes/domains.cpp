#include "core/solid/shapes/domains.hpp"

#include <cmath>

namespace brisance::solid {
namespace {

/// Images of a point at distance r from the axis or centre, along `direction` (unit), in radii `inner` and `outer`.
std::vector<Vec3> radial_images(Vec3 const& p, Vec3 const& direction, Real r, Real inner, Real outer) {
  std::vector<Vec3> images{p + (2 * (outer - r)) * direction};
  if (inner > 0 && r < 2 * inner) images.push_back(p + (2 * (inner - r)) * direction);
  return images;
}

Vec3 unit_or(Vec3 const& v, Vec3 const& fallback) { return norm(v) > 0 ? normalized(v) : fallback; }

}  // namespace

bool BrickDomain::contains(Vec3 const& p) const {
  for (int d = 0; d < 3; ++d)
    if (std::abs(dot(p - centre_, frame_[d])) >= half_[d]) return false;
  return true;
}

std::vector<Domain::Wall> BrickDomain::walls() const {
  std::vector<Wall> walls;
  for (int d = 0; d < 3; ++d)
    for (Real side : {-1.0, 1.0}) walls.push_back({centre_ + (side * half_[d]) * frame_[d], side * frame_[d]});
  return walls;
}

Vec3 BrickDomain::reach() const {
  Vec3 r{};
  for (int e = 0; e < 3; ++e)
    for (int d = 0; d < 3; ++d) r[e] += half_[d] * std::abs(frame_[d][e]);
  return r;
}

PlaneDomain::PlaneDomain(std::vector<Wall> walls, std::span<Vec3 const> corners, Real volume)
    : walls_(std::move(walls)), low_(corners[0]), high_(corners[0]), volume_(volume) {
  for (Vec3 const& x : corners)
    for (int d = 0; d < 3; ++d) low_[d] = min(low_[d], x[d]), high_[d] = max(high_[d], x[d]);
}

bool PlaneDomain::contains(Vec3 const& p) const {
  for (Wall const& w : walls_)
    if (dot(p - w.point, w.normal) >= 0) return false;
  return true;
}

PlaneDomain inside_of(Polyhedron const& convex) {
  std::vector<Domain::Wall> walls;
  for (std::size_t f = 0; f < convex.faces.size(); ++f) {
    FaceGeometry const g = face_geometry(convex, f);
    walls.push_back({g.centroid, g.normal});
  }
  return {std::move(walls), convex.vertices, moments(convex).volume};
}

Vec3 TubeDomain::low() const {
  Vec3 r;
  for (int e = 0; e < 3; ++e) r[e] = outer_ + 0.5 * length_ * std::abs(frame_[2][e]);
  return centre_ - r;
}

Vec3 TubeDomain::high() const { return centre_ + (centre_ - low()); }

bool TubeDomain::contains(Vec3 const& p) const {
  Vec3 const y = p - centre_;
  Real const height = dot(y, frame_[2]), r = norm(y - height * frame_[2]);
  return std::abs(height) < 0.5 * length_ && r > inner_ && r < outer_;
}

std::vector<Domain::Wall> TubeDomain::walls() const {
  Vec3 const end = (0.5 * length_) * frame_[2];
  return {{centre_ - end, -frame_[2]}, {centre_ + end, frame_[2]}};
}

std::vector<Vec3> TubeDomain::images(Vec3 const& p) const {
  Vec3 const y = p - centre_;
  Vec3 const across = y - dot(y, frame_[2]) * frame_[2];
  return radial_images(p, unit_or(across, frame_[0]), norm(across), inner_, outer_);
}

bool ShellDomain::contains(Vec3 const& p) const {
  Real const r = norm(p - centre_);
  return r > inner_ && r < outer_;
}

std::vector<Vec3> ShellDomain::images(Vec3 const& p) const {
  Vec3 const y = p - centre_;
  return radial_images(p, unit_or(y, {1, 0, 0}), norm(y), inner_, outer_);
}

}  // namespace brisance::solid
