#include "fluid/boundary/moving_front.hpp"

#include "fluid/shapes.hpp"

namespace brisance::fluid {

State Front::operator()(State const&, GhostCell const& ghost) const {
  Vec3 half = 0.5 * grid->spacing;
  for (int d = grid->dimension; d < 3; ++d) half[d] = 0;
  Real const distance = dot(grid->centre(ghost.global) - point, normal), reach = norm(half);
  if (distance >= reach) return ahead;
  if (distance <= -reach) return behind;
  constexpr int samples = 4;
  Real const share = covered_by_half_space(*grid, ghost.global, point, normal, samples);
  State u;
  for (std::size_t q = 0; q < 5; ++q) u[q] = share * ahead[q] + (1 - share) * behind[q];
  return u;
}

}  // namespace brisance::fluid
