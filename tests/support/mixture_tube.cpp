#include "tests/support/mixture_tube.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::testing {

using fluid::MixtureState;

MixtureState MixtureTube::total() const {
  MixtureState sum{};
  for (MixtureState const& x : cells_)
    for (std::size_t q = 0; q < 7; ++q) sum[q] += x[q] * h();
  return sum;
}

void MixtureTube::run(int order, double end_time, double cfl, fluid::SweepOptions const& options) {
  Index const n = size(), g = fluid::ghost_depth(order);
  std::array<std::vector<double>, 7> u;
  fluid::MixtureBox box{{}, {n, 1, 1}, {1, n + 2 * g, n + 2 * g}};
  for (std::size_t q = 0; q < 7; ++q) {
    u[q].resize(static_cast<std::size_t>(n + 2 * g));
    box.u[q] = u[q].data() + g;
  }
  double t = 0;
  while (t < end_time) {
    double signal = 0;
    for (MixtureState const& x : cells_)
      if (!mixture_.vacuum(x)) signal = std::max(signal, std::abs(x[1] / x[0]) + mixture_.sound_speed(x));
    double dt = (steps < 5 ? std::min(cfl, 0.3) : cfl) * h() / signal;
    bool const last = t + dt * (1 + 1e-12) >= end_time;
    if (last) dt = end_time - t;
    for (Index i = -g; i < n + g; ++i) {
      Index const from = periodic_ ? (i + n) % n : std::clamp<Index>(i, 0, n - 1);
      for (std::size_t q = 0; q < 7; ++q) box.u[q][i] = cell(from)[q];
    }
    fluid::MixtureReport const report = fluid::sweep_mixture(order, box, 0, dt / h(), mixture_, options);
    for (Index i = 0; i < n; ++i)
      for (std::size_t q = 0; q < 7; ++q) cell(i)[q] = box.u[q][i];
    limited_faces += report.fallback_faces + report.fallback_faces_high_end;
    health |= report.health;
    if (pressure_scale > 0)
      for (MixtureState const& x : cells_) {
        double const error = std::abs(mixture_.pressure(x) / pressure_scale - 1);
        if (!(error <= pressure_error)) pressure_error = error;
      }
    t = last ? end_time : t + dt;
    ++steps;
    if (health != 0) return;
  }
}

fluid::Mixture tnt_in(double gamma, double density, double pressure) {
  fluid::Mixture mixture;
  mixture.products.gamma = 1.3;
  mixture.products.curve = {0, 371.2e9, 3.231e9, 4.15, 0.95, 1630};
  mixture.ambient.gamma = gamma;
  mixture.ambient.vacuum_density = 1e-10 * density;
  mixture.ambient.vacuum_energy = 1e-12 * pressure / (gamma - 1);
  return mixture;
}

fluid::Mixture ideal_pair(double kappa_products, double kappa_ambient) {
  fluid::Mixture mixture;
  mixture.products.gamma = 1 + kappa_products;
  mixture.ambient.gamma = 1 + kappa_ambient;
  mixture.ambient.vacuum_density = 1e-10;
  mixture.ambient.vacuum_energy = 1e-12 / kappa_ambient;
  return mixture;
}

}  // namespace brisance::testing
