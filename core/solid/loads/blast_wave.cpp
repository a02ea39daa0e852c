#include "core/solid/loads/blast_wave.hpp"

#include <cmath>
#include <cstdio>

#include "core/base/errors.hpp"

namespace brisance::solid {
namespace {

/// (b - 1 + exp(-b)) / b^2: the impulse of a pulse of height and length 1; falls from large values to 0.
Real unit_impulse(Real b) {
  if (std::abs(b) < 1e-3) return 0.5 - b / 6 + b * b / 24 - b * b * b / 120;
  return (b + std::expm1(-b)) / (b * b);
}

}  // namespace

Friedlander friedlander(Real peak, Real impulse, Real duration) {
  Real const wanted = impulse / (peak * duration);
  Real low = -1, high = 1;
  while (unit_impulse(low) < wanted) low *= 2;
  while (unit_impulse(high) > wanted) high *= 2;
  for (int halving = 0; halving < 200 && high - low > 1e-15 * (std::abs(low) + std::abs(high)); ++halving) {
    Real const middle = 0.5 * (low + high);
    (unit_impulse(middle) > wanted ? low : high) = middle;
  }
  return {peak, 0.5 * (low + high)};
}

BlastWave blast_wave(BlastConfig const& config, int dimension, Vec3 const& centroid, Vec3 const& normal,
                     std::string const& load) {
  Vec3 ray = centroid - config.centre;
  for (int d = dimension; d < 3; ++d) ray[d] = 0;
  Burst const burst = config.burst == "air" ? Burst::air : Burst::surface;
  Real const distance = norm(ray), size = std::cbrt(config.mass * config.tnt_factor), scaled = distance / size;
  ScaledRange const range = range_of(burst);
  if (!(scaled >= range.low && scaled <= range.high)) {
    char text[320];
    std::snprintf(
        text, sizeof text,
        ": a face at (%.6g, %.6g, %.6g) m is %.6g m from the charge, a scaled distance of %.4g m/kg^(1/3); the "
        "curves for a burst \"%s\" are published from %.3g to %.3g. Select other faces, move the charge, or "
        "compute the blast with a fluid",
        centroid.x, centroid.y, centroid.z, distance, scaled, config.burst.c_str(), range.low, range.high);
    scene_error(config.at, load + text);
  }
  ScaledBlast const blast = kingery_bulmash(burst, scaled);
  Real const duration = size * blast.duration;
  // Angle between the ray and the inward normal.
  Real const cosine = -dot(ray, normal) / distance;
  BlastWave wave;
  wave.arrival = config.start + size * blast.arrival;
  wave.duration = duration;
  wave.reflected = friedlander(blast.reflected_pressure, size * blast.reflected_impulse, duration);
  wave.incident = friedlander(blast.incident_pressure, size * blast.incident_impulse, duration);
  wave.reflected_share = cosine > 0 ? cosine * cosine : 0;
  wave.incident_share = cosine > 0 ? 1 + cosine * cosine - 2 * cosine : 1;
  return wave;
}

}  // namespace brisance::solid
