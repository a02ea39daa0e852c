#include "core/solid/loads/history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/keys.hpp"

namespace brisance::solid {

void TimedFactor::keys(Keys<TimedFactor>& k) {
  k("time", &TimedFactor::time, "s", "time").required();
  k("factor", &TimedFactor::factor, "1", "the value of the load is multiplied by it at this time").required();
}

void PulseConfig::keys(Keys<PulseConfig>& k) {
  k("shape", &PulseConfig::shape, "",
    "step: 1 from its start on, or until its duration is over; ramp: rises over its duration and stays; half_sine, "
    "triangle: rise and fall; smooth: rises as x - sin(2 pi x) / 2 pi and stays")
      .one_of({"step", "ramp", "half_sine", "triangle", "smooth"});
  k("start", &PulseConfig::start, "s", "time at which it begins");
  k("duration", &PulseConfig::duration, "s", "length in time; all but a step need it").above(0);
}

History::History(HistoryConfig const& config, std::string const& load, Location const& at) : pulse_(config.pulse) {
  require(!(pulse_ && !config.history.empty()), at, load + " has a history and a pulse; keep one of them");
  if (pulse_)
    require(pulse_->duration || pulse_->shape == "step", pulse_->at,
            load + ".pulse: a " + pulse_->shape + " needs a duration, such as duration = \"1 ms\"");
  for (TimedFactor const& entry : config.history) {
    require(times_.empty() || entry.time > times_.back(), entry.at,
            load + ".history: times must increase from entry to entry");
    times_.push_back(entry.time);
    factors_.push_back(entry.factor);
  }
}

Real unit_pulse(std::string const& shape, Real theta) {
  constexpr Real pi = std::numbers::pi;
  if (theta < 0) return 0;
  if (shape == "step") return 1;
  if (shape == "ramp") return std::min(theta, 1.0);
  if (shape == "smooth") return theta >= 1 ? 1 : theta - std::sin(2 * pi * theta) / (2 * pi);
  if (theta > 1) return 0;
  return shape == "half_sine" ? std::sin(pi * theta) : 1 - std::abs(2 * theta - 1);
}

Real History::at(Real time) const {
  if (pulse_) {
    Real const since = time - pulse_->start;
    if (pulse_->shape == "step") return since >= 0 && (!pulse_->duration || since < *pulse_->duration) ? 1 : 0;
    return unit_pulse(pulse_->shape, since / *pulse_->duration);
  }
  if (times_.empty()) return 1;
  auto const above = std::upper_bound(times_.begin(), times_.end(), time);
  if (above == times_.begin()) return factors_.front();
  if (above == times_.end()) return factors_.back();
  auto const i = static_cast<std::size_t>(above - times_.begin());
  Real const share = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return (1 - share) * factors_[i - 1] + share * factors_[i];
}

}  // namespace brisance::solid
