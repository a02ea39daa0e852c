// Bodies that Voronoi cells can fill: bricks, cylinders and tubes, balls and shells.
#pragma once
#include <numbers>
#include <span>

#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {

/// Brick about `centre` with sides along the rows of `frame`.
class BrickDomain : public Domain {
 public:
  BrickDomain(Vec3 const& centre, Mat3 const& frame, Vec3 const& half) : centre_(centre), frame_(frame), half_(half) {}
  Vec3 low() const override { return centre_ - reach(); }
  Vec3 high() const override { return centre_ + reach(); }
  Real volume() const override { return 8 * half_.x * half_.y * half_.z; }
  bool contains(Vec3 const& p) const override;
  std::vector<Wall> walls() const override;
  std::vector<Vec3> images(Vec3 const&) const override { return {}; }

 private:
  Vec3 reach() const;
  Vec3 centre_;
  Mat3 frame_;
  Vec3 half_;
};

inline BrickDomain axis_box(Vec3 const& low, Vec3 const& high) {
  return {0.5 * (low + high), Mat3::identity(), 0.5 * (high - low)};
}
inline BrickDomain plate_box(Vec3 const& centre, Vec3 const& normal, Real length, Real width, Real thickness) {
  return {centre, frame_about(normal), {0.5 * length, 0.5 * width, 0.5 * thickness}};
}

/// Convex body between planes.
class PlaneDomain : public Domain {
 public:
  /// `corners`: points whose box holds the body.
  PlaneDomain(std::vector<Wall> walls, std::span<Vec3 const> corners, Real volume);
  Real volume() const override { return volume_; }
  Vec3 low() const override { return low_; }
  Vec3 high() const override { return high_; }
  bool contains(Vec3 const& p) const override;
  std::vector<Wall> walls() const override { return walls_; }
  std::vector<Vec3> images(Vec3 const&) const override { return {}; }

 private:
  std::vector<Wall> walls_;
  Vec3 low_, high_;
  Real volume_;
};

/// The body of a convex polyhedron.
PlaneDomain inside_of(Polyhedron const& convex);

/// Between two coaxial cylinders (inner radius 0: full cylinder), cut by two planes across the axis.
class TubeDomain : public Domain {
 public:
  TubeDomain(Vec3 const& centre, Vec3 const& axis, Real inner, Real outer, Real length)
      : centre_(centre), frame_(frame_about(axis)), inner_(inner), outer_(outer), length_(length) {}
  Vec3 low() const override;
  Vec3 high() const override;
  Real volume() const override { return std::numbers::pi * (square(outer_) - square(inner_)) * length_; }
  bool contains(Vec3 const& p) const override;
  std::vector<Wall> walls() const override;
  std::vector<Vec3> images(Vec3 const& p) const override;

 private:
  Vec3 centre_;
  Mat3 frame_;
  Real inner_, outer_, length_;
};

/// Between two concentric spheres (inner radius 0: ball).
class ShellDomain : public Domain {
 public:
  ShellDomain(Vec3 const& centre, Real inner, Real outer) : centre_(centre), inner_(inner), outer_(outer) {}
  Vec3 low() const override { return centre_ - Vec3{outer_, outer_, outer_}; }
  Vec3 high() const override { return centre_ + Vec3{outer_, outer_, outer_}; }
  Real volume() const override {
    return 4 * std::numbers::pi / 3 * (outer_ * square(outer_) - inner_ * square(inner_));
  }
  bool contains(Vec3 const& p) const override;
  std::vector<Wall> walls() const override { return {}; }
  std::vector<Vec3> images(Vec3 const& p) const override;

 private:
  Vec3 centre_;
  Real inner_, outer_;
};

}  // namespace brisance::solid
