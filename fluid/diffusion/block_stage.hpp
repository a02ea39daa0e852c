// One explicit stage of the viscous terms on one block: rows of primitives in a ring of three planes, every face flux
// computed once, cells updated in place.
#pragma once
#include <span>
#include <vector>

#include "fluid/diffusion/transport.hpp"
#include "fluid/grid/block.hpp"

namespace brisance::fluid {

/// Stages of a step of length tau: Euler U + tau D(U); Heun keeps U_0, makes U_1 = U_0 + tau D(U_0), and then
/// (U_0 + U_1 + tau D(U_1)) / 2.  Source: theory/fluid.md 5.2.
enum class DiffusionStage { euler, heun_first, heun_second };

/// Receives the viscous fluxes of a block: stress on momentum (columns 0 to 2, `pitch` apart) and energy flux (3), per
/// area and time, as they are subtracted from the flux along +direction. Called once for each row of faces along x;
/// face i is on the low side of cell (i, j, k). The cells take what it leaves in `stress`.
struct FaceSink {
  virtual ~FaceSink() = default;
  virtual void add(int direction, Index j, Index k, Index faces, Real* stress, std::ptrdiff_t pitch) = 0;
};

class BlockStage {
 public:
  BlockStage(Transport const& transport, Grid const& grid) : transport_(transport), grid_(grid) {}

  /// Advances the cells of a block whose ghosts of width 1, edges included, are complete. `before`: four values a cell
  /// that last from heun_first to heun_second. `sides`: which ends of the block (x low, x high, y low, ...) to sum;
  /// `through`: sums over their faces of the flux along +direction, per area and time (mass 0), in a fixed order.
  /// `sink`: null, or gets all fluxes, and may change them after those of `through` were summed. Returns the number of
  /// cells that a finished step (euler, heun_second) left outside the admissible set with the bands of
  /// theory/fluid.md 4.4.
  std::int64_t run(Block& block, Real tau, DiffusionStage stage, std::span<Real> before,
                   std::array<bool, 6> const& sides, std::array<State, 6>& through, FaceSink* sink = nullptr);

  static std::size_t before_size(Block const& block) {
    return 4 * static_cast<std::size_t>(block.size()[0]) * static_cast<std::size_t>(block.size()[1] * block.size()[2]);
  }
  std::size_t bytes() const { return scratch_.capacity() * sizeof(Real); }

 private:
  template <int Dimension>
  std::int64_t run_in(Block& block, Real tau, DiffusionStage stage, std::span<Real> before,
                      std::array<bool, 6> const& sides, std::array<State, 6>& through, FaceSink* sink);
  template <int Dimension>
  void load_plane(Block const& block, Index k);
  Real* row(Index j, Index k);  ///< primitives of a row of cells, at i = 0

  Transport transport_;
  Grid const& grid_;
  std::vector<Real> scratch_;
  std::ptrdiff_t pitch_ = 0, rows_ = 0, planes_ = 0;
};

}  // namespace brisance::fluid
