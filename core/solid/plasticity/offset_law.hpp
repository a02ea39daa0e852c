// What the plastic strain of its ends does to a link: an offset of the gap that the elastic law does not resist.
// Written as what it adds to the elastic law, so that links without plastic strain have no part in it.
// Source: theory/solid.md section 16; the gradient of 1/2 k |gap - R offset|^2 with R the mean of both rotations.
#pragma once
#include "core/solid/links/link_law.hpp"

namespace brisance::solid {

/// Constants of a link and its present offset (d_I e_I + d_J e_J) n.  Units: 1, m, m.
template <class V>
struct LinkOffset {
  Triple<V> normal;
  V reach_i, reach_j;  ///< d_I, d_J: distances of the face from both poles; 0 on the side of a wall
  Triple<V> offset;    ///< reference frame
};

template <class V>
struct OffsetFrame {
  Rotation<V> r_i, r_j;
  Triple<V> a_i, a_j, gap, offset_i, offset_j, offset;
  OffsetFrame(LinkRest<V> const& rest, LinkEnds<V> const& at, LinkOffset<V> const& plastic) : r_i(at.q_i), r_j(at.q_j) {
    a_i = r_i * rest.arm_i;
    a_j = r_j * rest.arm_j;
    gap = (at.x_j - at.x_i) + (a_j - a_i);
    offset_i = r_i * plastic.offset;
    offset_j = r_j * plastic.offset;
    offset = V(0.5) * (offset_i + offset_j);
  }
};

/// Force on I (the opposite acts on J) and torques added to I and subtracted from J, besides those of the elastic law.
template <class V>
inline LinkWrench<V> offset_wrench(LinkRest<V> const& rest, LinkEnds<V> const& at, LinkOffset<V> const& plastic) {
  OffsetFrame<V> const frame(rest, at, plastic);
  LinkWrench<V> out;
  out.force = V(-1.0) * (rest.stiffness * frame.offset);
  Triple<V> const pull = (V(0.5) * rest.stiffness) * (frame.gap - frame.offset);
  out.torque_i = cross_add(frame.a_i, out.force, cross(frame.offset_i, pull));
  out.torque_j = cross_add(frame.a_j, out.force, cross(pull, frame.offset_j));
  return out;
}

/// Energy of the link beyond that of the elastic law, J.
template <class V>
inline V offset_energy(LinkRest<V> const& rest, LinkEnds<V> const& at, LinkOffset<V> const& plastic) {
  OffsetFrame<V> const frame(rest, at, plastic);
  return rest.stiffness * dot(frame.offset, V(0.5) * frame.offset - frame.gap);
}

/// The gap less the offset, as criteria of fracture take it; bending is not its matter.
template <class V>
inline LinkGap<V> elastic_gap(LinkRest<V> const& rest, LinkEnds<V> const& at, LinkOffset<V> const& plastic) {
  OffsetFrame<V> const frame(rest, at, plastic);
  Triple<V> const gap = frame.gap - frame.offset;
  Triple<V> const area = V(0.5) * (frame.r_i * rest.area + frame.r_j * rest.area);
  return {dot(gap, area), dot(gap, gap), V(0.0)};
}

/// -dE/d(e n) per unit of d: force of the link in the mean of both body frames, N.
template <class V>
inline Triple<V> driving_force(LinkRest<V> const& rest, LinkEnds<V> const& at, LinkOffset<V> const& plastic) {
  OffsetFrame<V> const frame(rest, at, plastic);
  Triple<V> const pull = rest.stiffness * (frame.gap - frame.offset);
  return V(0.5) * (frame.r_i.back(pull) + frame.r_j.back(pull));
}

}  // namespace brisance::solid
