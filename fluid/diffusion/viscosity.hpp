// The effect fluid.viscosity: viscous stress and heat conduction in steps of their own around the sweeps.
#pragma once
#include <limits>

#include "core/model/plan.hpp"
#include "fluid/diffusion/block_stage.hpp"
#include "fluid/diffusion/viscous_sides.hpp"
#include "fluid/flow.hpp"
#include "fluid/fluid_volume.hpp"

namespace brisance::fluid {

/// The largest step that is stable with this kinematic viscosity, s: dt nu max(4/3, gamma / Pr) sum h^-2 <= 0.9, so
/// that a half step uses 0.45 of Heun's 1/2; 0.45 for the whole steps of `lie`. Infinite for 0.  Source:
/// theory/fluid.md 5.2.
Real viscous_time_step(ViscosityConfig const& config, Transport const& transport, Grid const& grid, Real kinematic);

/// What that step leaves to the others, which ask for `others`: below half of them the viscous terms sub-cycle.
Real sub_cycled_limit(ViscosityConfig const& config, Real stable, Real others);

/// Walls inside the grid, as the viscous terms meet them.
struct ViscousWalls {
  virtual ~ViscousWalls() = default;
  virtual bool handles(Index block) const = 0;
  /// Collective. Sets the mirror states of solid cells, before the ghosts of each stage are filled.
  virtual void prepare() = 0;
  /// Receives the fluxes of one stage of a block that it handles, which count for `weight` s; its cells and ghosts are
  /// those the stage starts from. What crosses sides of the domain there is its own affair.
  virtual FaceSink& sink(Index block, Real weight) = 0;
  /// After that stage of that block: what only one cell of a face feels, over `time` s.
  virtual void finish(Block& block, Real time) = 0;
};

/// Beside cut cells V is not sub-cycled and keeps this share of its limit (fluid/README.md).
inline constexpr Real share_at_walls = 1.0 / 3;

/// One step is V(dt/2) S(dt) V(dt/2), S the sweeps and V a Heun step (`strang`), or S(dt) followed by one Euler step
/// V(dt) (`lie`). V is sub-cycled where its limit is below half the step of the others.  Source: theory/fluid.md 5.2.
class Viscosity : public Effect {
 public:
  /// `flow` must outlive this.  Expects: config.viscosity.
  Viscosity(FlowConfig const& config, Flow& flow);
  void join(Plan& plan) override;

  /// Fluid volume of a cell where walls cut cells: cells without any neither limit the step nor are judged.
  void set_fluid_volume(FluidVolume volume) { volume_ = std::move(volume); }

  /// Null: no walls. Not owned. Cut cells exchange once a step: with walls there is no sub-cycling.
  void set_walls(ViscousWalls* walls) { walls_ = walls; }
  Transport const& transport() const { return transport_; }

  /// Local. The largest step the scheme is stable with, s; infinite where no cell holds gas.
  Real stable_step() const;
  /// Collective. V over `dt` in `substeps` equal steps; cells and ledger of the flow change, and the health of this.
  /// `middle`: time at which the sides are taken, that of the sweeps, s.
  void advance(Real dt, int substeps, Real middle = 0);

 private:
  void exchange();
  void stage(Real tau, DiffusionStage stage, Real weight);
  void locate(Block const& block);
  int substeps(Real dt) const;
  std::size_t bytes() const;

  ViscosityConfig config_;
  Flow& flow_;
  Transport transport_;
  ViscousSides sides_;
  Ghosts ghosts_;
  BlockStage block_stage_;
  Real middle_ = 0;
  FluidVolume volume_;
  ViscousWalls* walls_ = nullptr;
  std::vector<std::vector<Real>> before_;                ///< per block: what Heun's second stage needs of U_0
  Real stable_ = std::numeric_limits<Real>::infinity();  ///< stable_step() over all ranks at the start of the pair
  Verdict verdict_;
};

}  // namespace brisance::fluid
