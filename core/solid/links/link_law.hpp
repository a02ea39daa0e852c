// The elastic link as functions of values: gap, volumetric strain, force and torques, energy.
// Source: theory/solid.md sections 3-5, variant R (rotated face normal).
#pragma once
#include "core/solid/links/lanes.hpp"

namespace brisance::solid {

/// Constants of a link in the reference frame.  Units: N/m, 1, m2, m, m, N m.
template <class V>
struct LinkRest {
  V stiffness;             ///< k
  V weight;                ///< w_IJ
  Triple<V> area;          ///< S n
  Triple<V> arm_i, arm_j;  ///< r_IJ, r_JI
  V bending[6];            ///< 2/D C: xx, yy, zz, xy, xz, yz
};

/// Where the two ends are.
template <class V>
struct LinkEnds {
  Triple<V> x_i, x_j;
  Turn<V> q_i, q_j;
};

/// What both passes need: current arms, gap, and the face vectors turned by either end.
template <class V>
struct LinkFrame {
  Rotation<V> r_i, r_j;
  Triple<V> a_i, a_j, gap, area_i, area_j, area;
  LinkFrame(LinkRest<V> const& rest, LinkEnds<V> const& at) : r_i(at.q_i), r_j(at.q_j) {
    a_i = r_i * rest.arm_i;
    a_j = r_j * rest.arm_j;
    gap = (at.x_j - at.x_i) + (a_j - a_i);
    area_i = r_i * rest.area;
    area_j = r_j * rest.area;
    area = V(0.5) * (area_i + area_j);
  }
};

/// S du . n: the volume the gap opens (m3); particle I takes w_IJ of it, J the rest.
template <class V>
inline V opened_volume(LinkRest<V> const& rest, LinkEnds<V> const& at) {
  LinkFrame<V> const frame(rest, at);
  return dot(frame.gap, frame.area);
}

/// Force on I (the opposite acts on J) and the torques added to I and subtracted from J, about their centres.
template <class V>
struct LinkWrench {
  Triple<V> force, torque_i, torque_j;
};

/// What criteria of fracture need of a gap: gap . S n (m3), |gap|^2 (m2), energy of bending and twisting (J).
template <class V>
struct LinkGap {
  V opened, squared, flexure;
};

/// `pressure_i`, `pressure_j`: lambda epsilon of the two particles, Pa. `gap`: filled when it is wanted.
template <class V>
inline LinkWrench<V> link_wrench(LinkRest<V> const& rest, LinkEnds<V> const& at, V pressure_i, V pressure_j,
                                 LinkGap<V>* gap = nullptr) {
  LinkFrame<V> const frame(rest, at);
  V const p = multiply_add(rest.weight, pressure_i - pressure_j, pressure_j);  // w_IJ p_I + w_JI p_J
  LinkWrench<V> out;
  out.force = multiply_add(p, frame.area, rest.stiffness * frame.gap);

  // Relative rotation conj(q_I) q_J in the reference axes of I.
  V const q0 = multiply_add(at.q_i.w, at.q_j.w, dot(at.q_i.v, at.q_j.v));
  Triple<V> const q = cross_add(at.q_j.v, at.q_i.v, multiply_add(at.q_i.w, at.q_j.v, V(-1.0) * (at.q_j.w * at.q_i.v)));
  Triple<V> const cq = symmetric_times(rest.bending, q);
  Triple<V> const moment = frame.r_i * cross_add(q, cq, q0 * cq);
  if (gap) *gap = {dot(frame.gap, frame.area), dot(frame.gap, frame.gap), dot(q, cq)};

  Triple<V> const pull = (V(0.5) * p) * frame.gap;
  out.torque_i = cross_add(frame.a_i, out.force, cross_add(pull, frame.area_i, moment));
  out.torque_j = cross_add(frame.a_j, out.force, cross_add(frame.area_j, pull, moment));
  return out;
}

/// Shear, compression, bending and twisting energy of a link, J; the volumetric part belongs to the particles.
template <class V>
inline V link_energy(LinkRest<V> const& rest, LinkEnds<V> const& at) {
  LinkFrame<V> const frame(rest, at);
  Triple<V> const q = cross_add(at.q_j.v, at.q_i.v, multiply_add(at.q_i.w, at.q_j.v, V(-1.0) * (at.q_j.w * at.q_i.v)));
  return multiply_add(V(0.5) * rest.stiffness, dot(frame.gap, frame.gap), dot(q, symmetric_times(rest.bending, q)));
}

/// Small motion of the two ends about the reference state, where nothing is stressed.
template <class V>
struct SmallEnds {
  Triple<V> u_i, turn_i, u_j, turn_j;
};

template <class V>
inline Triple<V> small_gap(LinkRest<V> const& rest, SmallEnds<V> const& at) {
  return (at.u_j + cross(at.turn_j, rest.arm_j)) - (at.u_i + cross(at.turn_i, rest.arm_i));
}

/// `opened_volume` to first order.
template <class V>
inline V small_opened_volume(LinkRest<V> const& rest, SmallEnds<V> const& at) {
  return dot(small_gap(rest, at), rest.area);
}

/// `link_wrench` to first order: the gap and the strains are small of first order, so their product drops out.
template <class V>
inline LinkWrench<V> small_wrench(LinkRest<V> const& rest, SmallEnds<V> const& at, V pressure_i, V pressure_j) {
  V const p = multiply_add(rest.weight, pressure_i - pressure_j, pressure_j);
  LinkWrench<V> out;
  out.force = multiply_add(p, rest.area, rest.stiffness * small_gap(rest, at));
  Triple<V> const moment = symmetric_times(rest.bending, V(0.5) * (at.turn_j - at.turn_i));
  out.torque_i = cross_add(rest.arm_i, out.force, moment);
  out.torque_j = cross_add(rest.arm_j, out.force, moment);
  return out;
}

}  // namespace brisance::solid
