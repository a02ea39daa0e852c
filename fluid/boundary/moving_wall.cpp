#include "fluid/boundary/moving_wall.hpp"

#include <cmath>

namespace brisance::fluid {

Real WallHistory::largest_displacement(Real end) const {
  std::vector<Real> knots{0};
  for (Real const t : table.times)
    if (t > 0 && t < end) knots.push_back(t);
  knots.push_back(end);
  Real place = 0, largest = 0;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    Real const from = knots[i - 1], length = knots[i] - from;
    Real const v0 = table.at(from)[0], v1 = table.at(knots[i])[0];
    // Where the wall turns it is farthest.
    if (v0 * v1 < 0) largest = max(largest, std::abs(place + 0.5 * v0 * (v0 / (v0 - v1)) * length));
    place += 0.5 * (v0 + v1) * length;
    largest = max(largest, std::abs(place));
  }
  return largest;
}

}  // namespace brisance::fluid
