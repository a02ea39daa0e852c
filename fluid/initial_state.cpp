#include "fluid/initial_state.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/shapes.hpp"
#include "parallel/error.hpp"

namespace brisance::fluid {
namespace {

constexpr Real tnt_energy = 4.184e6;  // J/kg, by convention
constexpr int samples_of_charge = 8;  // per direction: the rim of small charges matters

State mixed(State const& outside, State const& inside, Real share) {
  if (share == 1) return inside;
  State u;
  for (std::size_t q = 0; q < 5; ++q) u[q] = (1 - share) * outside[q] + share * inside[q];
  return u;
}

/// Calls visit(block, i, j, k, global cell) for the owned cells between `low` and `high`.
template <class Visit>
void for_cells_in(Flow& flow, Block& block, Vec3 const& low, Vec3 const& high, Visit&& visit) {
  Grid const& grid = flow.grid();
  CellIndex begin{0, 0, 0}, end = block.size();
  for (int d = 0; d < grid.dimension; ++d) {
    std::size_t const s = static_cast<std::size_t>(d);
    auto const local = [&](Real x, Real round) {
      Real const cell = std::floor((x - grid.low[d]) / grid.spacing[d]) + round - block.first()[s];
      return static_cast<Index>(clamp(cell, 0, block.size()[s]));
    };
    begin[s] = local(low[d], 0);
    end[s] = local(high[d], 1);
  }
  CellIndex const first = block.first();
  for (Index k = begin[2]; k < end[2]; ++k)
    for (Index j = begin[1]; j < end[1]; ++j)
      for (Index i = begin[0]; i < end[0]; ++i) visit(i, j, k, CellIndex{first[0] + i, first[1] + j, first[2] + k});
}

/// A ball of gas on the grid: which share of which cell, and the fluid volume it fills.
class Balloon {
 public:
  Balloon(Flow& flow, FluidVolume const& volume, ChargeConfig const& charge, Real radius)
      : flow_(flow), volume_(volume), centre_(charge.centre) {
    set_radius(radius);
    if (fluid_volume_ > 0) return;
    // Smaller than the distance of the sample points: the cell of the centre holds it.
    Real const share = ball_volume(flow.grid().dimension, radius) / flow.grid().cell_volume();
    if (share < 1) {
      whole_share_ = share;
      set_radius(radius);
    }
  }

  Real fluid_volume() const { return fluid_volume_; }
  Real radius() const { return radius_; }

  void set_radius(Real radius) {
    radius_ = radius;
    parallel::ExactSum sum;
    for (Block& block : flow_.blocks()) {
      Real part = 0;
      visit(block, [&](Index, Index, Index, CellIndex c, Real share) { part += share * volume(c); });
      sum.add(part);
    }
    flow_.comm().sum(std::span(&sum, 1));
    fluid_volume_ = sum.value();
  }

  void store(State const& inside) {
    for (Block& block : flow_.blocks())
      visit(block, [&](Index i, Index j, Index k, CellIndex, Real share) {
        block.store(i, j, k, mixed(block.load(i, j, k), inside, share));
      });
  }

 private:
  Real volume(CellIndex c) const {
    return volume_.cuts(flow_.grid().block_of(c)) ? volume_(c) : flow_.grid().cell_volume();
  }
  template <class Visit>
  void visit(Block& block, Visit&& act) {
    Real const reach = whole_share_ > 0 ? 0 : radius_;
    Vec3 const r{reach, reach, reach};
    for_cells_in(flow_, block, centre_ - r, centre_ + r, [&](Index i, Index j, Index k, CellIndex c) {
      Real const share =
          whole_share_ > 0 ? whole_share_ : covered_by_ball(flow_.grid(), c, centre_, radius_, samples_of_charge);
      if (share > 0 && volume(c) > 0) act(i, j, k, c, share);
    });
  }

  Flow& flow_;
  FluidVolume const& volume_;
  Vec3 centre_;
  Real radius_ = 0, fluid_volume_ = 0;
  Real whole_share_ = 0;  // of the one cell that holds a tiny charge, else 0
};

void require_volume(Balloon const& balloon, ChargeConfig const& charge) {
  std::string const where = charge.at.text();
  require(balloon.fluid_volume() > 0, Failure::scene,
          (where.empty() ? "" : where + ": ") +
              "fluid.charge: no fluid at its place, so its energy has nowhere to go. Move `centre` into the fluid.");
}

/// Mass and energy as stated, whatever the shape that the grid, walls and sides of the domain leave to the balloon.
void add_by_energy(Flow& flow, FlowConfig const& config, ChargeConfig const& charge, FluidVolume const& volume) {
  int const n = flow.grid().dimension;
  Real const mass = *charge.mass;
  Real const wanted = charge.density ? mass / *charge.density : 0;
  Balloon balloon(flow, volume, charge, charge.radius ? *charge.radius : ball_radius(n, wanted));
  require_volume(balloon, charge);
  if (charge.density) {
    // On the ground or in a corner only a part of the ball lies in the fluid: grow it until that part has the volume.
    for (int pass = 0; pass < 4; ++pass)
      balloon.set_radius(balloon.radius() * ball_radius(n, wanted) / ball_radius(n, balloon.fluid_volume()));
    require_volume(balloon, charge);
  }
  Real const filled = balloon.fluid_volume();
  Real const energy = flow.gas().energy_at_rest(mass / filled, config.ambient.pressure) +
                      tnt_energy * charge.tnt_factor * mass / filled;
  balloon.store({mass / filled, 0, 0, 0, energy});
}

/// The stated gas state in the ball; the rounding of the rim to sample points is taken out of mass and energy, what
/// lies outside the domain or in a wall is lost.
void add_by_state(Flow& flow, FlowConfig const& config, ChargeConfig const& charge, FluidVolume const& volume) {
  Grid const& grid = flow.grid();
  Balloon balloon(flow, volume, charge, *charge.radius);
  require_volume(balloon, charge);
  CellIndex low{0, 0, 0}, high{0, 0, 0};
  for (int d = 0; d < grid.dimension; ++d) {
    std::size_t const s = static_cast<std::size_t>(d);
    low[s] = static_cast<Index>(std::floor((charge.centre[d] - *charge.radius - grid.low[d]) / grid.spacing[d]));
    high[s] = static_cast<Index>(std::floor((charge.centre[d] + *charge.radius - grid.low[d]) / grid.spacing[d]));
  }
  Real sampled = 0;
  CellIndex c;
  for (c[2] = low[2]; c[2] <= high[2]; ++c[2])
    for (c[1] = low[1]; c[1] <= high[1]; ++c[1])
      for (c[0] = low[0]; c[0] <= high[0]; ++c[0])
        sampled += covered_by_ball(grid, c, charge.centre, *charge.radius, samples_of_charge) * grid.cell_volume();
  Real const exact = ball_volume(grid.dimension, *charge.radius);
  Real const scale = sampled > 0 ? exact / sampled : 1;
  Gas const& gas = flow.gas();
  Real const ambient = gas.energy_at_rest(config.ambient.density, config.ambient.pressure);
  Real const hot = gas.energy_at_rest(*charge.density, *charge.pressure);
  balloon.store({*charge.density * scale, 0, 0, 0, ambient + (hot - ambient) * scale});
}

}  // namespace

void fill(Flow& flow, std::function<State(CellIndex)> const& state) {
  for (Block& block : flow.blocks()) {
    auto const [nx, ny, nz] = block.size();
    CellIndex const first = block.first();
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) block.store(i, j, k, state({first[0] + i, first[1] + j, first[2] + k}));
  }
}

void fill(Flow& flow, FlowConfig const& config, FluidVolume const& volume) {
  Gas const& gas = flow.gas();
  State const ambient = gas.conserved(config.ambient.density, config.ambient.velocity, config.ambient.pressure);
  std::vector<State> inside;
  for (RegionConfig const& region : config.region)
    inside.push_back(gas.conserved(region.density, region.velocity, region.pressure));
  fill(flow, [&](CellIndex c) {
    State u = ambient;
    for (std::size_t r = 0; r < inside.size(); ++r) {
      Real const share = covered(config.region[r], flow.grid(), c);
      if (share > 0) u = mixed(u, inside[r], share);
    }
    return u;
  });
  for (ChargeConfig const& charge : config.charge)
    (charge.mass ? add_by_energy : add_by_state)(flow, config, charge, volume);
}

}  // namespace brisance::fluid
