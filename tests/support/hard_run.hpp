// A hard case in motion: advanced with rejection and retry, every cell judged after every pair of steps.
#pragma once
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "fluid/flow_config.hpp"
#include "tests/support/held_cells.hpp"

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
