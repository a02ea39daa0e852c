#include "core/solid/contact/intersection.hpp"

namespace brisance::solid {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void Clipper::Faces::close(char owner) {
  auto const begin = at(first.back());
  if (loops.size() - begin < 3) {
    loops.resize(begin);
    return;
  }
  first.push_back(static_cast<int>(loops.size()));
  of_a.push_back(owner);
}

/// The point where the edge from a corner inside to one outside meets the plane; both faces of the edge get the same.
int Clipper::crossing(int inside, int outside) {
  for (Crossing const& c : crossings_)
    if (c.inside == inside && c.outside == outside) return c.point;
  Real const in = height_[at(inside)], out = height_[at(outside)];
  int const point = static_cast<int>(next_points_.size());
  next_points_.push_back(points_[at(inside)] + (in / (in - out)) * (points_[at(outside)] - points_[at(inside)]));
  crossings_.push_back({inside, outside, point});
  return point;
}

Clipper::Cut Clipper::cut(Vec3 const& normal, Real offset) {
  height_.resize(points_.size());
  bool some_in = false, some_out = false;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    height_[p] = dot(normal, points_[p]) - offset;
    (height_[p] > 0 ? some_out : some_in) = true;
  }
  if (!some_out) return Cut::missed;
  if (!some_in) return Cut::empty;
  next_points_.clear();
  renumbered_.assign(points_.size(), -1);
  for (std::size_t p = 0; p < points_.size(); ++p)
    if (height_[p] <= 0) {
      renumbered_[p] = static_cast<int>(next_points_.size());
      next_points_.push_back(points_[p]);
    }
  auto const first_crossing = static_cast<int>(next_points_.size());
  crossings_.clear();
  cap_.clear();
  next_faces_.clear();
  // A face is left at an exit and entered again at an entry; the piece of plane between them closes it, and the same
  // piece in the other direction bounds the cap.
  auto join = [&](int exit, int entry) {
    if (cap_.size() < crossings_.size()) cap_.resize(crossings_.size(), -1);
    cap_[at(entry - first_crossing)] = exit;
  };
  for (std::size_t f = 0; f + 1 < faces_.first.size(); ++f) {
    int const begin = faces_.first[f], end = faces_.first[f + 1];
    int exit = -1, entry_before_exit = -1;
    for (int k = begin; k < end; ++k) {
      int const a = faces_.loops[at(k)], b = faces_.loops[at(k + 1 < end ? k + 1 : begin)];
      bool const a_in = renumbered_[at(a)] >= 0, b_in = renumbered_[at(b)] >= 0;
      if (a_in) next_faces_.loops.push_back(renumbered_[at(a)]);
      if (a_in == b_in) continue;
      int const x = a_in ? crossing(a, b) : crossing(b, a);
      next_faces_.loops.push_back(x);
      if (a_in)
        exit = x;
      else if (exit >= 0)
        join(exit, x), exit = -1;
      else
        entry_before_exit = x;
    }
    if (entry_before_exit >= 0) join(exit, entry_before_exit);
    next_faces_.close(faces_.of_a[f]);
  }
  cap_.resize(crossings_.size(), -1);
  for (std::size_t start = 0; start < cap_.size(); ++start) {
    int x = static_cast<int>(start) + first_crossing;
    while (cap_[at(x - first_crossing)] >= 0) {
      next_faces_.loops.push_back(x);
      int const next = cap_[at(x - first_crossing)];
      cap_[at(x - first_crossing)] = -1;
      x = next;
    }
    next_faces_.close(0);
  }
  std::swap(points_, next_points_);
  std::swap(faces_, next_faces_);
  return Cut::clipped;
}

Intersection Clipper::measure() const {
  Intersection sum;
  Vec3 first_moment{};
  Vec3 const apex = points_[0];
  Vec3 largest{};
  for (std::size_t f = 0; f + 1 < faces_.first.size(); ++f) {
    int const begin = faces_.first[f], end = faces_.first[f + 1];
    Vec3 const a = points_[at(faces_.loops[at(begin)])];
    Vec3 whole{};
    for (int k = begin + 1; k + 1 < end; ++k) {
      Vec3 const b = points_[at(faces_.loops[at(k)])], c = points_[at(faces_.loops[at(k + 1)])];
      Vec3 const area = 0.5 * cross(b - a, c - a);
      Real const volume = dot(a - apex, area) / 3;
      sum.volume += volume;
      first_moment += (volume / 4) * ((a - apex) + (b - apex) + (c - apex));
      whole += area;
      if (faces_.of_a[f]) sum.moment += cross((1.0 / 3) * (a + b + c), area);
    }
    if (faces_.of_a[f]) sum.area += whole;
    if (norm2(whole) > norm2(largest)) largest = whole;
  }
  if (!(sum.volume > 0)) return {};
  sum.centroid = apex + first_moment / sum.volume;
  // Along the normal of the largest piece, which the sides of a thin slab do not tilt as they tilt the sum.
  Real low = 1e300, high = -1e300;
  for (Vec3 const& p : points_) {
    Real const h = dot(p, largest);
    low = min(low, h), high = max(high, h);
  }
  sum.order = (high - low) / sum.volume;
  if (Real const size = norm(sum.area); size > 0) {
    sum.low = 1e300, sum.high = -1e300;
    for (Vec3 const& p : points_) {
      Real const h = dot(p, sum.area) / size;
      sum.low = min(sum.low, h), sum.high = max(sum.high, h);
    }
  }
  return sum;
}

SurfaceMoments Clipper::moments(bool of_a, Vec3 const& outward, Vec3 const& centroid) const {
  SurfaceMoments sum;
  for (std::size_t f = 0; f + 1 < faces_.first.size(); ++f) {
    if ((faces_.of_a[f] != 0) != of_a) continue;
    int const begin = faces_.first[f], end = faces_.first[f + 1];
    Vec3 const a = points_[at(faces_.loops[at(begin)])];
    for (int k = begin + 1; k + 1 < end; ++k) {
      Vec3 const b = points_[at(faces_.loops[at(k)])], c = points_[at(faces_.loops[at(k + 1)])];
      Vec3 const area = 0.5 * cross(b - a, c - a);
      for (Vec3 const& x : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) {  // exact for squares
        Vec3 const part = (dot(outward, centroid - x) / 3) * area;
        sum.force += part;
        sum.moment += cross(x, part);
      }
    }
  }
  return sum;
}

Intersection Clipper::intersect(PlacedConvex const& a, PlacedConvex const& b, Vec3 const& shift) {
  points_ = a.corners;
  faces_.loops = a.shape->loops;
  faces_.first = a.shape->first;
  faces_.of_a.assign(faces_.first.size() - 1, 1);
  for (std::size_t f = 0; f < b.normals.size(); ++f)
    if (cut(b.normals[f], b.shape->offsets[f] + dot(b.normals[f], shift)) == Cut::empty) return {};
  if (faces_.of_a.empty()) return {};
  return measure();
}

}  // namespace brisance::solid
