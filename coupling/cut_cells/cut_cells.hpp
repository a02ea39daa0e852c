// The effect coupling.cut_cells: the conservative exchange between the flow and the moving solid.
// A file per verb: runs and wall_sweeper (sweeps), wall_load (pressure on the solid), balance (contents), mixing;
// time_coupling has what the three schemes differ in.
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "core/model/plan.hpp"
#include "core/model/time_coupling.hpp"
#include "coupling/coupling_config.hpp"
#include "coupling/cut_cells/light_solid.hpp"
#include "coupling/cut_cells/mixing.hpp"
#include "coupling/cut_cells/part_step.hpp"
#include "coupling/cut_cells/stage_account.hpp"
#include "coupling/cut_cells/start_exchange.hpp"
#include "coupling/cut_cells/viscous_wall.hpp"
#include "coupling/cut_cells/wall_cost.hpp"
#include "coupling/cut_cells/wall_surface.hpp"
#include "coupling/cut_cells/wall_sweeper.hpp"
#include "coupling/geometry/swept.hpp"
#include "fluid/fluid_volume.hpp"

namespace brisance::coupling {

class CutCells : public Effect {
 public:
  CutCells(CutCellsConfig const& config, TimeCoupling scheme, fluid::Flow& flow, solid::Solid& solid,
           std::shared_ptr<solid::Surface const> surface, fluid::State const& ambient, parallel::Comm& comm);
  void join(Plan& plan) override;

  /// Collective. Geometry of the initial positions; to be called before the fluid is filled (charges are exact over
  /// fluid volumes), then `begin` once it is.
  void cut_initial_geometry();
  /// Collective. Merges the small cells of the initial fields, sets mirror states and the load of the initial state.
  void begin();

  /// Friction and heat at the walls, for a flow with viscosity. To be called once, before join; the result belongs to
  /// this and must be given to the viscous terms.
  fluid::ViscousWalls& add_viscosity(fluid::Transport const& transport);
  /// Steps beside light solids: `limited` to a share of the gas's own, which has this Courant number. To be called
  /// once, before join.
  void watch_light_solids(Real courant_number, bool limited) { courant_number_ = courant_number, limited_ = limited; }
  /// What a user should know of light solids in a gas of this density everywhere; mostly nothing.
  std::string remark_on_weight(Real density) const;
  /// Sources change the flow at the ends of a step: mirror states are then made anew at its start.
  void expect_sources() { sources_ = true; }

  /// Fluid volume that the state of a cell stands for at the present time, m3; 0 in solid cells. Where a thin wall
  /// divides a cell this is its largest part.
  Real fluid_volume(CellIndex c) const { return record_.solid(c) ? 0 : record_.main_volume(c); }
  /// Share of a cell that is solid.
  Real solid_fraction(CellIndex c) const {
    return record_.solid(c) ? 1 : 1 - record_.volume(c) / flow_.grid().cell_volume();
  }
  /// Calls visit(cell, area, content) for every part of the gas in the cut cells of this rank: the area of the wall
  /// that it touches, a vector from solid to fluid, m2, and the integral of the state.
  void for_parts(std::function<void(CellIndex, Vec3 const&, fluid::State const&)> const& visit) const;
  /// Cells that opposite walls cross, and which keep one state all the same; of this rank, in this record.
  Index undivided_cells() const { return record_.parts.undivided; }
  /// The same as the loops over the cells of the flow want it.
  fluid::FluidVolume fluid_volumes() const {
    return {[this](CellIndex c) { return fluid_volume(c); }, [this](Index block) { return sweeper_.handles(block); }};
  }
  GlobalId cut_cell_count() const;  ///< of this rank's blocks
  WallCost const& cost() const { return cost_; }

 private:
  struct Content {
    GlobalId cell;
    fluid::State amount;  ///< integral over the cell, or over its unit
    Index unit = 0;       ///< of a cell with parts (part_step.hpp)
    friend bool operator<(Content const& a, Content const& b) {
      return a.cell != b.cell ? a.cell < b.cell : a.unit < b.unit;
    }
  };
  static bool same_unit(Content const& a, Content const& b) { return a.cell == b.cell && a.unit == b.unit; }
  // stages
  void begin_step(Clock const& clock);
  void new_geometry();
  /// lag, semi: loads on the boundary of record. Semi: true when the boundary has to follow them once more.
  bool load_solid(Clock const& clock);
  /// explicit: loads on the boundary at t^n.
  void load_at_start(Real dt);
  /// Collective. Friction and heat of the pieces of record_ or next_.
  void find_friction(WallRecord const& wall, bool moved);
  void end_drift(Clock const& clock);
  void update_contents(Real dt);
  void mix();
  void fill();
  /// Collective. The boundary opens where links broke in this step.
  void open_cracks();
  /// Collective. Merges with the cells of all ranks in sight; leaves those of this rank.
  Merging merge_everywhere(std::vector<NearCell>& cells);
  /// Where the solid is lightest beside the gas of this rank; and the step it allows, s.
  std::pair<LightestPlace, Real> weigh() const;
  /// Collective. What a user should know at the end of cells that mixed the gas of their parts; mostly nothing.
  std::string remark_on_mixed() const;
  /// Collective. A remark where the initial gas outweighs the solid.
  void remark_on_start();
  // pieces of them
  /// Collective. Contents of the cells of other ranks in the halo.
  void exchange_near(std::vector<NearCell>& cells);
  void store(std::vector<NearCell> const& cells);
  /// Collective. The members of every group take the linear profile of their group instead of its mean.
  void spread(std::vector<NearCell> const& cells);
  void wall_pressure(WallRecord const& record, bool initial, Real dt, std::vector<CellForce>& forces);
  /// What a part of the wall with this velocity receives in a step is taken from `amount`.
  void take(Vec3 const& force, Real heat, Vec3 const& velocity, Real dt, fluid::State& amount);
  /// So is what the load on this area of a triangle of next_ differs from what the solid receives.
  void take_difference(Index triangle, Real area, Real dt, fluid::State& amount);
  /// What the part of a triangle of next_ received on the boundary at the start.
  void take_part(Index triangle, TrianglePart const& part, StartExchange::Share const& share, Real dt,
                 fluid::State& amount);
  void exchange_at_end(CutCell const& cut, std::size_t unit, Real dt, fluid::State& amount);
  void exchange_of_start(CutCell const& cut, std::size_t unit, Real dt, fluid::State& amount);
  /// Pressures of the sweeps in an owned cell, Pa.
  Vec3 swept_pressure(CellIndex c) const;
  /// What moves out of the domain with the wall leaves the account.
  void exchange_outside(Real dt);
  void transfers();
  /// Collective. Cells around the walls, of this rank and next to it, that hold a vacuum at the start of the step.
  void find_vacuum(WallRecord const& record, bool initial);
  /// A film between walls that face each other, or bodies that overlap. Many of these share the gas of one group: with
  /// the factor of its velocity they would brake it by more than it has. So would any gap of less than a cell above a
  /// reflecting side, where the groups of its cells change as it opens.
  bool between_walls(WallRecord const& record, CutCell const& cut) const;
  /// Collective. Links of the mesh that broke since broken_ was brought up to date, which this does; false if none.
  bool gather_broken();
  /// Collective. Cuts the cells by the predicted boundary; false when it is not closed around some cell of some rank.
  bool build_next();
  /// The balance, a file's worth of steps: transfers, fluxes along an axis, friction, exchange with the wall.
  void pass_transfers(Real dt);
  void pass_fluxes(int d, Real dt);
  void pass_friction(Real dt);
  void pass_exchange(Real dt);
  /// The block with walls that holds an owned cell, and the cell in it.
  std::pair<WallBlock const*, CellIndex> wall_block_of(CellIndex c) const;
  /// A face on a side of the domain: the cell inside, the place in the arrays of its block.
  struct SideFace {
    CellIndex cell;
    std::size_t at;
  };
  /// Calls visit(wall block, side, faces) for the sides of the domain across `d`.
  template <class Visit>
  void for_faces_of_sides(int d, Visit const& visit) const;
  /// What the balance holds, less what came from outside since the last audit.
  Amounts counted() const;
  /// The change of that since the last call is the work of `part`.
  void charge(Part part);
  /// Loads relative to the ambient pressure: the difference from what the fluid gives goes to the account.
  void ambient_account(Real dt);
  /// What the fluid gives where it exerts `chi` times `pressure` on a piece, and what the solid feels of it, N.
  static Vec3 force_of_gas(Real chi, Vec3 const& pressure, Vec3 const& area) {
    return {-chi * pressure.x * area.x, -chi * pressure.y * area.y, -chi * pressure.z * area.z};
  }
  Vec3 force_on_solid(Real chi, Vec3 const& pressure, Vec3 const& area) const;
  void require_identities(Clock const& clock) const;  ///< debug builds
  /// `before_opening`: parts of the record whose contents are handed on to those of the new one.
  void rebuild_record(CellParts const* before_opening = nullptr);
  fluid::State content_before(CellIndex c, std::size_t unit) const;
  // cells that a thin wall divides (divided_cells.cpp)
  /// Collective. Parts at t^n and those of `after`, next_ or the record itself, are matched, and their states known
  /// around the blocks of this rank.
  void follow_parts(WallRecord const& after);
  /// Collective. Is a cell of any rank divided, at t^n or (`next`) t^{n+1}?
  bool any_divided(bool next) const;
  /// The cells whose faces are exchanged part by part: `affected_`.
  void find_affected();
  bool affected(GlobalId cell) const { return std::binary_search(affected_.begin(), affected_.end(), cell); }
  /// Collective. States of the parts of the initial fields.
  void start_parts();
  /// Collective. Contents of the parts after faces parted in the record, whose volumes are what they were.
  void keep_parts(CellParts const& old);
  /// What a unit held at t^n for its volume; none when it is new or was covered.
  std::optional<fluid::State> own_state_before(CellIndex c, std::size_t unit) const;
  /// The same, or what stands in the widest opening of the unit.
  fluid::State state_before(CellIndex c, std::size_t unit) const;
  /// Whether fields and sweeps knew the unit as the cell.
  bool main_before(CellIndex c, std::size_t unit) const {
    CellUnits const* const u = parts_.find(c);
    return !u || u->before[unit] == 0;
  }
  /// Flux through an opening of the high face of `low` between two units, as the cell `at` beside it knows it.
  fluid::State opening_flux(CellIndex low, int d, std::size_t low_unit, std::size_t high_unit, CellIndex at, Real dt);
  /// The same of friction and heat, over the step.
  std::array<Real, 4> opening_stress(CellIndex low, int d, std::size_t low_unit, std::size_t high_unit, CellIndex at,
                                     Real dt);
  /// Calls visit(area, low unit, high unit) for the openings of a unit in a face of an owned cell.
  void for_face(CellIndex c, std::size_t unit, int d, int side,
                std::function<void(Real, std::size_t, std::size_t)> const& visit) const;
  /// State of a minor part in the initial fields.
  fluid::State start_state(CellIndex c, std::size_t part) const;
  /// Pressures on the pieces of a unit, Pa.
  Vec3 unit_pressure(CellIndex c, std::size_t unit) const;
  void measure_unit(CellUnits const* units, std::size_t unit, NearCell& cell) const;
  void link_near(std::vector<NearCell> const& cells);
  std::vector<int> ranks_within(CellIndex c, Index halo) const;
  /// What the profiles add to the flux through a face of `c`, times its area: of its open part, whose centroid is not
  /// that of the face, and of the part that the wall opened or closed in this step.
  fluid::State profile_flux(CellIndex c, int d, int side, Real dt) const;
  Verdict judge() const;
  /// For pairs that are taken back and for checkpoints.
  Plan::Keep keep();
  void account(Ledger& ledger);
  void digest(parallel::Digest& digest) const;
  bool owned(CellIndex c) const;
  /// Factor chi of the wall pressure. `now`: pressures of the cell before each sweep; `dt_per_depth`: step over depth
  /// of the cell before its walls, s/m, negative where bodies overlap.
  Real half_riemann(fluid::State const& u, Vec3 const& wall_velocity, Vec3 const& area, Vec3 const& now,
                    Real dt_per_depth) const;

  CutCellsConfig config_;
  TimeCoupling scheme_;
  bool linear_;  ///< profiles in cut cells
  fluid::Flow& flow_;
  solid::Solid& solid_;
  parallel::Comm& comm_;
  WallSurface surface_;
  WallSweeper sweeper_;
  WallRecord record_, next_;  ///< t^n, t^{n+1}
  bool moved_ = true;         ///< any triangle of any rank moved in this step
  int quiet_ = 0;             ///< steps on end in which no vertex moved or changed its velocity
  bool news_ = true;          ///< in this step some triangle of this rank moved or changed its velocity
  solid::Solid::Saved solid_before_;
  std::vector<bool> broken_, broken_saved_;  ///< links of the mesh; empty when none can break
  std::vector<GlobalId> vacuum_;             ///< by id

  std::vector<Content> kept_, kept_saved_;  ///< contents of covered cells, by id
  std::vector<Content> contents_;           ///< of the cells the balance rewrites, by id
  std::vector<CellIndex> balanced_;         ///< these cells
  std::vector<Real> piece_factor_;          ///< chi of each piece of next_
  std::unique_ptr<ViscousWall> viscous_;    ///< null: the gas has no viscosity
  StartExchange at_start_;                  ///< explicit: what the pieces at t^n receive
  int rounds_ = 0;                          ///< semi: of boundary and loads in this step
  bool sources_ = false;
  Real courant_number_ = 0;
  bool limited_ = false;
  std::vector<Real> areal_mass_;  ///< by element of the surface
  std::function<void(std::string)> remark_;
  std::vector<Swept> swept_;
  struct Transfer {
    GlobalId to, from;  ///< -1: beyond an open side of the domain
    GlobalId state;     ///< the cell whose gas it is
    Real volume;
    std::size_t to_unit, from_unit, state_unit;
    Vec3 place;  ///< about where it comes from, m from the centre of `state`
    Vec3 area, wall_velocity;
  };
  std::vector<Transfer> transfers_;
  std::vector<Content> moved_contents_;
  StateGather swept_states_, around_groups_;
  PartStep parts_;                            ///< cells that a thin wall divides, through the step
  bool divided_ = false;                      ///< on any rank
  std::vector<Content> minor_, minor_saved_;  ///< contents of the parts but the largest of owned cells, at t^n
  std::vector<Content> start_;                ///< initial states (not contents) of the same, until the run begins
  std::vector<Content> minor_near_;           ///< the same around the blocks of this rank
  std::vector<GlobalId> affected_;            ///< divided cells and their neighbours, sorted
  StateGather main_states_;                   ///< of them at t^n
  std::vector<NearLink> links_;
  CellSet near_;  ///< work space
  Verdict health_;

  // increments for the ledger since the last audit
  std::array<parallel::ExactSum, 5> crossed_;
  parallel::ExactSum wall_work_, pressure_impulse_, exchanged_energy_, wall_heat_;
  std::optional<Real> ambient_pressure_;             ///< loads are relative to it, Pa
  std::array<parallel::ExactSum, 4> ambient_given_;  ///< impulse and energy the solid got beyond what the fluid gave
  std::unique_ptr<StageAccount> stage_account_;      ///< null: defects are not charged to stages
  WallCost cost_;
};

}  // namespace brisance::coupling
