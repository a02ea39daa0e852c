#include "fluid/cell_fields.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "fluid/cell_state.hpp"

namespace brisance::fluid {
namespace {

constexpr Real schlieren_contrast = 10;

std::size_t cells_of(Flow const& flow) {
  std::size_t n = 0;
  for (Block const& block : flow.blocks()) {
    auto const [nx, ny, nz] = block.size();
    n += static_cast<std::size_t>(std::int64_t{nx} * ny * nz);
  }
  return n;
}

template <class Visit>
void for_cells(Flow const& flow, Visit&& visit) {
  for (Block const& block : flow.blocks()) {
    auto const [nx, ny, nz] = block.size();
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) visit(block, i, j, k);
  }
}

/// Of products the law of the gas knows no vacuum: their density tells.
Vec3 velocity(Flow const& flow, State const& u) {
  bool const vacuum = flow.mixture() ? !(u[0] > flow.gas().vacuum_density) : flow.gas().vacuum(u);
  return vacuum ? Vec3{} : Vec3{u[1], u[2], u[3]} / u[0];
}

/// Collective. Calls visit(n, low, high, distance) for every owned cell, the n-th, that has a fluid neighbour along
/// `direction`: the difference of the two states over the distance is its slope.
template <class Visit>
void for_slopes(Flow& flow, FluidVolume const& volume, int direction, Visit&& visit) {
  flow.ghosts().start(direction);
  flow.ghosts().finish(direction);
  Grid const& grid = flow.grid();
  auto const d = static_cast<std::size_t>(direction);
  std::size_t n = 0;
  for_cells(flow, [&](Block const& block, Index i, Index j, Index k) {
    std::size_t const cell = n++;
    bool const cut = volume.cuts(block.id());
    // The state `offset` cells along the direction, the cell's own where there is none.
    auto const neighbour = [&](Index offset) -> Index {
      CellIndex c{block.first()[0] + i, block.first()[1] + j, block.first()[2] + k};
      c[d] += offset;
      bool const present = (c[d] >= 0 && c[d] < grid.cells[d]) || grid.periodic[d];
      return present && (!cut || volume(c) > 0) ? offset : 0;
    };
    if (cut && !(volume({block.first()[0] + i, block.first()[1] + j, block.first()[2] + k}) > 0)) return;
    Index const low = neighbour(-1), high = neighbour(1);
    if (low == high) return;
    auto const state = [&](Index offset) {
      CellIndex c{i, j, k};
      c[d] += offset;
      return block.load(c[0], c[1], c[2]);
    };
    visit(cell, state(low), state(high), (high - low) * grid.spacing[direction]);
  });
}

std::vector<double> density_gradient(Flow& flow, FluidVolume const& volume) {
  std::vector<double> size(cells_of(flow), 0);
  for (int d = 0; d < flow.grid().dimension; ++d)
    for_slopes(flow, volume, d, [&](std::size_t cell, State const& low, State const& high, Real distance) {
      size[cell] += square((high[0] - low[0]) / distance);
    });
  for (double& x : size) x = std::sqrt(x);
  return size;
}

std::vector<double> schlieren(Flow& flow, FluidVolume const& volume) {
  std::vector<double> shade = density_gradient(flow, volume);
  double steepest = 0;
  for (double const x : shade) steepest = std::max(steepest, x);
  flow.comm().max(std::span(&steepest, 1));
  for (double& x : shade) x = steepest > 0 ? std::exp(-schlieren_contrast * x / steepest) : 1;
  return shade;
}

/// curl u: component a gains the slope of u_c along b and loses that of u_b along c, (a, b, c) cyclic.
std::vector<double> vorticity(Flow& flow, FluidVolume const& volume, std::size_t columns) {
  std::vector<double> curl(columns * cells_of(flow), 0);
  for (int d = 0; d < flow.grid().dimension; ++d)
    for_slopes(flow, volume, d, [&](std::size_t cell, State const& low, State const& high, Real distance) {
      Vec3 const slope = (velocity(flow, high) - velocity(flow, low)) / distance;
      int const next = (d + 1) % 3, before = (d + 2) % 3;
      auto const component = [&](int a) -> double* {
        if (columns == 1) return a == 2 ? &curl[cell] : nullptr;
        return &curl[3 * cell + static_cast<std::size_t>(a)];
      };
      if (double* const w = component(before)) *w += slope[next];
      if (double* const w = component(next)) *w -= slope[before];
    });
  return curl;
}

}  // namespace

std::vector<std::string> const& cell_field_names() {
  static std::vector<std::string> const names{"density",
                                              "pressure",
                                              "overpressure",
                                              "velocity",
                                              "energy",
                                              "temperature",
                                              "sound_speed",
                                              "mach",
                                              "density_gradient",
                                              "schlieren",
                                              "vorticity",
                                              "products",
                                              "volume_fraction_products"};
  return names;
}

int cell_field_columns(std::string const& name, int dimension) {
  return name == "velocity" || (name == "vorticity" && dimension == 3) ? 3 : 1;
}

CellField cell_field(Flow& flow, FlowConfig const& config, FluidVolume const& volume, std::string const& name) {
  CellField field;
  field.columns = cell_field_columns(name, flow.grid().dimension);
  if (name == "density_gradient") return {field.columns, density_gradient(flow, volume)};
  if (name == "schlieren") return {field.columns, schlieren(flow, volume)};
  if (name == "vorticity") return {field.columns, vorticity(flow, volume, static_cast<std::size_t>(field.columns))};
  field.data.reserve(cells_of(flow) * static_cast<std::size_t>(field.columns));
  auto const scalar = [&](auto const& value) {
    for_cells(flow, [&](Block const& block, Index i, Index j, Index k) {
      field.data.push_back(value(CellState(flow, block, i, j, k)));
    });
  };
  using Cell = CellState;
  if (name == "density") {
    scalar([](Cell const& cell) { return cell.density(); });
  } else if (name == "pressure") {
    scalar([](Cell const& cell) { return cell.pressure(); });
  } else if (name == "overpressure") {
    scalar([&](Cell const& cell) { return cell.pressure() - config.ambient.pressure; });
  } else if (name == "energy") {
    scalar([](Cell const& cell) { return cell.energy(); });
  } else if (name == "temperature") {
    scalar(
        [&](Cell const& cell) { return cell.vacuum() ? 0 : flow.gas().temperature(cell.density(), cell.pressure()); });
  } else if (name == "sound_speed") {
    scalar([](Cell const& cell) { return cell.sound_speed(); });
  } else if (name == "mach") {
    scalar([](Cell const& cell) { return cell.vacuum() ? 0 : norm(cell.velocity()) / cell.sound_speed(); });
  } else if (name == "velocity") {
    for_cells(flow, [&](Block const& block, Index i, Index j, Index k) {
      Vec3 const v = Cell(flow, block, i, j, k).velocity();
      field.data.insert(field.data.end(), {v.x, v.y, v.z});
    });
  } else if (name == "products") {
    scalar([](Cell const& cell) { return cell.products(); });
  } else if (name == "volume_fraction_products") {
    scalar([](Cell const& cell) { return cell.products_fraction(); });
  } else {
    throw Error(Failure::scene, "output.fields: there is no fluid field `" + name + "`. Did you mean `" +
                                    nearest(name, cell_field_names()) + "`?");
  }
  return field;
}

void check_cell_fields(std::vector<std::string> const& names, FlowConfig const& config, int dimension,
                       Location const& at) {
  for (std::string const& name : names) {
    require(std::count(names.begin(), names.end(), name) == 1, at, "output.fields lists \"" + name + "\" twice");
    require(name != "temperature" || (config.gas.law == "ideal" && !config.products), at,
            "output.fields: only an ideal gas has a temperature: leave it out");
    require((name != "products" && name != "volume_fraction_products") || config.products, at,
            "output.fields: \"" + name + "\" needs detonation products: add products = { law = \"jwl\" } to [fluid]");
    require(name != "vorticity" || dimension > 1, at, "output.fields: there is no vorticity in one dimension");
  }
}

}  // namespace brisance::fluid
