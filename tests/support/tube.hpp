// A one-dimensional tube run by sweep_box alone: what the tables of theory/fluid.md 8 were made with.
#pragma once
#include <functional>
#include <vector>

#include "fluid/flux/sweep.hpp"
#include "tests/support/riemann.hpp"

namespace brisance::testing {

enum class Ends { outflow, periodic, walls };

class Tube {
 public:
  /// n cells of [low, high]; thresholds of vacuum from the largest density and pressure given.
  Tube(int n, double low, double high, double gamma, Ends ends, double density_scale, double pressure_scale)
      : Tube(n, low, high, fluid::Gas{gamma}, ends, density_scale, pressure_scale) {}
  Tube(int n, double low, double high, fluid::Gas gas, Ends ends, double density_scale, double pressure_scale);
  double h() const { return h_; }
  double edge(int i) const { return low_ + i * h_; }
  fluid::Gas const& gas() const { return gas_; }
  fluid::State& cell(int i) { return cells_[static_cast<std::size_t>(i)]; }
  fluid::State const& cell(int i) const { return cells_[static_cast<std::size_t>(i)]; }
  int size() const { return static_cast<int>(cells_.size()); }
  /// Means of two uniform states that meet at x0.
  void fill(Primitive left, Primitive right, double x0);
  /// Courant number `cfl`, at most 0.3 in the first five steps.
  void run(int order, double end_time, double cfl = 0.9);

  fluid::SweepOptions options;
  std::int64_t limited_faces = 0;
  std::uint64_t health = 0;
  int steps = 0;

 private:
  double low_, h_;
  fluid::Gas gas_;
  Ends ends_;
  std::vector<fluid::State> cells_;
};

}  // namespace brisance::testing
