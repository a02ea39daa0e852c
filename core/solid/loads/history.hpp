// How a load changes in time: a factor on its value.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/location.hpp"
#include "core/base/real.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// Factor on the value of a load at a time.  Units: s, 1.
struct TimedFactor {
  double time = 0, factor = 0;
  Location at;
  static void keys(Keys<TimedFactor>& k);
};

/// A standard pulse of height 1.  Units: s.
struct PulseConfig {
  std::string shape = "step";
  double start = 0;
  std::optional<double> duration;
  Location at;
  static void keys(Keys<PulseConfig>& k);
};

/// What every load has besides its value: a table of factors, or a pulse; neither: constant.
struct HistoryConfig {
  std::vector<TimedFactor> history;
  std::optional<PulseConfig> pulse;
  template <class T>
  static void declare(Keys<T>& k);
};

/// The factor as a function of time.
class History {
 public:
  /// Errors: scene error at `load` when a table and a pulse are given, times do not increase, or a pulse lacks its
  /// duration.
  History(HistoryConfig const& config, std::string const& load, Location const& at);
  /// Tables are linear between their entries, constant before the first and after the last.
  Real at(Real time) const;
  bool constant() const { return !pulse_ && times_.empty(); }

 private:
  std::vector<Real> times_, factors_;
  std::optional<PulseConfig> pulse_;
};

/// A pulse of unit duration: `theta` is the time since its start over its duration. `step` is 1 from its start on.
Real unit_pulse(std::string const& shape, Real theta);

}  // namespace brisance::solid
