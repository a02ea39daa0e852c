// Viscous fluxes beside walls thinner than two cells: the stencils of a block's faces with mirror states in place of
// what stands beyond the wall.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "coupling/coupling_config.hpp"
#include "coupling/cut_cells/wall_sweeper.hpp"
#include "fluid/diffusion/transport.hpp"

namespace brisance::coupling {

class ThinWallStress {
 public:
  ThinWallStress(BodyWallConfig const& config, fluid::Transport const& transport, fluid::Grid const& grid)
      : config_(config), transport_(transport), grid_(grid) {}

  /// Fluxes of the faces of a block whose stencils reach across a thin wall, from its present cells and ghosts.
  void find(fluid::Block const& block, WallBlock const& wall);
  /// Puts them into a row of faces (fluid::FaceSink::add). A face that parts two gases passes nothing; what each of
  /// them feels there is left to finish().
  void replace(int direction, Index j, Index k, Real* stress, std::ptrdiff_t pitch) const;
  /// What the gases beside such faces feel over `time` s.
  void finish(fluid::Block& block, Real time) const;

 private:
  struct Face {
    int direction;
    CellIndex at;  ///< the cell on its high side
    std::array<Real, 4> flux{};
  };
  struct Felt {
    CellIndex cell;
    int direction, side;
    std::array<Real, 4> flux;
  };
  ApartFace const* apart(CellIndex const& cell, int direction, int side) const;
  fluid::State mirrored(fluid::State const& u, ApartFace const& face) const;
  /// What the gas of a cell has beside it: the next cell, or its own mirror state.
  fluid::State next(CellIndex const& cell, int direction, int side) const;
  std::array<Real, 4> joined(Face const& face) const;
  /// At the wall in front of a cell.
  std::array<Real, 4> at_wall(ApartFace const& face) const;

  BodyWallConfig config_;
  fluid::Transport transport_;
  fluid::Grid const& grid_;
  fluid::Block const* block_ = nullptr;
  std::span<ApartFace const> walls_;
  std::vector<Face> faces_;  ///< by direction and row
  std::vector<Felt> felt_;
};

}  // namespace brisance::coupling
