// Time coupling `explicit`: what the pieces of the boundary at t^n receive from the gas, paid by the cells in which
// their parts lie at t^{n+1} (theory/coupling.md 1.8).
#pragma once
#include <vector>

#include "coupling/cut_cells/piece_overlap.hpp"
#include "coupling/cut_cells/wall_record.hpp"
#include "fluid/flow.hpp"
#include "parallel/comm.hpp"

namespace brisance::coupling {

class StartExchange {
 public:
  /// What a piece receives, as if the whole triangle received as much per area.
  struct Share {
    Vec3 force;     ///< N
    Real heat = 0;  ///< W
    Real area = 0;  ///< that bears a load, m2
    // Loads relative to the ambient pressure: what the gas gives beyond `force`, and with what power.
    Vec3 beyond{};          ///< N
    Real beyond_power = 0;  ///< W
  };

  /// Nothing yet on the pieces of `record`, the boundary at t^n.
  void begin(WallRecord const& record);
  /// A piece of an owned cell receives this, with the area of the piece.
  void give(WallRecord const& record, std::size_t piece, Share const& received);
  /// Collective. Shares of pieces in the cells of other ranks that lie beside the blocks of this one.
  void exchange(WallRecord const& record, fluid::Flow const& flow, parallel::Comm& comm);

  /// Calls visit(part, share, piece of `record`) for what the pieces of `record` have in common with `piece` of `next`,
  /// in the order of the pieces of `record`: the same on every rank.
  template <class Visit>
  void for_parts(WallRecord const& record, WallRecord const& next, Piece const& piece, Visit&& visit) const {
    SurfaceTriangle const& after = next.triangles[static_cast<std::size_t>(piece.triangle)];
    GlobalId const triangle = after.id;
    for (auto at = first_of(triangle); at < of_triangle_.size() && of_triangle_[at].first == triangle; ++at) {
      auto const place = static_cast<std::size_t>(of_triangle_[at].second);
      Piece const& before = record.geometry.pieces[place];
      TrianglePart const part = part_in_cell(record.geometry.corners_of(before), next.lattice(), after, piece.cell);
      if (part.share > 0) visit(part, shares_[place], before);
    }
  }
  std::size_t bytes() const {
    return shares_.capacity() * sizeof(Share) + of_triangle_.capacity() * sizeof(of_triangle_[0]);
  }

 private:
  std::size_t first_of(GlobalId triangle) const;
  std::vector<Share> shares_;                            ///< by piece of the record
  std::vector<std::pair<GlobalId, Index>> of_triangle_;  ///< triangle, piece; sorted
};

}  // namespace brisance::coupling
