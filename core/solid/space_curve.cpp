#include "core/solid/space_curve.hpp"

#include <algorithm>
#include <numeric>

namespace brisance::solid {

std::uint64_t hilbert_key(Vec3 const& unit) {
  // Skilling's transform (AIP Conf. Proc. 707, 2004): Gray code undone axis by axis from the high bits down.
  constexpr int bits = 20;
  std::array<std::uint32_t, 3> x;
  for (int d = 0; d < 3; ++d)
    x[static_cast<std::size_t>(d)] = static_cast<std::uint32_t>(clamp(unit[d], 0, 1) * ((1u << bits) - 1));
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    std::uint32_t const p = q - 1;
    for (std::size_t d = 0; d < 3; ++d) {
      if (x[d] & q) {
        x[0] ^= p;
      } else {
        std::uint32_t const t = (x[0] ^ x[d]) & p;
        x[0] ^= t;
        x[d] ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  for (auto& c : x) c ^= t;
  std::uint64_t key = 0;
  for (int b = bits - 1; b >= 0; --b)
    for (std::size_t d = 0; d < 3; ++d) key = key << 1 | (x[d] >> b & 1u);
  return key;
}

std::vector<std::size_t> curve_order(std::span<Vec3 const> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (points.empty()) return order;
  Vec3 low = points[0], high = points[0];
  for (Vec3 const& p : points)
    for (int d = 0; d < 3; ++d) low[d] = min(low[d], p[d]), high[d] = max(high[d], p[d]);
  Real const side = max(max(high.x - low.x, high.y - low.y), max(high.z - low.z, 1e-300));
  std::vector<std::uint64_t> keys(points.size());
  for (std::size_t a = 0; a < points.size(); ++a) keys[a] = hilbert_key((points[a] - low) / side);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}

}  // namespace brisance::solid
