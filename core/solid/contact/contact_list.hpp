// Which particles can touch soon, on this rank and on others: the list of pairs and the poses they need.
#pragma once
#include <memory>
#include <vector>

#include "core/solid/contact/convex.hpp"
#include "core/solid/contact/kinship.hpp"
#include "core/solid/halo.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// A particle of a listed pair.
struct ContactActor {
  GlobalId id = 0;
  Index local = -1;  ///< among the owned particles of the solid; -1: of another rank
  Convex const* shape = nullptr;
  Real density = 0, mass = 0;
  bool held = false;  ///< fixed or prescribed
  Real inverse_mass() const { return held ? 0 : 1 / mass; }
};

/// Two particles that may touch before the list is built anew; places among the actors, a the one with the lower id.
struct ContactPair {
  Index a = 0, b = 0;
  Real touching = 0, near = 0;  ///< squares of the distances of centres below which they can overlap; are near, m2
};

/// Pairs of particles closer than twice their reach, each rank those with an owned end, sorted by ids.
/// The reach of a particle is a fifth of its outer radius: among cells of one body only kin are listed then. The list
/// stays complete until some particle has moved half its reach: until then every pair nearer than its reach is listed.
/// What depends on nearness looks at the reach itself, never at the list, so nothing depends on when the list was
/// built. Source: theory/solid.md section 15 (broad phase with a skin).
class ContactList {
 public:
  /// `self`: unbroken bodies touch themselves too.
  ContactList(Solid& solid, parallel::Comm& comm, bool self);
  ContactList(ContactList const&) = delete;

  /// Collective. Builds the list anew if particles moved too far, links broke or `invalidate` was called; returns
  /// whether it did. Expects: current poses of owned particles.
  bool update();
  void invalidate() { valid_ = false; }
  /// Poses and half velocities of the actors. Collective among neighbours.
  void exchange();
  /// Rows of `width` doubles per actor, from owners to the others. Collective among neighbours.
  void exchange_rows(std::span<double> rows, std::size_t width) { halo_.exchange_rows(comm_, rows, width); }

  std::vector<ContactActor> const& actors() const { return actors_; }
  std::vector<ContactPair> const& pairs() const { return pairs_; }
  Pose const& pose(Index actor) const { return pose_[static_cast<std::size_t>(actor)]; }
  HalfVelocity const& half(Index actor) const { return half_[static_cast<std::size_t>(actor)]; }
  /// Turned corners and normals of an actor, made when first asked for after an exchange.
  PlacedConvex const& placed(Index actor);
  static Real reach(Convex const& shape) { return 0.2 * shape.outer_radius; }
  Real distance2(ContactPair const& pair) const { return norm2(pose(pair.a).x - pose(pair.b).x); }
  /// Are two actors so near that their next step matters?
  bool near(ContactPair const& pair) const { return distance2(pair) < pair.near; }
  /// Owned particles that can touch anything: with a boundary face or a broken link.
  std::vector<Index> const& candidates() const { return candidates_; }
  Convex const& shape(Index local) { return convex(solid_.id(local)); }
  std::size_t bytes() const;
  std::int64_t builds() const { return builds_; }

 private:
  Convex const& convex(GlobalId particle);
  bool moved_too_far() const;
  void choose_candidates();
  std::vector<bool> engaged_bodies();
  void build();

  Solid& solid_;
  parallel::Comm& comm_;
  bool self_;
  Kinship kin_;
  bool valid_ = false;
  std::int64_t builds_ = 0;
  std::uint64_t breaks_seen_ = ~std::uint64_t{0};
  std::vector<std::unique_ptr<Convex>> shapes_;  ///< by shape of the mesh, made when first asked for
  std::vector<Index> candidates_;
  std::vector<Vec3> listed_at_;  ///< of the candidates
  std::vector<ContactActor> actors_;
  std::vector<ContactPair> pairs_;
  std::vector<Index> actor_of_;  ///< by particle; -1
  Halo halo_;
  std::vector<Pose> pose_;
  std::vector<HalfVelocity> half_;
  std::vector<PlacedConvex> placed_;
};

}  // namespace brisance::solid
