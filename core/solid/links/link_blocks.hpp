// How the passes over links read a block, its poses, and add to its ends.
#pragma once
#include "core/solid/links/link_store.hpp"

namespace brisance::solid::blocks {

inline double const* numbers(Pose const& p) { return reinterpret_cast<double const*>(&p); }
inline double* numbers(Wrench& w) { return reinterpret_cast<double*>(&w); }

/// The fields of LinkRest in the order of LinkBlock::rest.
template <class Rest, class Visit>
inline void for_each_field(Rest& r, Visit visit) {
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

/// Forces and torques of four links to both ends, lane by lane.
inline void add_to_ends(LinkBlock const& b, LinkWrench<Lanes> const& w, std::span<Wrench> wrench) {
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

}  // namespace brisance::solid::blocks
