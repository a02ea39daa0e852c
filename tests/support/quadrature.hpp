// Gauss quadrature for exact cell means.
#pragma once

namespace brisance::testing {

/// Integral of f over [low, high] by eight Gauss points in each of `panels` equal parts.
template <class F>
double integral(F const& f, double low, double high, int panels = 1) {
  constexpr double node[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  double sum = 0;
  double const half = 0.5 * (high - low) / panels;
  for (int i = 0; i < panels; ++i) {
    double const middle = low + (2 * i + 1) * half;
    for (int n = 0; n < 4; ++n) sum += half * weight[n] * (f(middle - half * node[n]) + f(middle + half * node[n]));
  }
  return sum;
}

}  // namespace brisance::testing
