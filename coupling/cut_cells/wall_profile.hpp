// Slopes at a wall of values that are 0 there, by weighted least squares.
#pragma once
#include <array>
#include <cmath>

#include "core/base/vec3.hpp"

namespace brisance::coupling {

/// Fits value = d (a + b d + c . t), d the distance from the wall along its normal and t the place beside it: exact for
/// profiles quadratic in d whose slope varies along the wall. With too few or too flat points it drops c, then b.
class WallProfile {
 public:
  static constexpr std::size_t values = 4;
  using Values = std::array<Real, values>;

  /// `normal`: unit; `scale`: a cell, m.
  WallProfile(Vec3 const& normal, Real scale, int dimension) : scale_(scale), terms_(dimension == 3 ? 4 : 3) {
    Vec3 const other = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    beside_[0] = dimension == 3 ? normalized(cross(normal, other)) : Vec3{-normal.y, normal.x, 0};
    beside_[1] = cross(normal, beside_[0]);
  }

  void add(Real distance, Vec3 const& beside, Values const& value, Real weight) {
    Real const d = distance / scale_;
    std::array<Real, 4> const term{d, d * d, d * dot(beside, beside_[0]) / scale_,
                                   d * dot(beside, beside_[1]) / scale_};
    for (std::size_t i = 0; i < terms_; ++i) {
      for (std::size_t j = 0; j <= i; ++j) matrix_[i][j] += weight * term[i] * term[j];
      for (std::size_t q = 0; q < values; ++q) right_[i][q] += weight * term[i] * value[q];
    }
    ++points_;
  }

  /// a of each value, per metre.  Expects: one point at least, none at the wall.
  Values slopes() const {
    for (std::size_t terms : {terms_, std::size_t{2}, std::size_t{1}})
      if (Values slope; points_ >= terms && solve(terms, slope)) {
        for (Real& s : slope) s /= scale_;
        return slope;
      }
    return {};
  }

 private:
  /// Cholesky; false when the points do not tell the terms apart.
  bool solve(std::size_t terms, Values& slope) const {
    std::array<std::array<Real, 4>, 4> low{};
    for (std::size_t i = 0; i < terms; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        Real sum = matrix_[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= low[i][k] * low[j][k];
        if (i == j) {
          if (!(sum > 1e-3 * matrix_[i][i])) return false;
          low[i][i] = std::sqrt(sum);
        } else {
          low[i][j] = sum / low[j][j];
        }
      }
    for (std::size_t q = 0; q < values; ++q) {
      std::array<Real, 4> x{};
      for (std::size_t i = 0; i < terms; ++i) {
        x[i] = right_[i][q];
        for (std::size_t k = 0; k < i; ++k) x[i] -= low[i][k] * x[k];
        x[i] /= low[i][i];
      }
      for (std::size_t i = terms; i-- > 0;) {
        for (std::size_t k = i + 1; k < terms; ++k) x[i] -= low[k][i] * x[k];
        x[i] /= low[i][i];
      }
      slope[q] = x[0];
    }
    return true;
  }

  Real scale_;
  std::size_t terms_, points_ = 0;
  std::array<Vec3, 2> beside_;
  std::array<std::array<Real, 4>, 4> matrix_{};
  std::array<Values, 4> right_{};
};

}  // namespace brisance::coupling
