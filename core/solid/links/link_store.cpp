#include "core/solid/links/link_store.hpp"

namespace brisance::solid {
namespace {

double const* numbers(Pose const& p) { return reinterpret_cast<double const*>(&p); }
double* numbers(Wrench& w) { return reinterpret_cast<double*>(&w); }

/// The fields of LinkRest in the order of LinkBlock::rest.
template <class Rest, class Visit>
void for_each_field(Rest& r, Visit visit) {
  std::size_t f = 0;
  for (auto* v : {&r.stiffness, &r.weight, &r.area.x, &r.area.y, &r.area.z, &r.arm_i.x, &r.arm_i.y, &r.arm_i.z,
                  &r.arm_j.x, &r.arm_j.y, &r.arm_j.z})
    visit(f++, *v);
  for (auto& c : r.bending) visit(f++, c);
}

inline Lanes load(LinkBlock const& b, std::size_t field) { return Lanes::load_aligned(b.rest[field].data()); }

inline LinkRest<Lanes> read_rest(LinkBlock const& b) {
  return {load(b, 0),
          load(b, 1),
          {load(b, 2), load(b, 3), load(b, 4)},
          {load(b, 5), load(b, 6), load(b, 7)},
          {load(b, 8), load(b, 9), load(b, 10)},
          {load(b, 11), load(b, 12), load(b, 13), load(b, 14), load(b, 15), load(b, 16)}};
}

/// Four whole poses, transposed in registers.
inline void read_poses(Pose const* pose, std::array<Index, lanes> const& at, Triple<Lanes>& x, Turn<Lanes>& q) {
  double const *p0 = numbers(pose[at[0]]), *p1 = numbers(pose[at[1]]), *p2 = numbers(pose[at[2]]),
               *p3 = numbers(pose[at[3]]);
  Lanes a = Lanes::load_aligned(p0), b = Lanes::load_aligned(p1), c = Lanes::load_aligned(p2),
        d = Lanes::load_aligned(p3);
  transpose(a, b, c, d);
  x = {a, b, c};
  Lanes e = Lanes::load_aligned(p0 + 4), f = Lanes::load_aligned(p1 + 4), g = Lanes::load_aligned(p2 + 4),
        h = Lanes::load_aligned(p3 + 4);
  transpose(e, f, g, h);
  q = {e, {f, g, h}};
}

inline LinkEnds<Lanes> read_ends(Pose const* pose, LinkBlock const& b) {
  LinkEnds<Lanes> ends;
  read_poses(pose, b.i, ends.x_i, ends.q_i);
  read_poses(pose, b.j, ends.x_j, ends.q_j);
  return ends;
}

inline Lanes gather(double const* values, std::array<Index, lanes> const& at) {
  return four_values(values[at[0]], values[at[1]], values[at[2]], values[at[3]]);
}

/// Component-wise values of four links become one record per link.
inline std::array<Lanes, lanes> per_link(Triple<Lanes> const& t) {
  Lanes a = t.x, b = t.y, c = t.z, d(0.0);
  transpose(a, b, c, d);
  return {a, b, c, d};
}

// Ends I come in order and the processor foresees them; ends J jump along the curve and are asked for in advance.
constexpr std::size_t ahead = 12;
inline void fetch(void const* record) { __builtin_prefetch(record); }

inline void add_to(double* at, Lanes const& value) { (Lanes::load_aligned(at) + value).store_aligned(at); }
inline void subtract_from(double* at, Lanes const& value) { (Lanes::load_aligned(at) - value).store_aligned(at); }

}  // namespace

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
    auto const force = per_link(w.force), torque_i = per_link(w.torque_i), torque_j = per_link(w.torque_j);
    for (std::size_t k = 0; k < lanes; ++k) {
      double* to_i = numbers(wrench[static_cast<std::size_t>(b.i[k])]);
      double* to_j = numbers(wrench[static_cast<std::size_t>(b.j[k])]);
      add_to(to_i, force[k]);
      add_to(to_i + 4, torque_i[k]);
      subtract_from(to_j, force[k]);
      subtract_from(to_j + 4, torque_j[k]);
    }
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
