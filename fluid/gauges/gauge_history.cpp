#include "fluid/gauges/gauge_history.hpp"

#include <fmt/format.h>

#include <cmath>

namespace brisance::fluid {
namespace {

/// Integral of the positive part of a line from a to b over dt.
Real positive_part(Real a, Real b, Real dt) {
  if (a >= 0 && b >= 0) return 0.5 * (a + b) * dt;
  if (a <= 0 && b <= 0) return 0;
  Real const top = max(a, b);
  return 0.5 * top * top / std::abs(a - b) * dt;
}

/// When a line from (t0, a) to (t1, b) passes `level`, which lies between a and b.
Real crossing(Real t0, Real a, Real t1, Real b, Real level) { return t0 + (level - a) / (b - a) * (t1 - t0); }

}  // namespace

GaugeHistory::GaugeHistory(GaugeConfig const& gauge, FlowConfig const& flow, int dimension)
    : SampledSeries(gauge.interval),
      position_(gauge.position),
      ambient_(flow.ambient.pressure),
      threshold_(gauge.arrival_pressure.value_or(0.01 * flow.ambient.pressure)),
      gas_constant_(flow.gas.gas_constant),
      dimension_(dimension),
      quantities_(quantities(gauge, flow.gas)) {}

std::string GaugeHistory::header() const {
  std::string text = "time";
  for (std::string const& q : quantities_) {
    if (q == "velocity")
      for (int d = 0; d < dimension_; ++d) text += std::string(",velocity_") + "xyz"[d];
    else
      text += "," + q + (q == "impulse" ? ",positive_impulse" : "");
  }
  return text + "\n";
}

void GaugeHistory::row(Real time, GaugeValue const& v, Real impulse, Real positive, std::string& rows) const {
  bool const covered = !(v.fluid_share > 0);
  rows += fmt::format("{:.12g}", time);
  auto const value = [&](Real x, bool known) { rows += known ? fmt::format(",{:.10g}", x) : ","; };
  for (std::string const& q : quantities_) {
    if (q == "density") value(v.density, !covered);
    if (q == "pressure") value(v.pressure, !covered);
    if (q == "overpressure") value(overpressure(v), !covered);
    if (q == "velocity")
      for (int d = 0; d < dimension_; ++d) value(v.velocity[d], !covered);
    if (q == "temperature") value(v.pressure / (v.density * gas_constant_), !covered && v.density > 0);
    if (q == "dynamic_pressure") value(0.5 * v.density * norm2(v.velocity), !covered);
    if (q == "impulse") value(impulse, true), value(positive, true);
  }
  rows += '\n';
}

void GaugeHistory::start(Real time, GaugeValue const& value, std::string& rows) {
  started_ = true;
  time_ = time;
  last_ = value;
  figures_ = {};
  samples_.start(time);
  bool const fluid = value.fluid_share > 0;
  if (fluid) {
    Real const o = overpressure(value);
    extremes(time, o);
    if (std::abs(o) >= threshold_) figures_.arrival = time;
    if (o >= threshold_) figures_.phase_start = time;
  }
  if (auto const t = samples_.take(time)) row(*t, value, 0, 0, rows);
}

void GaugeHistory::add(Real time, GaugeValue const& value, std::string& rows) {
  bool const fluid = last_.fluid_share > 0 && value.fluid_share > 0;
  Real const length = time - time_, o0 = overpressure(last_), o1 = overpressure(value);
  while (auto const t = samples_.take(time)) {
    Real const w = clamp((*t - time_) / length, 0, 1);
    GaugeValue const here = between(last_, value, w);
    Real impulse = figures_.impulse, positive = figures_.positive_impulse;
    if (fluid) {
      Real const o = overpressure(here), part = w * length;
      impulse += 0.5 * (o0 + o) * part;
      positive += positive_part(o0, o, part);
    }
    row(*t, here, impulse, positive, rows);
  }
  if (fluid) {
    follow(time_, o0, time, o1);
    figures_.impulse += 0.5 * (o0 + o1) * length;
    figures_.positive_impulse += positive_part(o0, o1, length);
  }
  if (value.fluid_share > 0) extremes(time, o1);
  time_ = time;
  last_ = value;
}

void GaugeHistory::extremes(Real time, Real o) {
  if (!(o <= figures_.peak)) figures_.peak = o, figures_.peak_time = time;
  if (!(o >= figures_.lowest)) figures_.lowest = o;
}

void GaugeHistory::follow(Real t0, Real o0, Real t1, Real o1) {
  GaugeFigures& f = figures_;
  if (std::isnan(f.arrival) && std::abs(o1) >= threshold_)
    f.arrival = crossing(t0, o0, t1, o1, std::copysign(threshold_, o1));
  if (!std::isnan(f.phase_end)) return;
  if (std::isnan(f.phase_start)) {
    // What precedes the arrival belongs to the phase if the overpressure stays positive until then.
    f.phase_impulse = (o0 > 0 ? f.phase_impulse : 0) + positive_part(o0, o1, t1 - t0);
    if (o1 <= 0) f.phase_impulse = 0;
    if (o1 >= threshold_) f.phase_start = crossing(t0, o0, t1, o1, threshold_);
    return;
  }
  f.phase_impulse += positive_part(o0, o1, t1 - t0);
  if (o1 <= 0) f.phase_end = o0 > 0 ? crossing(t0, o0, t1, o1, 0) : t0;
}

std::vector<Real> GaugeHistory::store() const {
  GaugeFigures const& f = figures_;
  return {position_.x,
          position_.y,
          position_.z,
          samples_.interval(),
          time_,
          last_.density,
          last_.pressure,
          last_.velocity.x,
          last_.velocity.y,
          last_.velocity.z,
          last_.fluid_share,
          static_cast<Real>(samples_.next()),
          f.arrival,
          f.peak,
          f.peak_time,
          f.lowest,
          f.phase_start,
          f.phase_end,
          f.phase_impulse,
          f.impulse,
          f.positive_impulse};
}

bool GaugeHistory::restore(std::span<Real const> s) {
  if (s.size() != stored_size() || Vec3{s[0], s[1], s[2]} != position_ || s[3] != samples_.interval()) return false;
  started_ = true;
  time_ = s[4];
  last_ = {s[5], s[6], {s[7], s[8], s[9]}, s[10]};
  samples_.go_on_at(static_cast<std::int64_t>(s[11]));
  figures_ = {s[12], s[13], s[14], s[15], s[16], s[17], s[18], s[19], s[20]};
  return true;
}

}  // namespace brisance::fluid
