// Fields of the output files, computed from the cells when they are written and only then.
#pragma once
#include <string>
#include <vector>

#include "fluid/flow.hpp"
#include "fluid/fluid_volume.hpp"

namespace brisance::fluid {

/// One field over the owned blocks, x fastest within each (the boxes of cell_boxes()).
struct CellField {
  int columns = 1;
  std::vector<double> data;
};

/// The names cell_field() knows: density (kg/m3), pressure, overpressure over the ambient pressure (Pa), velocity
/// (m/s), energy (total, J/m3), temperature (ideal gas, K), sound_speed (m/s), mach (1); density_gradient |grad rho|
/// (kg/m4), schlieren exp(-10 |grad rho| / max |grad rho|): 1 in uniform gas, dark at fronts; vorticity curl u (1/s),
/// its z component in 2D; products (mass of detonation products per volume, kg/m3) and volume_fraction_products (1).
std::vector<std::string> const& cell_field_names();

/// 3 for vectors, else 1.
int cell_field_columns(std::string const& name, int dimension);

/// Collective: derivatives fetch the ghosts of one direction after the other, which every sweep does again, so the
/// state keeps its bits. Differences are central, one-sided at the sides of the domain and beside solid cells (of which
/// nothing is read), 0 in these. The same bits on any number of ranks.
CellField cell_field(Flow& flow, FlowConfig const& config, FluidVolume const& volume, std::string const& name);

/// Errors: scene error for a field twice, products where there are none, a temperature of a gas that is not ideal, a
/// vorticity in 1D.
void check_cell_fields(std::vector<std::string> const& names, FlowConfig const& config, int dimension,
                       Location const& at);

}  // namespace brisance::fluid
