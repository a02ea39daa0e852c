// The solid of one rank: its particles, the ghosts they need, their links, and the verbs of a step.
#pragma once
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/solid/face_tractions.hpp"
#include "core/solid/halo.hpp"
#include "core/solid/links/consistent_strain.hpp"
#include "core/solid/links/link_store.hpp"
#include "core/solid/measures.hpp"
#include "core/solid/mesh.hpp"
#include "core/solid/particles.hpp"
#include "core/solid/plasticity/plastic_strain.hpp"
#include "core/solid/rates/rung.hpp"
#include "core/solid/sleep.hpp"
#include "core/solid/solid_config.hpp"
#include "parallel/comm.hpp"

namespace brisance::solid {

class Surface;

/// Traction on a boundary face that turns with its particle: t = R_I `traction`, Pa.
struct FaceLoad {
  GlobalId particle = 0;
  int face = 0;
  Vec3 traction{};
};

/// The guaranteed time step of the particles and what limits it.
struct StableStep {
  Real dt = 1e300;         ///< s
  GlobalId particle = -1;  ///< the limiting particle
  bool by_rotation = false;
};

/// Rigid particles joined by elastic links, kick-drift-kick with the rotation step of discrete Moser-Veselov form.
/// Source: theory/solid.md sections 3-5, 7, 10, 11, 17.  Shape: owned particles first, then ghosts, both in global
/// order. Bits: the state of owned particles does not depend on how particles are dealt to ranks.
class Solid {
 public:
  /// May links break, so that particles inside come to share vertices of the boundary?
  enum class Opens { never, anywhere };
  /// Collective. `mesh` must outlive the solid. Ghosts: two layers of linked neighbours and, with a surface, every
  /// particle that shares a boundary vertex with an owned one.
  Solid(Mesh const& mesh, SolidConfig const& config, std::vector<int> owner_of_particle, parallel::Comm& comm,
        int dimension, Surface const* surface = nullptr, Opens opens = Opens::never);

  Mesh const& mesh() const { return mesh_; }
  Index owned() const { return owned_; }
  Index count() const { return count_; }
  GlobalId id(Index local) const { return ids_[static_cast<std::size_t>(local)]; }
  Index local(GlobalId id) const { return local_[static_cast<std::size_t>(id)]; }  ///< -1 if absent
  int owner(GlobalId id) const { return owner_[static_cast<std::size_t>(id)]; }
  std::size_t links() const { return links_.count(); }
  std::size_t bytes() const;       ///< memory of the particles of this rank
  std::size_t link_bytes() const;  ///< memory of its links

  // Columns over owned particles and ghosts. Of ghosts, pose and half velocity are current after exchange_pose.
  std::span<Pose const> pose() const { return std::span(pose_).first(static_cast<std::size_t>(count_)); }
  std::span<Pose> pose() { return written_ = true, std::span(pose_).first(static_cast<std::size_t>(count_)); }
  std::span<Motion const> motion() const { return motion_; }
  std::span<Motion> motion() { return written_ = true, std::span(motion_); }
  std::span<HalfVelocity const> half_velocity() const { return half_; }
  std::span<Wrench const> internal() const { return std::span(wrench_).first(static_cast<std::size_t>(count_)); }
  std::span<Wrench const> load() const { return load_; }
  /// External, frozen over a step: owned entries are used.
  std::span<Wrench> load() { return written_ = true, std::span(load_); }

  /// v += dt/2 (F/m + g), spin += dt/2 M, owned particles; books the impulse and work of reactions.
  void half_kick(Real dt);
  /// x += dt v, rotation by the implicit equation; records the half-step velocities. Owned particles.
  void drift(Real dt);
  /// half_kick then drift in one pass over memory: the same bits.
  void kick_and_drift(Real dt);
  /// Poses and half velocities of ghosts from their owners. Collective among neighbours.
  void exchange_pose() { start_exchange(), finish_exchange(); }
  void start_exchange();
  void finish_exchange();
  /// All that happens between the two half kicks of a step: drift and exchange_pose; with multi-rate steps also the
  /// kicks and drifts of the finer levels. Collective among neighbours.
  void move(Real dt);
  /// Poses at the end of a step of `dt` under the present load, in `steps` sub-steps through which links follow the
  /// motion while all other forces stay as they are; half velocities are means over dt. Undo it with restore.
  /// Collective. Source: theory/coupling.md 1.8, 5.  Expects: no multi-rate steps.
  void predict(Real dt, int steps);
  /// Internal forces and torques of owned particles at the current poses. With multi-rate steps those of a level count
  /// with its share of the step, so that they are what both half kicks need. Collective with consistent
  /// strains.
  void compute_forces();
  /// The first part of compute_forces: images, opened volumes and strain pressures at the current poses.
  void compute_strains();
  /// A step without other effects: half_kick, move, forces, half_kick.
  void step(Real dt);
  /// Links computed in one step: those of finer levels as often as they are, those that sleep not at all.
  std::int64_t link_updates() const;
  /// Parts that nothing has reached yet are skipped from now on, if the scene lets them. From then on ask for a column
  /// anew in every stage that writes to it: whoever asks wakes what he changed.
  void let_sleep();
  /// May parts of the solid sleep: the scene's wish, unless gravity, multi-rate steps, moving walls or
  /// images keep all awake?
  bool may_sleep() const { return sleep_ != nullptr; }
  Levels const* levels() const { return rates_ ? &rates_->levels : nullptr; }  ///< null: one step for all

  /// Tractions on boundary faces until the next call; the same list on every rank, each face once.
  /// Expects: free faces of the mesh.  They enter forces and volumetric strains at the next compute_forces.
  void load_faces(std::span<FaceLoad const> loads);
  /// More of them. Returns the place of the first in face_tractions().
  std::size_t add_loaded_faces(std::span<FaceLoad const> loads);
  /// The loaded faces of this rank, in the order in which they were given. After a change of their tractions,
  /// tractions_changed().
  FaceTractions& face_tractions() { return written_ = true, face_tractions_; }
  FaceTractions const& face_tractions() const { return face_tractions_; }
  void tractions_changed() { written_ = true, face_tractions_.open(face_opening_); }

  // Links of this rank, in global order: those of owned particles and of the first layer of ghosts.
  LinkStore const& link_store() const { return links_; }
  std::size_t mesh_link(std::size_t link) const { return mesh_link_[link]; }  ///< its place in Mesh::links
  /// Place of a link of the mesh among those of this rank, if it is here.
  std::optional<std::size_t> local_link(std::size_t mesh_link) const;
  /// lambda epsilon, Pa, and opened volume, m3, at the last compute_forces: right for owned particles and the first
  /// layer of ghosts.
  std::span<double const> pressure() const { return std::span(pressure_).first(static_cast<std::size_t>(count_)); }
  std::span<double const> opened() const { return std::span(opened_).first(static_cast<std::size_t>(count_)); }
  /// Forces of positions are added here after compute_forces: owned entries are used.
  std::span<Wrench> internal() { return written_ = true, std::span(wrench_).first(static_cast<std::size_t>(count_)); }
  /// Rows of `width` doubles per particle (count() rows), from owners to ghosts. Collective among neighbours.
  void exchange_rows(std::span<double> rows, std::size_t width) { halo_.exchange_rows(comm_, rows, width); }

  /// Makes room for plastic strain; without it links are elastic. Source: theory/solid.md section 16.
  void allow_plasticity() { plastic_ = std::make_unique<PlasticStrain>(mesh_, links_, ids_, mesh_link_); }
  PlasticStrain& plastic() { return *plastic_; }  ///< Expects: allow_plasticity.
  /// V times the stress that drives the plastic strain of the first particles, J, at the last compute_strains and the
  /// present plastic strain. `same_poses`: as at the last call.  Expects: allow_plasticity.
  void driving_stress(std::span<Symmetric> to, bool same_poses = false);
  /// S d n.e n: the part of plastic strain in the extension of a loaded face, m3.
  Real plastic_extension(FaceTractions::Face const& face) const;

  /// The motion of a wall in a step: its place and turn at the start and at the end, and the velocities between them.
  struct WallStep {
    Pose from, to;
    Vec3 v, omega;
  };
  /// Of Mesh::motions: the walls that follow it go on from `from`; they arrive at `to` with the next drift.
  void drive_walls(Index motion, WallStep const& step);
  /// Gives an owned particle that is not free another velocity (m/s), spin (kg m2/s) and half velocity; what the change
  /// takes is booked as impulse and work of its support.
  void drive(Index particle, Vec3 const& v, Vec3 const& spin, HalfVelocity const& half);
  /// Owned particles that are fixed or prescribed.
  std::span<Index const> held() const { return held_; }
  /// J w in the fixed frame at the present turn, kg m2/s, and the inverse, rad/s.
  Vec3 spin_of(Index particle, Vec3 const& omega) const;
  Vec3 omega_of(Index particle, Vec3 const& spin) const;

  /// The particle at the far end of a link: behind an image the particle it shows; count() for walls.
  Index end_j(std::size_t link) const;
  /// Poses of both ends of a link; the far one may be a wall or an image.
  LinkEnds<double> link_ends(std::size_t link) const;
  /// Force on particle i of a link and torques about its ends, at the last compute_forces.
  LinkWrench<double> wrench_of(std::size_t link) const;
  /// Energy of a link in this body, J: of a link to a mirror image the half on this side.
  Real link_energy(std::size_t link) const;
  /// S du . n of a link at the present poses: the volume its gap opens, m3.
  Real gap_volume(std::size_t link) const;
  /// Volume opened by the tractions on the faces of a particle, m3.
  Real face_opening(Index particle) const { return face_opening_[static_cast<std::size_t>(particle)]; }
  /// lambda over the effective volume, Pa/m3: pressure() over opened().
  Real bulk(Index particle) const { return bulk_[static_cast<std::size_t>(particle)]; }
  /// A free face of a particle here that something outside holds with the stiffness of its half link: the stable step
  /// counts it as clamped.
  void hold_face(Index particle, int face) { held_faces_.emplace(particle, face); }
  /// How the far end moves between the ends of the step, m/s and rad/s.
  HalfVelocity far_half_velocity(std::size_t link) const;

  /// Makes room for damage; without it every link is whole for ever.
  void allow_damage() {
    intact_.resize(links_.count(), 1.0);
    gaps_.resize(links_.blocks());
  }
  bool damageable() const { return !intact_.empty(); }
  /// 1 - d of a link: 1 whole, 0 broken.
  Real intact(std::size_t link) const { return intact_.empty() ? 1 : intact_[link]; }
  /// Leaves the share `intact` = 1 - d of the stiffness, area and bending of a link; the rest of its face becomes free
  /// on both sides. Every rank that has the link must do the same. Forces follow at the next compute_forces.
  /// Source: theory/solid.md section 14.  Expects: allow_damage.
  void weaken(std::size_t link, Real intact);
  std::size_t broken() const { return broken_; }  ///< links of this rank of which nothing is left
  /// Gaps of the links of this rank, four to a block, at the last compute_forces; `opened` and `flexure` are those of
  /// what is left of a link.  Expects: allow_damage.
  std::span<GapBlock const> gaps() const { return gaps_; }
  /// Changes whenever a link breaks or a broken one is put back: what depends on open faces is then due.
  std::uint64_t breaks() const { return breaks_; }
  /// Does a link that is not broken join two particles? Expects: one of them owned or in the first layer of ghosts.
  bool linked(GlobalId a, GlobalId b) const;

  /// Everything that changes in a step.
  struct Saved {
    std::vector<Pose> pose;
    std::vector<Motion> motion;
    std::vector<HalfVelocity> half;
    std::vector<Wrench> wrench, load;
    std::vector<double> opened, pressure, intact, consistent;
    Reactions reactions;
  };
  enum class Restore { state, state_and_load };
  void save(Saved& to) const;
  /// `state` leaves the external load as it is now: the predictor of a step is undone, its new load stays.
  void restore(Saved const& from, Restore what = Restore::state);

  /// cfl times the stable step of the links, and a rotation of at most 1/4 rad a step. This rank only.
  StableStep stable_limit() const;
  Real stable_step() const { return stable_limit().dt; }
  /// The guaranteed bound without cfl and rotation: the smallest 2/omega_I of owned free particles.
  /// Source: theory/solid.md section 11.
  StableStep link_limit() const;
  /// The bound 2/omega_I of each owned particle, s; 1e300 where it has no link or does not move freely.
  std::span<double const> step_limits() const;
  Real link_limit_of(Index owned) const { return step_limits()[static_cast<std::size_t>(owned)]; }
  /// Collective. Estimate of the limit 2/omega_max of the undamaged links, from above, s: Lanczos on M^-1 K with the
  /// linearised links, at most `products` of them. The same bits on every rank and for any dealing of particles.
  /// Source: theory/solid.md section 11, sharp value.
  Real estimated_limit(int products = 30);

  // The parts of the energy, J: of a particle with its rotation, of its volumetric strain (owned and first layer, at
  // the last compute_forces), and of a link.
  Real kinetic_energy(Index particle) const;
  Real volumetric_energy(Index particle) const {
    auto const at = static_cast<std::size_t>(particle);
    return 0.5 * pressure_[at] * opened_[at];
  }
  /// Adds the sums over owned particles and links to `to`; add over ranks with Comm::sum.
  void measure(Measures& to) const;
  /// Impulse and work of the reactions of fixed, prescribed and clamped parts since the last call; resets them. This
  /// rank.
  Reactions take_reactions();
  /// dt sum (F v_half + M omega_half) of the external load over owned particles, J.
  void add_load_work(Real dt, parallel::ExactSum& to) const;
  /// dt sum F of the same, N s.
  void add_load_impulse(Real dt, std::span<parallel::ExactSum, 3> to) const;
  void digest(parallel::Digest& to) const;

  /// State of one particle in a checkpoint: pose 7, motion 6, internal wrench 6, load 6, half velocities 6.
  static constexpr int row_size = 31;
  std::span<GlobalId const> owned_ids() const { return std::span(ids_).first(static_cast<std::size_t>(owned_)); }
  std::vector<double> pack() const;  ///< rows of owned particles, in the order of owned_ids
  /// Links whose first end is owned, by mesh, and what is left of them.
  std::vector<GlobalId> owned_link_ids() const;
  std::vector<double> pack_intact() const;
  /// Takes the rows of particles present here (owned or ghost) out of `rows`; others are ignored. Strains and forces
  /// follow from exchange_pose and compute_forces, to the same bits.
  void unpack(std::span<GlobalId const> ids, std::span<double const> rows);

 private:
  void choose_particles(Surface const* surface, Opens opens);
  void store_particles();
  void store_links();
  LinkRest<double> rest_of(Link const& link) const;
  Index far_end(Link const& link);
  void place_images();
  void set_bulk(GlobalId particle);
  template <bool with_kick, bool with_drift>
  void advance(Real dt);
  void book_reactions(Real dt);
  void book_clamps(Real dt, LinkStore const& links, std::span<std::size_t const> clamps,
                   std::span<double const> link_share);
  std::vector<double> link_limits() const;
  std::vector<double> volume_limits() const;
  void compute_strains_awake();
  void add_wrench_awake();
  void add_shared_wrench();
  void wake_written();
  void wake_moving();
  void wake_moved_ghosts();
  bool undisturbed(Index local) const;
  std::span<Sleep::Particles const> awake_particles();
  std::span<Sleep::Particles const> awake_particles() const {
    return sleep_ && !written_ ? sleep_->awake() : std::span(&everything_, 1);
  }
  void assign_rates(int most);
  void fill_rung(int level);
  void compute_rung(Rung const& rung);
  void kick_rung(Rung const& rung, Real dt);
  void drift_level(std::span<Index const> particles, Real dt, Real share, bool first);

  Mesh const& mesh_;
  parallel::Comm& comm_;
  int dimension_;
  Real cfl_;
  Real sharp_limit_ = 0;  ///< s; 0 when the scene takes the guaranteed step
  std::optional<Vec3> gravity_;
  std::vector<int> owner_;

  Index owned_ = 0, count_ = 0;
  std::vector<GlobalId> ids_;
  std::vector<Index> local_;
  Halo halo_;

  // Behind the particles the far ends that are none: the wall at rest at the origin, walls that move, images.
  std::vector<Pose> pose_;
  std::vector<Wrench> wrench_;
  std::vector<double> opened_, pressure_;

  std::vector<Motion> motion_;
  std::vector<HalfVelocity> half_;
  std::vector<Wrench> load_;
  std::vector<double> bulk_;          // lambda / effective volume
  std::vector<double> face_opening_;  // volume opened by the tractions on free faces
  std::vector<Index> inertia_of_;
  std::vector<Inertia> inertia_;
  std::vector<std::size_t> mesh_link_;  // links of this rank as indices into the mesh, in global order
  std::vector<Index> held_;             // owned fixed or prescribed particles
  std::vector<std::size_t> clamps_;     // links to a wall or mirror whose particle is owned
  struct Wall {
    Index entry, motion;
    Vec3 v{}, omega{};  // between the ends of the step
    Pose to{};
  };
  std::vector<Wall> walls_;  // those that move
  struct Image {
    Index entry, of, far;
  };
  std::vector<Image> images_;
  std::map<std::pair<Index, Index>, Index> entry_of_;  // (far side, particle or -1) -> entry

  LinkStore links_;
  std::vector<double> intact_;  // 1 - d of the links; empty without damage
  std::size_t broken_ = 0;
  std::vector<GapBlock> gaps_;  // empty without damage
  std::uint64_t breaks_ = 0;
  bool volumetric_ = false;                       // some lambda is not zero
  std::unique_ptr<PlasticStrain> plastic_;        // null: elastic
  std::unique_ptr<ConsistentStrain> consistent_;  // null: basic volumetric term
  FaceTractions face_tractions_;
  std::multimap<Index, int> held_faces_;
  Reactions reactions_;
  std::unique_ptr<Rates> rates_;  // null: one step for all
  std::unique_ptr<Sleep> sleep_;  // null: everything is awake
  bool sleep_allowed_ = false;
  Sleep::Particles everything_{};  // all owned particles
  bool written_ = true;            // someone else may have changed a column since the sleepers were looked at
  mutable std::vector<double> link_limits_;
};

}  // namespace brisance::solid
