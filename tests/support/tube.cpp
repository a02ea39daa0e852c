#include "tests/support/tube.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/flux_box.hpp"

namespace brisance::testing {

using fluid::State;

Tube::Tube(int n, double low, double high, fluid::Gas gas, Ends ends, double density_scale, double pressure_scale)
    : low_(low), h_((high - low) / n), gas_(gas), ends_(ends), cells_(static_cast<std::size_t>(n)) {
  gas_.vacuum_density = 1e-10 * density_scale;
  gas_.vacuum_energy = 1e-12 * pressure_scale / gas_.kappa();
}

void Tube::fill(Primitive left, Primitive right, double x0) {
  State const l = gas_.conserved(left.density, {left.velocity, 0, 0}, left.pressure);
  State const r = gas_.conserved(right.density, {right.velocity, 0, 0}, right.pressure);
  for (int i = 0; i < size(); ++i) {
    double share = std::clamp((x0 - edge(i)) / h_, 0.0, 1.0);
    if (std::abs(share - std::round(share)) < 1e-9) share = std::round(share);
    for (std::size_t q = 0; q < 5; ++q) cell(i)[q] = share * l[q] + (1 - share) * r[q];
  }
}

void Tube::run(int order, double end_time, double cfl) {
  Index const n = size(), g = fluid::ghost_depth(order);
  FluxBox box({n, 1, 1}, g);
  for (Index i = 0; i < n; ++i) box.set(i, 0, 0, cell(i));
  double t = 0;
  while (t < end_time) {
    double signal = 0;
    for (Index i = 0; i < n; ++i)
      if (State const x = box.get(i, 0, 0); !gas_.vacuum(x))
        signal = std::max(signal, std::abs(x[1] / x[0]) + gas_.sound_speed(x));
    double dt = (steps < 5 ? std::min(cfl, 0.3) : cfl) * h_ / signal;
    if (t + dt * (1 + 1e-12) >= end_time) dt = end_time - t;
    for (Index k = 0; k < g; ++k) {
      auto ghost = [&](Index from_low, Index from_high) {
        State low = box.get(from_low, 0, 0), high = box.get(from_high, 0, 0);
        if (ends_ == Ends::walls) low[1] = -low[1], high[1] = -high[1];
        box.set(-1 - k, 0, 0, low);
        box.set(n + k, 0, 0, high);
      };
      if (ends_ == Ends::periodic) ghost(n - 1 - k, k);
      if (ends_ == Ends::walls) ghost(k, n - 1 - k);
      if (ends_ == Ends::outflow) ghost(0, n - 1);
    }
    auto const report = fluid::sweep_box(order, box.view(), 0, dt / h_, gas_, options);
    limited_faces += report.fallback_faces;
    health |= report.health & ~static_cast<std::uint64_t>(fluid::Health::courant);
    t = dt == end_time - t ? end_time : t + dt;
    ++steps;
  }
  for (Index i = 0; i < n; ++i) cell(i) = box.get(i, 0, 0);
}

}  // namespace brisance::testing
