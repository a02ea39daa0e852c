// Friction and heat at the moving walls: mirror states of the viscous terms, their face fluxes for the balance of the
// cut cells, and what every piece of the wall receives (theory/fluid.md 5.3).
#pragma once
#include <functional>
#include <vector>

#include "coupling/coupling_config.hpp"
#include "coupling/cut_cells/gas_beside.hpp"
#include "coupling/cut_cells/state_gather.hpp"
#include "coupling/cut_cells/thin_wall_stress.hpp"
#include "coupling/cut_cells/wall_record.hpp"
#include "coupling/cut_cells/wall_sweeper.hpp"
#include "fluid/diffusion/viscosity.hpp"

namespace brisance::coupling {

/// What the gas does to a piece of the wall beyond its pressure.
struct PieceFriction {
  Vec3 force;     ///< on the solid, N
  Real heat = 0;  ///< into the solid, W
};

class ViscousWall : public fluid::ViscousWalls {
 public:
  ViscousWall(BodyWallConfig const& config, fluid::Transport const& transport, fluid::Flow& flow, WallSweeper& sweeper,
              parallel::Comm& comm)
      : config_(config),
        transport_(transport),
        flow_(flow),
        sweeper_(sweeper),
        comm_(comm),
        thin_(config, transport, flow.grid()) {
    sink_.thin = &thin_;
  }

  bool handles(Index block) const override { return sweeper_.handles(block); }
  void prepare() override;
  fluid::FaceSink& sink(Index block, Real weight) override;
  void finish(fluid::Block& block, Real time) override { thin_.finish(block, time); }

  /// Forgets the fluxes of the last step.
  void begin_step();
  /// The geometry was put back: which states of other ranks are needed must be found anew.
  void forget_plan() { planned_ = false; }
  /// Collective. Friction and heat of the pieces of `next` in owned cells, from full cells around them, which are
  /// final; `now`: the record at the start of the step; `moved`: is the geometry another than at the last call?
  /// `own`: state of the gas in front of a piece, for pieces that see no full cell.
  using OwnState = std::function<fluid::State(CutCell const&, Index piece)>;
  void find(WallRecord const& now, WallRecord const& next, bool moved, OwnState const& own);
  /// Of a piece of `next`, once found.
  PieceFriction const& operator[](std::size_t piece) const { return found_[piece]; }
  /// Stress and energy flux over `dt` between the gases on both sides of a face across `direction`, as WallBlock has
  /// them for those of whole cells.
  std::array<Real, 4> between(fluid::State const& low, fluid::State const& high, int direction, Real dt) const;
  /// State of an owned cell, or one around an owned cut cell, once find() has begun.
  fluid::State state(CellIndex c) const;

 private:
  struct Sink : fluid::FaceSink {
    WallBlock* wall = nullptr;
    ThinWallStress const* thin = nullptr;
    Real weight = 0;
    void add(int direction, Index j, Index k, Index faces, Real* stress, std::ptrdiff_t pitch) override;
  };
  /// `gas`: the cells of the gas in front of the piece; nullptr: all around are.
  PieceFriction friction(WallRecord const& now, WallRecord const& next, CutCell const& cut, Index piece,
                         GasBeside const* gas, OwnState const& own) const;

  BodyWallConfig config_;
  fluid::Transport transport_;
  fluid::Flow& flow_;
  WallSweeper& sweeper_;
  parallel::Comm& comm_;
  ThinWallStress thin_;
  Sink sink_;
  GasBeside gas_;
  StateGather around_;    // cells of other ranks in the neighbourhoods of owned cut cells
  bool planned_ = false;  // of `around_`, for the geometry under way
  std::vector<PieceFriction> found_;
};

}  // namespace brisance::coupling
