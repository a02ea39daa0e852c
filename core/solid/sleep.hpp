// Parts of the solid that nothing has reached yet.
#pragma once
#include <span>
#include <vector>

#include "core/solid/links/link_store.hpp"

namespace brisance::solid {

/// Particles by chunks of their local numbering, links by chunks of their blocks. A chunk of particles sleeps while all
/// of it is in the reference state at rest, without a load. The links between sleeping chunks have no gap, not even a
/// rounded one (Mesh::grain), and so neither strain nor force: leaving them out changes no bit. What has moved once
/// never sleeps again.
class Sleep {
 public:
  static constexpr Index chunk = 16;  ///< particles, a multiple of the lanes
  struct Particles {
    Index first = 0, end = 0;
  };

  /// `count`: particles, owned and ghosts. All chunks sleep.
  Sleep(LinkStore const& links, Index count);
  Index chunks() const { return static_cast<Index>(moved_.size()); }
  Particles particles(Index c) const;
  bool moved(Index c) const { return moved_[static_cast<std::size_t>(c)] != 0; }
  /// May a particle of the chunk feel a force? Those without force need no kick and no drift.
  bool awake(Index c) const { return awake_[static_cast<std::size_t>(c)] != 0; }
  void wake(Index c);
  /// Brings the lists below up to date with what woke.
  void update();

  std::span<LinkStore::Range const> opening() const { return opening_; }  ///< links that may have a gap
  std::span<LinkStore::Range const> pulling() const { return pulling_; }  ///< links that may have a force
  std::span<Particles const> strained() const { return strained_; }       ///< particles at opening links
  std::span<Particles const> awake() const { return awake_particles_; }
  std::int64_t pulling_links() const;

 private:
  Index count_;
  std::size_t blocks_;
  std::vector<std::size_t>
      first_touched_;  // chunks of particles at the ends of a chunk of links, one list after another
  std::vector<Index> touched_;
  std::vector<char> moved_, awake_;
  bool changed_ = true;
  std::vector<LinkStore::Range> opening_, pulling_;
  std::vector<Particles> strained_, awake_particles_;
};

}  // namespace brisance::solid
