// One gauge through time: rows at multiples of its interval, running impulses, and the figures of the wave that passed.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "core/model/sampled_series.hpp"
#include "fluid/gauges/gauge_config.hpp"
#include "fluid/gauges/gauge_stencil.hpp"

namespace brisance::fluid {

/// What blast engineers ask of a gauge. NaN: has not happened. Overpressure is pressure minus ambient pressure.
/// The positive phase begins when the overpressure first exceeds the arrival pressure and ends when it is back at 0.
/// Units: s, Pa, Pa s.
struct GaugeFigures {
  static constexpr Real never = std::numeric_limits<Real>::quiet_NaN();
  Real arrival = never;                         ///< first time |overpressure| reaches the arrival pressure
  Real peak = never, peak_time = never;         ///< largest overpressure
  Real lowest = never;                          ///< smallest overpressure
  Real phase_start = never, phase_end = never;  ///< of the positive phase
  Real phase_impulse = 0;                       ///< of the positive phase so far
  Real impulse = 0, positive_impulse = 0;       ///< integrals of the overpressure and of its positive part
};

/// Fed with the value after every step; everything in between is linear.
class GaugeHistory : public SampledSeries {
 public:
  GaugeHistory(GaugeConfig const& gauge, FlowConfig const& flow, int dimension);

  std::string header() const override;
  /// The first value; appends the row of this time to `rows` if it is a multiple of the interval.
  void start(Real time, GaugeValue const& value, std::string& rows);
  /// The value one step later; appends the rows of all multiples of the interval up to it.
  void add(Real time, GaugeValue const& value, std::string& rows);
  GaugeFigures const& figures() const { return figures_; }
  std::size_t stored_size() const override { return 21; }
  std::vector<Real> store() const override;
  bool restore(std::span<Real const> stored) override;

 private:
  Real overpressure(GaugeValue const& v) const { return v.pressure - ambient_; }
  void row(Real time, GaugeValue const& v, Real impulse, Real positive, std::string& rows) const;
  void follow(Real t0, Real o0, Real t1, Real o1);
  void extremes(Real time, Real o);

  Vec3 position_;
  Real ambient_, threshold_, gas_constant_;
  int dimension_;
  std::vector<std::string> quantities_;

  GaugeValue last_;
  GaugeFigures figures_;
};

}  // namespace brisance::fluid
