// A one-dimensional tube of products and ambient gas run by sweep_mixture alone.
#pragma once
#include <array>
#include <vector>

#include "fluid/flux/mixture_sweep.hpp"

namespace brisance::testing {

class MixtureTube {
 public:
  /// n cells of [0, 1], periodic or open.
  MixtureTube(int n, fluid::Mixture const& mixture, bool periodic)
      : mixture_(mixture), periodic_(periodic), cells_(static_cast<std::size_t>(n)) {}
  int size() const { return static_cast<int>(cells_.size()); }
  double h() const { return 1.0 / size(); }
  fluid::MixtureState& cell(int i) { return cells_[static_cast<std::size_t>(i)]; }
  fluid::MixtureState const& cell(int i) const { return cells_[static_cast<std::size_t>(i)]; }
  fluid::MixtureState total() const;
  /// Courant number `cfl`, at most 0.3 in the first five steps.
  void run(int order, double end_time, double cfl, fluid::SweepOptions const& options = {});
  /// Largest |p/p0 - 1| over the cells and all steps of run(), where p0 > 0 was set.
  double pressure_scale = 0, pressure_error = 0;
  std::int64_t limited_faces = 0;
  std::uint64_t health = 0;
  int steps = 0;

 private:
  fluid::Mixture mixture_;
  bool periodic_;
  std::vector<fluid::MixtureState> cells_;
};

/// TNT products beside a gas of this ratio of specific heats; thresholds of vacuum from a density and a pressure.
fluid::Mixture tnt_in(double gamma, double density, double pressure);
/// Two ideal gases.
fluid::Mixture ideal_pair(double kappa_products, double kappa_ambient);

}  // namespace brisance::testing
