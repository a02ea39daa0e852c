#include "fluid/flux/mixture_cell.hpp"
#include "fluid/survey.hpp"

namespace brisance::fluid {
namespace {

/// Adds the first `count` cells of a pack.
void add(Survey& seen, Survey& row, MixtureCell<Pack> const& cell, PackMask vacuum, Index count) {
  std::uint32_t const empty = bits_of(vacuum);
  std::array<Pack, 3> const velocity{cell.u, cell.v, cell.w};
  for (Index i = 0; i < count; ++i) {
    auto const lane = static_cast<std::size_t>(i);
    for (std::size_t q = 0; q < 5; ++q) row.sum[q] += cell.state[q].get(lane);
    row.products += cell.state[5].get(lane);
    row.momentum_size += norm({cell.state[1].get(lane), cell.state[2].get(lane), cell.state[3].get(lane)});
    if (empty >> i & 1) continue;
    Real const c = cell.sound.get(lane);
    for (std::size_t d = 0; d < 3; ++d) seen.speed[d] = max(seen.speed[d], std::fabs(velocity[d].get(lane)) + c);
    seen.density_min = min(seen.density_min, cell.state[0].get(lane));
    seen.pressure_min = min(seen.pressure_min, cell.pressure.get(lane));
    Vec3 const u{velocity[0].get(lane), velocity[1].get(lane), velocity[2].get(lane)};
    seen.mach_max = max(seen.mach_max, norm(u) / c);
  }
}

void add_sums(Survey& to, Survey const& part) {
  for (std::size_t q = 0; q < 5; ++q) to.sum[q] += part.sum[q];
  to.momentum_size += part.momentum_size;
  to.products += part.products;
}

}  // namespace

Survey survey_mixture(Block const& block, Mixture const& mixture) {
  constexpr Index width = lanes_of<Pack>;
  MixtureConstants<Pack> const constants(mixture, 1);  // sigma plays no part in primitives
  Survey seen;
  auto const [nx, ny, nz] = block.size();
  for (Index k = 0; k < nz; ++k) {
    Survey plane;
    for (Index j = 0; j < ny; ++j) {
      Survey row;
      // Rows are padded to whole vectors. Every cell goes through the same instructions, so that its speed has the same
      // bits wherever a block ends; lanes beyond the row are left out.
      for (Index i = 0; i < nx; i += width) {
        MixtureCell<Pack> cell;
        for (int q = 0; q < 7; ++q)
          cell.state[static_cast<std::size_t>(q)] = load<Pack>(block.component(q) + block.at(i, j, k));
        primitives(cell, constants);
        add(seen, row, cell, is_vacuum(cell, constants), nx - i < width ? nx - i : width);
      }
      add_sums(plane, row);
    }
    add_sums(seen, plane);
  }
  return seen;
}

}  // namespace brisance::fluid
