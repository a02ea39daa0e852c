// Poses and half velocities of ghosts, from their owners: one message per pair of neighbours.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/solid/particles.hpp"
#include "parallel/comm.hpp"

namespace brisance::solid {

/// Who sends which particles to whom; computed once. Buffers are reused.
class Halo {
 public:
  /// Collective. `ghosts`: local index, id and owner of each, by id; `local` maps ids to local indices.
  struct Ghost {
    Index local;
    GlobalId id;
    int owner;
  };
  void connect(parallel::Comm& comm, std::span<Ghost const> ghosts, std::span<Index const> local);
  void start(parallel::Comm& comm, std::span<Pose const> pose, std::span<HalfVelocity const> half);
  void finish(std::span<Pose> pose, std::span<HalfVelocity> half);
  /// Rows of `width` doubles per particle, from owners to ghosts. Collective among neighbours.
  void exchange_rows(parallel::Comm& comm, std::span<double> rows, std::size_t width);

 private:
  struct Partner {
    int rank;
    std::vector<Index> particles;
    std::vector<double> buffer;
  };
  std::vector<Partner> to_, from_;
  std::unique_ptr<parallel::Comm::Pending> pending_;
};

}  // namespace brisance::solid
