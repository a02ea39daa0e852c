// Rules of the time step and of the sequence of sweeps (theory/fluid.md 3, 4.6), apart from who applies them.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fluid/flow.hpp"
#include "fluid/fluid_volume.hpp"

namespace brisance::fluid {

/// One sweep of a step.
struct Sweep {
  int direction;
  Real share = 1;     ///< of the time step
  Real middle = 0.5;  ///< time at which the sides are taken, in time steps from the start of the step
};
/// Sweeps of step n, in order. `pair`: XYZ|ZYX, YZX|XZY, ZXY|YXZ in 3D (period 6), XY|YX in 2D, X in 1D. `merged`: the
/// two steps of a pair are Strang steps of their own whose adjacent half sweeps are one: X/2 Y X | Y X/2 in 2D, letters
/// exchanged from pair to pair; X/2 Y/2 Z Y/2 X | Y/2 Z Y/2 X/2 in 3D, letters rotating. A quarter of the splitting
/// error for 5/4 (2D) or 3/2 (3D) of the sweeps.  Source: theory/fluid.md 3; Strang 1968.
std::vector<Sweep> sweeps(int dimension, std::int64_t step, Splitting splitting);
/// Largest number of sweeps a step has.
int most_sweeps(int dimension, Splitting splitting);

/// Steps that share one time step and are accepted or rejected together.
inline int steps_per_pair(int dimension) { return dimension == 1 ? 1 : 2; }

/// Cells to skip: per owned block an array [k][j][i] of bytes, non-zero = skipped; null = none.
using CellMask = std::function<std::uint8_t const*(Index block_id)>;

/// Largest |u_d| + c per direction over the cells of this rank that are neither vacuum nor masked, m/s; 0 in absent
/// directions. Not collective: the caller takes the maximum over the ranks.
std::array<Real, 3> signal_speeds(Flow const& flow, CellMask const& skip = {});

/// The same where walls cut the cells: those without fluid volume are skipped.
std::array<Real, 3> signal_speeds(Flow const& flow, FluidVolume const& volume);

/// cfl * min_d h_d / speed_d, s; infinite where nothing moves.
Real acoustic_time_step(Grid const& grid, std::array<Real, 3> const& speeds, Real cfl);
/// The same for the states that enter through sides during a pair of steps from `time`; infinite without any. The same
/// on all ranks.
Real side_time_step(Flow const& flow, Real time, Real cfl);
/// Direction that limits the first.
int limiting_direction(Grid const& grid, std::array<Real, 3> const& speeds);

/// The Courant number of the pair that starts with step n: small while the first waves form.
Real courant_number(int dimension, std::int64_t step, Real nominal);

/// The time step of a pair of `steps` steps from t: shortened when `end` falls inside the pair, so that it is hit
/// exactly.
struct PairStep {
  Real dt;
  bool reaches_end;
};
PairStep shorten(Real t, Real end, Real dt, int steps);

/// The factor on the nominal time step after rejected pairs: halved by each, doubled back by each accepted one.
class Retry {
 public:
  Real factor() const { return factor_; }
  std::int64_t rejected() const { return rejected_; }
  /// Halves the factor; false after ten halvings: give up.
  bool reject();
  void accept() { factor_ = min(1, 2 * factor_); }
  void set(Real factor, std::int64_t rejected) { factor_ = factor, rejected_ = rejected; }  ///< from a checkpoint

 private:
  Real factor_ = 1;
  std::int64_t rejected_ = 0;
};

/// "negative density, Courant number above 1".
std::string describe(std::uint64_t health);

}  // namespace brisance::fluid
