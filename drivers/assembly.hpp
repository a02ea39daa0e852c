// A scene becomes domains, owners, effects and a plan: the one place that names every effect.
#pragma once
#include <memory>
#include <vector>

#include "core/model/simulation.hpp"
#include "core/solid/effects.hpp"
#include "core/solid/gauges/gauges.hpp"
#include "core/solid/mesh.hpp"
#include "core/solid/solid.hpp"
#include "core/solid/surface.hpp"
#include "coupling/body_loads/body_loads.hpp"
#include "coupling/cut_cells/cut_cells.hpp"
#include "drivers/scene.hpp"
#include "drivers/wall_survey.hpp"
#include "fluid/diffusion/viscosity.hpp"
#include "fluid/euler.hpp"
#include "fluid/flow.hpp"
#include "fluid/gauges/gauges.hpp"
#include "fluid/source/gravity.hpp"
#include "parallel/partition.hpp"

namespace brisance::drivers {

/// Everything a run holds on this rank. Absent domains and effects are null.
struct World {
  parallel::Comm* comm = nullptr;
  int dimension = 3;
  std::unique_ptr<solid::Mesh> mesh;
  std::shared_ptr<solid::Surface const> surface;  ///< of the reference state, without broken links
  parallel::Partition partition;
  WallSurvey walls;  ///< at the start
  std::unique_ptr<fluid::Flow> flow;
  std::unique_ptr<solid::Solid> solid;
  std::unique_ptr<fluid::Euler> euler;
  std::unique_ptr<fluid::Viscosity> viscosity;
  std::unique_ptr<fluid::Gravity> gravity;
  std::unique_ptr<solid::Dynamics> dynamics;
  std::vector<std::unique_ptr<Effect>> solid_effects;
  std::unique_ptr<coupling::CutCells> cut_cells;
  std::unique_ptr<coupling::BodyLoads> body_loads;
  std::unique_ptr<fluid::Gauges> gauges;
  std::unique_ptr<solid::SolidGauges> solid_gauges;
  std::vector<SampledFiles*> sampled_files;  ///< of the gauges
  Plan plan;
  std::unique_ptr<Simulation> simulation;
};

/// Collective. Builds the world; fields and loads of the initial state are set by `start`, or read from a checkpoint.
/// Errors: scene errors (nothing is written before this returns).
std::unique_ptr<World> assemble(Scene const& scene, parallel::Comm& comm);

/// Owners of blocks (first) and particles on `ranks` ranks, with the work of walls in plain cells: one graph for both
/// (house, section 8). Errors: scene error when there are more ranks than blocks (without a fluid: than particles).
parallel::Partition assign_owners(Scene const& scene, fluid::Grid const* grid, solid::Mesh const* mesh,
                                  std::vector<std::int64_t> const& wall_work_of_block, int ranks);

/// What walls leave of the cells to the fluid; all of it without a coupling.
fluid::FluidVolume fluid_volumes(World const& world);

/// Collective. Initial fields, geometry, forces and loads; takes the reference of the account.
void start(World& world, Scene const& scene);

/// Collective. Lets the effects see a state that is complete: the initial one, or that of a checkpoint.
void start_effects(World& world);

/// The effects this program knows, by scene section, in the order of the catalogue.
std::vector<std::string> const& catalogue();

}  // namespace brisance::drivers
