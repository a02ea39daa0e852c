// Sweeps of blocks that hold or neighbour a wall: every run of fluid cells of a pencil is a pencil of its own, with
// mirror states from its own side of the wall at each end (theory/coupling.md 1.9). The kernel is that of the plain
// blocks.
#pragma once
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "coupling/cut_cells/state_gather.hpp"
#include "coupling/cut_cells/wall_record.hpp"
#include "coupling/cut_cells/wall_slopes.hpp"
#include "fluid/flow.hpp"

namespace brisance::coupling {

/// A cell that enters a sweep with a reflected state.
struct MirrorCell {
  Index place = -1;     ///< image cell in WallBlock::images, -1: none
  Index slot = -1;      ///< the same in the gather of all blocks
  Vec3 offset;          ///< of the image from the centre of that cell, m
  Vec3 normal;          ///< unit
  Real wall_speed = 0;  ///< normal velocity of the wall, m/s
  Vec3 wall_velocity;   ///< m/s
};
/// State of the image with its velocity reflected at the moving wall.
fluid::State reflect(fluid::State u, MirrorCell const& mirror);

/// The far side of a face of a cell is not its gas, though no solid cell with a mirror state of this gas lies there: a
/// wall of less than two cells.
struct ApartFace {
  CellIndex cell{};  ///< local, also in the first layer of ghosts
  int direction = 0, side = 0;
  bool solid = false;   ///< the cell beyond holds no gas at all
  bool mirrors = true;  ///< the wall in between was found
  Vec3 normal;          ///< unit
  Vec3 wall_velocity;   ///< m/s
  friend bool operator<(ApartFace const& a, ApartFace const& b) {
    return std::tie(a.cell[2], a.cell[1], a.cell[0], a.direction, a.side) <
           std::tie(b.cell[2], b.cell[1], b.cell[0], b.direction, b.side);
  }
};

/// What the sweeps of one block leave for the balance: the state before the step, and per direction the final flux of
/// every face and the pressure contained in it.
struct WallBlock {
  std::array<Index, 3> size{};
  std::vector<fluid::State> before;               ///< [cell]: U^n, mirror states in solid cells
  std::array<std::vector<fluid::State>, 3> flux;  ///< [face], real coordinates
  std::array<std::vector<Real>, 3> pressure;      ///< [cell], Pa
  /// [face]: viscous stress on momentum and energy flux over the step, times time; empty without viscosity.
  std::array<std::vector<std::array<Real, 4>>, 3> viscous;
  std::size_t cell(Index i, Index j, Index k) const {
    return static_cast<std::size_t>(i + size[0] * (j + size[1] * k));
  }
  /// Face on the low side of cell (i, j, k) along d; i == size along d is the last face.
  std::size_t face(int d, Index i, Index j, Index k) const {
    Index const nx = size[0] + (d == 0), ny = size[1] + (d == 1);
    return static_cast<std::size_t>(i + nx * (j + ny * k));
  }

  struct Run {
    Index begin, end;  ///< non-solid cells along the direction, within the ghosts
    std::array<Index, 2> transverse;
    Index low = -1, high = -1;  ///< wall at this end: entry of `ends`, -1: the run goes on
  };
  struct RunEnd {
    std::array<MirrorCell, 3> mirror;  ///< outwards from the run
    std::array<bool, 3> general{};     ///< no image: the solid cell's general mirror state stands there
  };
  std::array<std::vector<Run>, 3> runs;  ///< longest first
  std::array<std::vector<RunEnd>, 3> ends;
  std::array<std::vector<CellIndex>, 3> parted;         ///< local cells above closed faces between two fluid cells
  std::vector<std::size_t> beside_parted;               ///< cells of the block beside those between two gases, sorted
  std::vector<std::pair<CellIndex, MirrorCell>> solid;  ///< local cells with their general mirror states, sorted by id
  std::vector<GlobalId> images;                         ///< of all mirror cells of the block
  std::vector<ApartFace> apart;                         ///< sorted; empty without viscosity
  /// How the general mirror state of a local solid cell was made; null far from walls.
  MirrorCell const* mirror_at(CellIndex const& local) const;
};

class WallSweeper : public fluid::BlockSweeper {
 public:
  /// `next`: during the sweeps the geometry after the step.
  WallSweeper(fluid::Flow& flow, WallRecord const& next, parallel::Comm& comm)
      : flow_(flow), comm_(comm), next_(next) {}

  /// Blocks keep their faces in thin walls, which viscous terms must not look through. To be called before the first
  /// rebuild.
  void expect_viscosity() { viscous_ = true; }
  /// Collective. New runs, mirrors and images for the geometry of `record`; then the general mirror states are set.
  void rebuild(WallRecord const& record);
  /// Collective. The same for a record that differs from the last one in `changed` only: blocks out of reach of it keep
  /// their runs and closest points.
  void update(WallRecord const& record, std::span<CellBox const> changed);
  /// Collective. The record moved elsewhere in memory but is the same: mirror states of the present fields.
  void keep(WallRecord const& record);
  /// Collective. Puts a mirrored state into every solid cell near the walls; `mirrored`: image -> state.
  void set_mirrors(std::function<fluid::State(fluid::State const&, MirrorCell const&)> const& mirrored);
  /// Is it a solid cell with a face that is inside out, now or after the step? Pieces on both sides feel one pressure.
  bool bound(CellIndex const& c) const;
  /// Keeps U^n of the wall blocks.
  void begin_step();
  /// Collective, after begin_step. Linear profiles at t^n in the cells cut now or after the step (`next`; `same`: it is
  /// the present geometry). Until the next step the cells cut now hold the value of their profile at their centre, and
  /// mirror states are taken at the image itself: the sweeps see a smooth flow that goes on behind the wall.
  /// `plain`: cells that keep their mean whatever their neighbours hold, sorted by id.
  void make_profiles(WallRecord const& next, bool same, std::span<GlobalId const> plain);
  WallSlopes const& profiles() const { return profiles_; }
  /// Is direction a swept before b in this step?
  bool swept_before(int a, int b) const {
    return order_[static_cast<std::size_t>(a)] < order_[static_cast<std::size_t>(b)];
  }

  bool handles(Index block) const override { return blocks_.contains(block); }
  void prepare(int direction, Real dt) override;
  fluid::SweepReport sweep(fluid::Block& block, int direction, Real dt) override;
  /// The pressures of two cells on both sides of a wall thinner than two cells are no shock: neither counts.
  bool is_fluid(fluid::Block const& block, Index i, Index j, Index k) const override;

  std::map<Index, WallBlock>& blocks() { return blocks_; }
  std::map<Index, WallBlock> const& blocks() const { return blocks_; }
  ProfileKind profile_kind = ProfileKind::density;
  fluid::State ambient{};  ///< stands where no image exists
  std::size_t bytes() const;

 private:
  void renew(fluid::Block const& block);
  void gather_images();
  /// Fluid cells that the closed face above `low` parts: the wall between them is thinner than two cells.
  bool two_sides(CellIndex low, int direction) const;
  /// Is the high face of a fluid cell a wall between its gas and that of the next fluid cell?
  bool parted(CellIndex const& low, int direction) const {
    CellIndex high = low;
    ++high[static_cast<std::size_t>(direction)];
    if (two_sides(low, direction)) return true;
    return !record_->parts.empty() && flow_.grid().inside(low) && flow_.grid().inside(high) &&
           !record_->parts.joined(low, direction);
  }
  void find_runs(fluid::Block const& block, WallBlock& wall, int direction);
  void find_apart(fluid::Block const& block, WallBlock& wall);
  /// Does the general mirror state of a solid cell, in a block or beside it, stand for another gas than that of its
  /// neighbour?
  bool mirrors_another(CellIndex const& solid, CellIndex const& gas, fluid::Block const& block, WallBlock const& wall);
  /// Does a face that is parted have different gases on its sides, as far as the next cells tell?
  bool two_gases(CellIndex const& low, int direction);
  /// Does the gas come from one cell to another that is not far away?
  bool one_gas(CellIndex const& a, CellIndex const& b);
  /// Does the stencil of the face between a gas and a solid cell across `direction` see another gas there?
  bool solid_shows_another(CellIndex const& solid, CellIndex const& gas, int direction, fluid::Block const& block,
                           WallBlock const& wall);
  /// Is the low (0) or high (1) face of a cell open, by more than a slit?
  bool wide(CellIndex const& c, int direction, int side) const;
  /// Is the gas of a cell (of its largest part) one with that beyond its low (0) or high (1) face?
  bool passes(CellIndex const& c, int direction, int side) const;
  /// Does it come from one cell to another along the axes, one after the other?
  bool reaches(CellIndex const& home, CellIndex const& image) const;
  /// Fills same_side_: cells around the end of a run and some images that the gas of the run comes to; unless `all` are
  /// wanted, until it holds the images.
  void find_same_side(CellIndex const& home, std::span<CellIndex const> images, bool all);
  /// Is that the gas in front of a piece?
  bool wets(Index piece) const;
  void find_solid(fluid::Block const& block, WallBlock& wall);
  /// A solid cell, the point of the wall next to it and the cell of its image there.
  struct Seen {
    CellIndex cell{};
    Projection wall;
    CellIndex image{};
    bool flooded = false;  ///< only cells of same_side_ may mirror it
  };
  Seen look(CellIndex c, int direction, int side, Index& hint) const;
  /// May `n` mirror it? `direction` < 0: for the general mirror state.
  bool in_front(CellIndex const& n, Seen const& seen, int direction) const;
  /// Of the cells beyond a run that ends with `home`.
  void keep_to_own_side(CellIndex const& home, std::span<Seen> seen, int direction, int side);
  MirrorCell mirror(Seen const& seen, int direction, std::vector<GlobalId>& wanted) const;
  void refresh_mirrors();
  fluid::State image(MirrorCell const& mirror) const;
  /// Lowers the order of the faces of a run near cut cells, in its lane of scratch_order_.
  void calm(fluid::Block const& block, WallBlock::Run const& run, int direction, Index longest, std::size_t lane);
  /// Is the face, now or after the step, inside out by more than `part` of a face?
  bool turned(CellIndex const& c, int direction, int side, Real part) const;
  Real pressure_of_solid(fluid::Block const& block, CellIndex const& local) const;
  /// Mean over the pieces in two cells, m/s.
  Vec3 wall_velocity_beside(CellIndex const& low, CellIndex const& high) const;
  void flux_between_solids(fluid::Block const& block, WallBlock& wall, int direction, Real sigma) const;
  /// Nothing but pressure goes through a reflecting side, to round-off.
  void close_reflecting_sides(fluid::Block& block, WallBlock& wall, int direction, Real sigma,
                              fluid::SweepReport& total) const;

  fluid::Flow& flow_;
  parallel::Comm& comm_;
  WallRecord const* record_ = nullptr;
  WallRecord const& next_;
  bool viscous_ = false;
  bool any_parted_ = false;  ///< faces in the blocks of this rank
  std::map<Index, WallBlock> blocks_;
  StateGather images_;
  std::vector<GlobalId> image_cells_;   ///< by slot
  WallSlopes profiles_, image_slopes_;  ///< of cut cells; of images
  bool profiled_ = false;               ///< the blocks hold states at centres, and images have slopes
  std::array<int, 3> order_{};          ///< place of each direction in the sweeps of this step
  int sweeps_ = 0;                      ///< begun in this step
  Vec3 done_, under_way_;               ///< time for which each direction has been swept in this step, s
  CellSet near_, same_side_;
  std::vector<Real> scratch_u_, scratch_result_, scratch_flux_, scratch_pressure_;
  std::vector<std::uint8_t> scratch_order_;
  std::vector<std::uint32_t> scratch_marks_;
};

}  // namespace brisance::coupling
