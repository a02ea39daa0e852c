#include "core/solid/links/link_store.hpp"

#include "core/solid/links/link_blocks.hpp"

namespace brisance::solid {

using namespace blocks;

void LinkStore::add(Index i, Index j, LinkRest<double> const& rest) {
  std::size_t const lane = count_ % lanes;
  if (lane == 0) {
    blocks_.emplace_back();
    blocks_.back().i.fill(i);  // spare lanes read poses that exist
    blocks_.back().j.fill(j);
  }
  LinkBlock& block = blocks_.back();
  block.i[lane] = i;
  block.j[lane] = j;
  for_each_field(rest, [&](std::size_t f, double value) { block.rest[f][lane] = value; });
  ++count_;
}

LinkRest<double> LinkStore::rest(std::size_t link) const {
  LinkRest<double> r;
  for_each_field(r, [&](std::size_t f, double& value) { value = blocks_[link / lanes].rest[f][link % lanes]; });
  return r;
}

void LinkStore::set_rest(std::size_t link, LinkRest<double> const& rest) {
  for_each_field(rest, [&](std::size_t f, double value) { blocks_[link / lanes].rest[f][link % lanes] = value; });
}

void LinkStore::add_opened_volume(std::span<Pose const> pose, std::span<double> opened, Range range) const {
  for (std::size_t at = range.first; at < range.end; ++at) {
    LinkBlock const& b = blocks_[at];
    if (at + ahead < blocks_.size())
      for (Index j : blocks_[at + ahead].j) fetch(&pose[static_cast<std::size_t>(j)]);
    LinkRest<Lanes> const rest = read_rest(b);
    Lanes const volume = opened_volume(rest, read_ends(pose.data(), b));
    Lanes const part_i = rest.weight * volume;
    alignas(32) std::array<double, lanes> to_i, to_j;
    part_i.store_aligned(to_i.data());
    (volume - part_i).store_aligned(to_j.data());
    for (std::size_t k = 0; k < lanes; ++k) {
      opened[static_cast<std::size_t>(b.i[k])] += to_i[k];
      opened[static_cast<std::size_t>(b.j[k])] += to_j[k];
    }
  }
}

template <bool with_gaps, class RestOf>
void LinkStore::add_wrench_of(std::span<Pose const> pose, std::span<double const> pressure, std::span<Wrench> wrench,
                              std::span<GapBlock> gaps, Range range, RestOf rest_of) const {
  for (std::size_t at = range.first; at < range.end; ++at) {
    LinkBlock const& b = blocks_[at];
    if (at + ahead < blocks_.size())
      for (Index j : blocks_[at + ahead].j) {
        fetch(&pose[static_cast<std::size_t>(j)]);
        fetch(&wrench[static_cast<std::size_t>(j)]);
      }
    LinkGap<Lanes> gap;
    LinkWrench<Lanes> const w = link_wrench(rest_of(at), read_ends(pose.data(), b), gather(pressure.data(), b.i),
                                            gather(pressure.data(), b.j), with_gaps ? &gap : nullptr);
    if constexpr (with_gaps) {
      gap.opened.store_aligned(gaps[at].opened.data());
      gap.squared.store_aligned(gaps[at].squared.data());
      gap.flexure.store_aligned(gaps[at].flexure.data());
    }
    add_to_ends(b, w, wrench);
  }
}

void LinkStore::add_wrench(std::span<Pose const> pose, std::span<double const> pressure, std::span<Wrench> wrench,
                           Range range) const {
  add_wrench_of<false>(pose, pressure, wrench, {}, range,
                       [this](std::size_t block) { return read_rest(blocks_[block]); });
}

void LinkStore::add_wrench(std::span<Pose const> pose, std::span<double const> pressure, std::span<Wrench> wrench,
                           std::span<GapBlock> gaps, Range range) const {
  add_wrench_of<true>(pose, pressure, wrench, gaps, range,
                      [this](std::size_t block) { return read_rest(blocks_[block]); });
}

void LinkStore::add_wrench(std::span<Pose const> pose, std::span<double const> pressure, std::span<double const> share,
                           std::span<Wrench> wrench) const {
  add_wrench_of<false>(pose, pressure, wrench, {}, all(), [&](std::size_t block) {
    LinkRest<Lanes> rest = read_rest(blocks_[block]);
    Lanes const of = Lanes::load_unaligned(&share[block * lanes]);
    rest.stiffness *= of;
    for (Lanes& c : rest.bending) c *= of;
    return rest;
  });
}

std::array<double, lanes> LinkStore::energy(std::span<Pose const> pose, std::size_t block) const {
  LinkBlock const& b = blocks_[block];
  std::array<double, lanes> energies;
  link_energy(read_rest(b), read_ends(pose.data(), b)).store_unaligned(energies.data());
  return energies;
}

LinkEnds<double> ends_of(Pose const& i, Pose const& j) {
  auto triple = [](Vec3 const& v) { return Triple<double>{v.x, v.y, v.z}; };
  return {triple(i.x), triple(j.x), {i.q.w, triple(i.q.v)}, {j.q.w, triple(j.q.v)}};
}

}  // namespace brisance::solid
