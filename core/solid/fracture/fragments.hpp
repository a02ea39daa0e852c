// Fragments: particles joined by links that are not broken, across ranks.
#pragma once
#include <span>
#include <vector>

#include "core/solid/solid.hpp"
#include "parallel/comm.hpp"

namespace brisance::solid {

/// The fragment of every particle of a rank, named by the smallest id in it, and when it came off.
class Fragments {
 public:
  static constexpr Real never = -1;  ///< time of separation of what is still whole

  /// Collective. The fragments of the present links; times of separation stay.
  void find(Solid& solid, parallel::Comm& comm);
  /// Collective. After breaks: the same, and fragments that lost particles have come off at `time`, s.
  void update(Solid& solid, parallel::Comm& comm, Real time);

  /// Over owned particles and ghosts.
  std::span<GlobalId const> label() const { return label_; }
  /// Particles of the fragment of each owned particle.
  std::span<std::int64_t const> size() const { return size_; }
  /// Time of separation of the fragment of each owned particle, s.
  std::span<Real const> separated() const { return separated_; }
  void set_separated(std::vector<Real> times) { separated_ = std::move(times); }
  /// Labels, sorted, of the fragments that may reach to other ranks.
  std::span<GlobalId const> shared() const { return shared_; }
  std::size_t bytes() const {
    return label_.size() * sizeof(GlobalId) + size_.size() * (sizeof(std::int64_t) + sizeof(Real));
  }

 private:
  void count_particles(Solid const& solid, parallel::Comm& comm);
  std::vector<GlobalId> label_, shared_;
  std::vector<std::int64_t> size_;
  std::vector<Real> separated_;
};

}  // namespace brisance::solid
