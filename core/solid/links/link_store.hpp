// The links of a rank, four to a block and field by field; the two passes that turn poses into forces.
#pragma once
#include <span>
#include <vector>

#include "core/solid/links/link_law.hpp"
#include "core/solid/particles.hpp"

namespace brisance::solid {

/// Four links: ends, then every field of LinkRest for the four lanes.  576 bytes, nine cache lines.
struct alignas(64) LinkBlock {
  std::array<Index, lanes> i{}, j{};
  std::array<std::array<double, lanes>, 17> rest{};
};

/// Gaps of four links, as LinkGap has them.
struct alignas(32) GapBlock {
  std::array<double, lanes> opened, squared, flexure;
};

class LinkStore {
 public:
  /// Adds a link at the end; add them in global order.
  void add(Index i, Index j, LinkRest<double> const& rest);
  std::size_t count() const { return count_; }
  std::size_t bytes() const { return blocks_.size() * sizeof(LinkBlock); }
  Index end_i(std::size_t link) const { return blocks_[link / lanes].i[link % lanes]; }
  Index end_j(std::size_t link) const { return blocks_[link / lanes].j[link % lanes]; }
  LinkRest<double> rest(std::size_t link) const;
  std::span<LinkBlock const> records() const { return blocks_; }
  void set_rest(std::size_t link, LinkRest<double> const& rest);

  /// Blocks [first, end) of four links.
  struct Range {
    std::size_t first = 0, end = 0;
  };
  Range all() const { return {0, blocks_.size()}; }
  LinkBlock const& block(std::size_t at) const { return blocks_[at]; }

  /// Adds to `opened` of both ends the volume the links of a range open, m3.
  void add_opened_volume(std::span<Pose const> pose, std::span<double> opened, Range range) const;
  void add_opened_volume(std::span<Pose const> pose, std::span<double> opened) const {
    add_opened_volume(pose, opened, all());
  }
  /// Adds the forces and torques of the links of a range to both ends. `pressure`: lambda epsilon, Pa.
  void add_wrench(std::span<Pose const> pose, std::span<double const> pressure, std::span<Wrench> wrench,
                  Range range) const;
  void add_wrench(std::span<Pose const> pose, std::span<double const> pressure, std::span<Wrench> wrench) const {
    add_wrench(pose, pressure, wrench, all());
  }
  /// The same, and leaves the gaps of the links in `gaps`, four to a block in the order of the store.
  void add_wrench(std::span<Pose const> pose, std::span<double const> pressure, std::span<Wrench> wrench,
                  std::span<GapBlock> gaps, Range range) const;
  /// Energy of the four links of a block without their volumetric part, J; 0 in spare lanes.
  std::array<double, lanes> energy(std::span<Pose const> pose, std::size_t block) const;
  /// add_wrench with the stiffness and bending of link k times share[k]. `share`: one entry for every lane of the
  /// store.
  void add_wrench(std::span<Pose const> pose, std::span<double const> pressure, std::span<double const> share,
                  std::span<Wrench> wrench) const;
  std::size_t blocks() const { return blocks_.size(); }
  std::size_t padded_count() const { return blocks_.size() * lanes; }

 private:
  template <bool with_gaps, class RestOf>
  void add_wrench_of(std::span<Pose const> pose, std::span<double const> pressure, std::span<Wrench> wrench,
                     std::span<GapBlock> gaps, Range range, RestOf rest_of) const;

  // Every particle receives its links one after the other in the order of the store, which is the global order: the
  // sums have the same bits whatever the lane or rank. Lanes left over in the last block have no stiffness and add
  // zero.
  std::vector<LinkBlock> blocks_;
  std::size_t count_ = 0;
};

/// Ends of a link from two poses.
LinkEnds<double> ends_of(Pose const& i, Pose const& j);

}  // namespace brisance::solid
