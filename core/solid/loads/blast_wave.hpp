// The pressure of an air blast on one face as a function of time.
#pragma once
#include <string>

#include "core/base/vec3.hpp"
#include "core/solid/loads/kingery_bulmash.hpp"
#include "core/solid/loads/load_config.hpp"

namespace brisance::solid {

/// Positive phase of a blast, p = peak (1 - x) exp(-decay x), x = (t - arrival) / duration in [0, 1].
/// Source: the modified equation of Friedlander, UFC 3-340-02 section 2-13.
struct Friedlander {
  Real peak = 0, decay = 0;  ///< Pa, 1
  Real operator()(Real x) const { return x < 0 || x > 1 ? 0 : peak * (1 - x) * std::exp(-decay * x); }
};

/// The decay whose pulse has this impulse: impulse / (peak duration) = (decay - 1 + exp(-decay)) / decay^2.
/// Expects: impulse, peak and duration above 0.
Friedlander friedlander(Real peak, Real impulse, Real duration);

/// What reaches a face: P = Pr cos^2 + Ps (1 + cos^2 - 2 cos), the incident pressure alone when it looks away.
struct BlastWave {
  Real arrival = 0, duration = 0;  ///< s since the start of the scene; s
  Real reflected_share = 0, incident_share = 0;
  Friedlander reflected, incident;
  Real pressure(Real time) const {
    Real const x = (time - arrival) / duration;
    return reflected_share * reflected(x) + incident_share * incident(x);
  }
};

/// The wave on a face with this centroid (m) and outward normal, by distance and angle in the reference state; in 2D
/// and 1D distances lie in the plane or along the axis of the solid.  Source: theory as in kingery_bulmash.hpp; angles:
/// G. Randers-Pehrson, K. Bannister, Airblast loading model for DYNA2D and DYNA3D, ARL-TR-1310 (1997).
/// Errors: scene error naming `load` when the scaled distance leaves the published range.
BlastWave blast_wave(BlastConfig const& config, int dimension, Vec3 const& centroid, Vec3 const& normal,
                     std::string const& load);

}  // namespace brisance::solid
