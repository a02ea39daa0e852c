// What a fracture criterion sees of one link: opening, slip, stresses, and the energy its break would release.
// Source: theory/solid.md section 14.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/base/real.hpp"

namespace brisance::solid {

/// Constants of a whole link.  Units: m2, m, 1, Pa.
struct Section {
  Real area = 0;     ///< S
  Real length = 0;   ///< D
  Real weight = 0;   ///< w_IJ
  Real modulus = 0;  ///< 2 G of the link: k D / S
};

/// Energy released per area of link by complete damage, by kind.  Units: J/m2.
struct Release {
  Real opening = 0;  ///< by the normal stresses and by bending and twisting
  Real shear = 0;
  Real total() const { return opening + shear; }
};

/// A link at one instant. Stresses are those of its intact part.
struct LinkState {
  Real opening = 0;   ///< du . n, m; negative when closed
  Real slip = 0;      ///< |du_t|, m
  Real normal_i = 0;  ///< sigma_n,I = 2 G du_n / D + lambda epsilon_I, Pa
  Real normal_j = 0;  ///< sigma_n,J
  Real normal = 0;    ///< sigma_n, their mean by weights, Pa; tension is positive
  Real shear = 0;     ///< tau, Pa
  Real flexure = 0;   ///< energy of bending and twisting per area, J/m2
  Real fibre = 0;     ///< largest tensile stress of bending over the face, Pa
  Real stretch = 0;   ///< (|d| - D) / D
  Real rate = 0;      ///< speed of the gap over D, 1/s
  Real volume = 0;    ///< S D, m3
  Section const* section = nullptr;
};

/// The state of a link from its gap. `opened` = gap . S n (m3), `squared` = |gap|^2 (m2) and `flexure` (J) of the whole
/// link; `pressure_i`, `pressure_j` = lambda epsilon of its ends, Pa.
inline LinkState link_state(Section const& link, Real opened, Real squared, Real flexure, Real pressure_i,
                            Real pressure_j) {
  LinkState s;
  s.section = &link;
  s.volume = link.area * link.length;
  s.opening = opened / link.area;
  s.slip = std::sqrt(std::max(squared - s.opening * s.opening, 0.0));
  Real const stiffness = link.modulus / link.length;
  s.normal_i = stiffness * s.opening + pressure_i;
  s.normal_j = stiffness * s.opening + pressure_j;
  s.normal = link.weight * s.normal_i + (1 - link.weight) * s.normal_j;
  s.shear = stiffness * s.slip;
  s.flexure = flexure / link.area;
  return s;
}

/// Y / S = -(dE/dd) / S: exact, a sum of squares.
inline Release release(LinkState const& s) {
  Real const w = s.section->weight, compliance = s.section->length / (2 * s.section->modulus);
  return {compliance * (w * s.normal_i * s.normal_i + (1 - w) * s.normal_j * s.normal_j) + s.flexure,
          compliance * s.shear * s.shear};
}

/// The part of it that drives a crack: compression closes cracks, it does not open them.
inline Release driving_release(LinkState s) {
  s.normal_i = std::max(s.normal_i, 0.0);
  s.normal_j = std::max(s.normal_j, 0.0);
  return release(s);
}

/// Toughness in mixed mode, J/m2.  Source: Benzeggagh and Kenane, G_I + (G_II - G_I) (G_shear / G_total)^eta.
struct MixedToughness {
  Real opening = 0, shear = 0, exponent = 2;
  Real operator()(Release const& g) const {
    Real const total = g.total();
    if (shear == opening || !(total > 0)) return opening;
    return opening + (shear - opening) * std::pow(g.shear / total, exponent);
  }
};

/// Is sqrt(t^2 + 2 k e) below `safe`, with the traction t = k |gap| + |lambda epsilon|, k = 2 G / D, that bounds all
/// stresses of a whole link, and e its energy of bending and twisting per area? Then its law need not look at it.
/// `k`, `k_over_area`: k and 2 k / S.  `pressure`: the larger |lambda epsilon| of its ends, Pa.
inline bool is_safe(Real k, Real k_over_area, Real squared, Real flexure, Real pressure, Real safe) {
  Real const rest = safe - pressure;
  return rest > 0 && k * k * squared + k_over_area * flexure < rest * rest;
}

/// What a law wants to know beyond opening, slip and flexure; everything else is left at zero.
struct Wants {
  bool pressure = false, rate = false, fibre = false, stretch = false;
};

}  // namespace brisance::solid
