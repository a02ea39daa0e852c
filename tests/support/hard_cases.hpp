// The flows of theory/fluid.md 8.3 and 8.4 in one, two and three dimensions, and others as hard; how to run and judge
// one.
#pragma once
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "tests/support/flow_case.hpp"
#include "tests/support/held_cells.hpp"
#include "tests/support/shocks.hpp"

namespace brisance::testing {

struct HardCase {
  std::string id, name;
  fluid::FlowConfig config;
  Real end = 0;
  /// State of a cell at the start; not given: the regions of `config`.
  std::function<fluid::State(fluid::Flow const&, fluid::CellIndex)> start = {};
  std::optional<Held> held = {};
  Real dt_max = std::numeric_limits<Real>::infinity();
  std::int64_t steps = 0;  ///< the end for flows without a time scale, else 0
};

/// A tube of `n` cells with open ends.
HardCase tube_case(Shock const& shock, int n);
HardCase shu_osher_case(int n);
HardCase blast_waves_case(int n);

// Quarter or octant with walls at 0, n cells along each side.
HardCase sedov(int dimension, int n);           ///< F23, to t = 1; spherical: radius 1 too
HardCase noh(int dimension, int n, int order);  ///< F23b, exact ghosts outside [0, 1]; as deep as the order needs
HardCase implosion(int n);                      ///< F24b
HardCase riemann_2d(int n);                     ///< F24a, configuration 3
HardCase double_mach(int n, int order);         ///< F23c, 4 n x n
HardCase jet(int dimension, int n, int order, Real cfl);  ///< F23d, 2 n x n (x n): Mach 2000
HardCase odd_even(int n);                                 ///< F21, 20 n x n
HardCase steady_shock(int order);                         ///< F22, 50 x 25
HardCase vacuum_ball(int dimension, int n);               ///< F25: gas in true vacuum
HardCase collision(int dimension, int n);                 ///< two gases meet at Mach 1000, oblique to the grid
HardCase hot_ball(int dimension, int n, Real ratio);      ///< pressure ratio, in a closed box with one corner empty
/// Periodic box of random cells: density over 6 decades, pressure over 12, Mach up to 1000, one in ten empty.
HardCase random_box(int dimension, int n, unsigned seed, std::int64_t steps);

/// A case in motion.
struct HardRun {
  HardRun(HardCase const& c, int order);
  /// Advances to the end; a numerical failure is told in `failure`. Judges all cells after every pair of steps.
  void run(Real cfl);

  HardCase scene;
  std::unique_ptr<fluid::Flow> flow;
  fluid::FlowClock clock;
  std::unique_ptr<HeldCells> held;
  std::string failure;             ///< empty: none
  Real density_min, pressure_min;  ///< over cells and pairs; a vacuum cell has pressure 0
  Real conservation = 0;           ///< largest defect of mass, momentum, energy at the end, relative
  std::uint64_t health = 0;

 private:
  void judge_cells();
};

/// Calls visit(cell, state) for every cell that is not held.
void for_cells(HardRun const& run, std::function<void(fluid::CellIndex, fluid::State const&)> const& visit);

}  // namespace brisance::testing
