// One row of verification.csv or stability.csv per measured figure (contract, "Evidence").
#pragma once
#include <string>

namespace brisance::evidence {

/// Records a figure and returns whether it passes: got <= expected * (1 + tolerance) for errors. The row goes to
/// $BRISANCE_EVIDENCE/verification.csv (default: ./evidence), appended under a lock.
bool at_most(std::string const& id, std::string const& name, std::string const& variant, std::string const& quantity,
             double got, double limit);
/// |got - expected| <= tolerance.
bool near(std::string const& id, std::string const& name, std::string const& variant, std::string const& quantity,
          double got, double expected, double tolerance);
/// One hard case of the stability matrix: extremes over cells and steps, largest relative defect of mass, momentum and
/// energy, faces blended with the low-order flux, pairs of steps taken back.
struct Endurance {
  double density_min, pressure_min, conservation;
  long long fallback_faces, retries;
};
/// Records it in stability.csv and returns `ok`.
bool endured(std::string const& id, std::string const& variant, bool ok, Endurance const& figures);
/// True when the full suite was asked for ($BRISANCE_FULL=1): all variants instead of the cheapest.
bool full();

}  // namespace brisance::evidence
