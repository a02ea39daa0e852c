#include "fluid/charges.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "core/base/errors.hpp"
#include "fluid/shapes.hpp"

namespace brisance::fluid {
namespace {

constexpr int samples_of_charge = 8;  // per direction: the rim of small charges matters

/// Calls visit(i, j, k, global cell) for the cells of a block between `low` and `high`.
template <class Visit>
void for_cells_in(Grid const& grid, Block& block, Vec3 const& low, Vec3 const& high, Visit&& visit) {
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

/// The form of a charge; `radius` of a ball may change.
struct Form {
  std::string shape;
  Vec3 centre, size;
  Real radius = 0, length = 0;
  int axis = 2;

  Real covered(Grid const& grid, CellIndex c) const {
    if (shape == "box") return covered_by_box(grid, c, centre - 0.5 * size, centre + 0.5 * size);
    if (shape == "cylinder") return covered_by_cylinder(grid, c, centre, radius, length, axis, samples_of_charge);
    return covered_by_ball(grid, c, centre, radius, samples_of_charge);
  }
  Real volume(int dimension) const {
    if (shape == "ball") return ball_volume(dimension, radius);
    if (shape == "cylinder") return std::numbers::pi * square(radius) * length;
    Real v = 1;
    for (int d = 0; d < dimension; ++d) v *= size[d];
    return v;
  }
  /// Half its extents.
  Vec3 reach() const {
    if (shape == "box") return 0.5 * size;
    Vec3 r{radius, radius, radius};
    if (shape == "cylinder") r[axis] = length / 2;
    return r;
  }
};

/// A charge on the grid: which share of which cell, and the fluid volume it fills.
class Balloon {
 public:
  Balloon(Flow& flow, FluidVolume const& volume, Form form) : flow_(flow), volume_(volume), form_(std::move(form)) {
    measure();
    if (fluid_volume_ > 0) return;
    // Smaller than the distance of the sample points: the cell of the centre holds it.
    Real const share = form_.volume(flow.grid().dimension) / flow.grid().cell_volume();
    if (share < 1) {
      whole_share_ = share;
      measure();
    }
  }

  Real fluid_volume() const { return fluid_volume_; }
  Form const& form() const { return form_; }

  void set_radius(Real radius) {
    form_.radius = radius;
    measure();
  }

  /// Scales the volume it fills in the cells of the rim, so that the whole is `wanted` to rounding. Expects: at least
  /// that volume now.
  void fit(Real wanted) {
    Real const whole = sum_of([](Real share) { return share == 1 ? 1 : 0; });
    if (fluid_volume_ > whole) rim_ = (wanted - whole) / (fluid_volume_ - whole);
    measure();
  }

  void store(State const& inside) {
    for (Block& block : flow_.blocks())
      visit(block, [&](Index i, Index j, Index k, CellIndex, Real share) {
        block.store(i, j, k, mixed(block.load(i, j, k), inside, share));
      });
  }
  /// Products displace what was there.
  void store(MixtureState const& inside) {
    for (Block& block : flow_.blocks())
      visit(block, [&](Index i, Index j, Index k, CellIndex, Real share) {
        MixtureState u = block.load_mixture(i, j, k);
        for (std::size_t q = 0; q < 7; ++q) u[q] = share == 1 ? inside[q] : (1 - share) * u[q] + share * inside[q];
        block.store_mixture(i, j, k, u);
      });
  }
  bool tiny() const { return whole_share_ > 0; }

 private:
  void measure() {
    fluid_volume_ = sum_of([](Real share) { return share; });
  }
  /// Fluid volume of the cells, weighted by a function of its share of each.
  template <class Weight>
  Real sum_of(Weight const& weight) {
    parallel::ExactSum sum;
    for (Block& block : flow_.blocks())  // cell by cell: the sum must not tell the blocks apart
      visit(block, [&](Index, Index, Index, CellIndex c, Real share) { sum.add(weight(share) * volume(c)); });
    flow_.comm().sum(std::span(&sum, 1));
    return sum.value();
  }
  Real volume(CellIndex c) const {
    return volume_.cuts(flow_.grid().block_of(c)) ? volume_(c) : flow_.grid().cell_volume();
  }
  template <class Visit>
  void visit(Block& block, Visit&& act) {
    Vec3 const r = whole_share_ > 0 ? Vec3{} : form_.reach();
    for_cells_in(flow_.grid(), block, form_.centre - r, form_.centre + r, [&](Index i, Index j, Index k, CellIndex c) {
      Real const share = whole_share_ > 0 ? whole_share_ : form_.covered(flow_.grid(), c);
      if (share > 0 && volume(c) > 0) act(i, j, k, c, share < 1 ? rim_ * share : share);
    });
  }

  Flow& flow_;
  FluidVolume const& volume_;
  Form form_;
  Real fluid_volume_ = 0;
  Real whole_share_ = 0;  // of the one cell that holds a tiny charge, else 0
  Real rim_ = 1;          // of what a cell that is filled in part would hold
};

/// A charge ready to be stored.
struct Placed {
  Balloon balloon;
  std::variant<State, MixtureState> inside;
  ChargeReport report;
};

/// How much of it there is, and where: mass and energy as stated, whatever the shape that the grid, walls and sides of
/// the domain leave to the balloon.
Balloon grown_balloon(Flow& flow, std::optional<Real> density, Real mass, Form form, FluidVolume const& volume) {
  int const n = flow.grid().dimension;
  Real const wanted = density ? mass / *density : 0;
  if (density) form.radius = ball_radius(n, wanted);
  Balloon balloon(flow, volume, std::move(form));
  // On the ground or in a corner only a part of the ball lies in the fluid: grow it until that part has the volume.
  for (int pass = 0; density && balloon.fluid_volume() > 0 && pass < 4; ++pass)
    balloon.set_radius(balloon.form().radius * ball_radius(n, wanted) / ball_radius(n, balloon.fluid_volume()));
  return balloon;
}

/// Volume of the form as its rim is sampled, also outside the domain.
Real sampled_volume(Grid const& grid, Form const& form) {
  CellIndex low{0, 0, 0}, high{0, 0, 0};
  Vec3 const r = form.reach();
  for (int d = 0; d < grid.dimension; ++d) {
    std::size_t const s = static_cast<std::size_t>(d);
    low[s] = static_cast<Index>(std::floor((form.centre[d] - r[d] - grid.low[d]) / grid.spacing[d]));
    high[s] = static_cast<Index>(std::floor((form.centre[d] + r[d] - grid.low[d]) / grid.spacing[d]));
  }
  Real sum = 0;
  CellIndex c;
  for (c[2] = low[2]; c[2] <= high[2]; ++c[2])
    for (c[1] = low[1]; c[1] <= high[1]; ++c[1])
      for (c[0] = low[0]; c[0] <= high[0]; ++c[0]) sum += form.covered(grid, c) * grid.cell_volume();
  return sum;
}

void add_extent(ChargeReport& report, Grid const& grid, Form const& form) {
  Vec3 const reach = form.reach();
  Real half = reach.x;
  report.cells_across = 2 * reach.x / grid.spacing.x;
  for (int d = 1; d < grid.dimension; ++d) {
    report.cells_across = min(report.cells_across, 2 * reach[d] / grid.spacing[d]);
    half = min(half, reach[d]);
  }
  report.radius = form.shape == "box" ? half : form.radius;
}

/// A ball of detonation products as dense as the explosive: density and energy per mass are exact in every cell, which
/// the stiff curve asks for, mass and energy in their sum.
Placed place_products(Flow& flow, FlowConfig const& config, std::size_t number, FluidVolume const& volume) {
  ChargeConfig const& charge = config.charge[number];
  JwlConfig const& jwl = config.products->jwl;
  std::string const name = "fluid.charge[" + std::to_string(number) + "]";
  Real const mass = products_mass(charge, jwl), wanted = mass / jwl.density;
  Balloon ball = grown_balloon(flow, jwl.density, mass, Form{charge.shape, charge.centre, Vec3{}, 0, 0, 2}, volume);
  require(ball.fluid_volume() > 0, charge.at,
          name + ": no fluid at its place, so its energy has nowhere to go. Move `centre` into the fluid.");
  Grid const& grid = flow.grid();
  Real diagonal = 0;
  for (int d = 0; d < grid.dimension; ++d)
    diagonal += square(grid.spacing[d] * grid.cells[static_cast<std::size_t>(d)]);
  diagonal = std::sqrt(diagonal);
  while (!ball.tiny() && ball.fluid_volume() < wanted && ball.form().radius < diagonal)
    ball.set_radius(1.01 * ball.form().radius);
  require(
      ball.tiny() || ball.fluid_volume() >= wanted, charge.at,
      fmt::format("{}: {:.4g} kg of explosive fill more than the whole domain; it must be less, or the domain larger.",
                  name, mass));
  ball.fit(wanted);
  Real const density = mass / ball.fluid_volume(), energy = jwl.energy / jwl.density * density;
  State const alone{density, 0, 0, 0, energy};
  Gas const& products = flow.mixture()->products;
  ChargeReport report{name,
                      mass,
                      jwl.energy / jwl.density * mass,
                      jwl.energy / jwl.density * mass / tnt_energy,
                      charge.shape,
                      0,
                      0,
                      density,
                      products.pressure(alone),
                      products.sound_speed(alone)};
  add_extent(report, flow.grid(), ball.form());
  return {std::move(ball), MixtureState{density, 0, 0, 0, energy, density, 1}, std::move(report)};
}

Placed place(Flow& flow, FlowConfig const& config, std::size_t number, FluidVolume const& volume) {
  ChargeConfig const& charge = config.charge[number];
  if (charge.model == "jwl") return place_products(flow, config, number, volume);
  std::string const name = "fluid.charge[" + std::to_string(number) + "]";
  Grid const& grid = flow.grid();
  Gas const& gas = flow.gas();
  Form const form{charge.shape,
                  charge.centre,
                  charge.size.value_or(Vec3{}),
                  charge.radius.value_or(0),
                  charge.length.value_or(0),
                  charge.axis == "x"   ? 0
                  : charge.axis == "y" ? 1
                                       : 2};
  bool const by_amount = charge.mass || charge.energy;
  Real const specific = tnt_energy * charge.tnt_factor.value_or(1);
  Real mass = charge.mass ? *charge.mass : charge.energy.value_or(0) / specific;
  Real energy = charge.energy ? *charge.energy : specific * mass;
  Balloon balloon = by_amount ? grown_balloon(flow, charge.density, mass, form, volume) : Balloon(flow, volume, form);
  Real const filled = balloon.fluid_volume();
  require(filled > 0, charge.at,
          name + ": no fluid at its place, so its energy has nowhere to go. Move `centre` into the fluid.");
  // Above the gas it replaces, not above itself at the ambient pressure: for an ideal gas the same, but detonation
  // products that dense have no state at that pressure.
  Real const ambient = gas.energy_at_rest(config.ambient.density, config.ambient.pressure);
  Real density = 0, content = 0;
  if (by_amount) {
    density = mass / filled;
    content = ambient + energy / filled;
  } else {
    // The rounding of the rim to sample points is taken out of mass and energy; what lies outside the domain or in a
    // wall is lost.
    Real const sampled = sampled_volume(grid, form);
    Real const scale = sampled > 0 ? form.volume(grid.dimension) / sampled : 1;
    Real const excess = (gas.energy_at_rest(*charge.density, *charge.pressure) - ambient) * scale;
    density = *charge.density * scale;
    content = ambient + excess;
    mass = density * filled;
    energy = excess * filled;
  }
  State const inside{density, 0, 0, 0, content};
  require(
      gas.internal_energy(inside) > 0, charge.at,
      fmt::format("{}: {:.4g} kg/m3 with {:.4g} J/kg lie below the reference curve of the gas law: more energy, or a "
                  "larger charge",
                  name, density, energy / mass));
  ChargeReport report{name, mass, energy,  energy / tnt_energy,  charge.shape,
                      0,    0,    density, gas.pressure(inside), gas.sound_speed(inside)};
  add_extent(report, grid, balloon.form());
  return {std::move(balloon), inside, std::move(report)};
}

}  // namespace

State mixed(State const& outside, State const& inside, Real share) {
  if (share == 1) return inside;
  State u;
  for (std::size_t q = 0; q < 5; ++q) u[q] = (1 - share) * outside[q] + share * inside[q];
  return u;
}

std::vector<ChargeReport> measure_charges(Flow& flow, FlowConfig const& config, FluidVolume const& volume) {
  std::vector<ChargeReport> reports;
  for (std::size_t c = 0; c < config.charge.size(); ++c) reports.push_back(place(flow, config, c, volume).report);
  return reports;
}

void add_charges(Flow& flow, FlowConfig const& config, FluidVolume const& volume) {
  for (std::size_t c = 0; c < config.charge.size(); ++c) {
    Placed placed = place(flow, config, c, volume);
    std::visit([&](auto const& inside) { placed.balloon.store(inside); }, placed.inside);
  }
}

std::string describe(ChargeReport const& r, int dimension) {
  char const* const per = dimension == 3 ? "" : dimension == 2 ? "/m" : "/m2";
  return fmt::format(
      "{}: {:.5g} kg{} of gas with {:.5g} MJ{} above the ambient, as energy {:.5g} kg{} of TNT; {} of {} {:.4g} m, "
      "{:.1f} "
      "cells across, at {:.4g} kg/m3 and {:.4g} Pa",
      r.name, r.mass, per, r.energy / 1e6, per, r.tnt_mass, per, r.shape,
      r.shape == "box" ? "least half length" : "radius", r.radius, r.cells_across, r.density, r.pressure);
}

std::string warning(ChargeReport const& r) {
  if (r.cells_across >= fewest_cells_across * (1 - 1e-9)) return {};
  return fmt::format(
      "{} is {:.1f} cells across: below {:.0f} its blast depends on the grid; use smaller cells, or a lower "
      "density of the balloon, which matters near the charge only",
      r.name, r.cells_across, fewest_cells_across);
}

}  // namespace brisance::fluid
