// Points in cubic buckets, found by place.
#pragma once
#include <cmath>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/vec3.hpp"

namespace brisance::solid {

class NodeBuckets {
 public:
  /// `points` must outlive it; `width` about the distance of neighbours.
  NodeBuckets(std::span<Vec3 const> points, Real width) : points_(points), width_(width) {}

  void add(Index n) {
    auto const c = place(points_[static_cast<std::size_t>(n)]);
    buckets_[key(c[0], c[1], c[2])].push_back(n);
  }

  /// Points in the box [low, high] widened by `slack`, and perhaps some outside; each once.
  template <class Visit>
  void each_in(Vec3 const& low, Vec3 const& high, Real slack, Visit visit) const {
    Vec3 const margin{slack, slack, slack};
    auto const a = place(low - margin), b = place(high + margin);
    auto const inside = [&](Index n) {
      Vec3 const& x = points_[static_cast<std::size_t>(n)];
      for (int d = 0; d < 3; ++d)
        if (x[d] < low[d] - slack || x[d] > high[d] + slack) return false;
      return true;
    };
    // A long face may span more buckets than there are points.
    double const span = static_cast<double>(b[0] - a[0] + 1) * static_cast<double>(b[1] - a[1] + 1) *
                        static_cast<double>(b[2] - a[2] + 1);
    if (span > static_cast<double>(buckets_.size())) {
      for (auto const& [k, list] : buckets_)
        for (Index n : list)
          if (inside(n)) visit(n);
      return;
    }
    for (auto z = a[2]; z <= b[2]; ++z)
      for (auto y = a[1]; y <= b[1]; ++y)
        for (auto x = a[0]; x <= b[0]; ++x) {
          auto const found = buckets_.find(key(x, y, z));
          if (found == buckets_.end()) continue;
          for (Index n : found->second)
            if (inside(n)) visit(n);
        }
  }
  template <class Visit>
  void each_near(Vec3 const& x, Real distance, Visit visit) const {
    each_in(x, x, distance, visit);
  }

 private:
  using Place = std::array<std::int64_t, 3>;
  Place place(Vec3 const& x) const {
    return {static_cast<std::int64_t>(std::floor(x.x / width_)), static_cast<std::int64_t>(std::floor(x.y / width_)),
            static_cast<std::int64_t>(std::floor(x.z / width_))};
  }
  /// 21 bits a side: places that share a key also share a bucket, which only costs time.
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    auto const bits = [](std::int64_t a) { return static_cast<std::uint64_t>(a) & 0x1FFFFF; };
    return bits(x) << 42 | bits(y) << 21 | bits(z);
  }

  std::span<Vec3 const> points_;
  Real width_;
  std::unordered_map<std::uint64_t, std::vector<Index>> buckets_;
};

}  // namespace brisance::solid
