// What a closed surface leaves of one cell, by exact arithmetic: the oracle of the cut-cell geometry. In grid units.
#pragma once
#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>

#include <array>
#include <vector>

#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::testing::exact {

using coupling::CellIndex;
using Number = CGAL::Exact_rational;
template <class N>
using Point = std::array<N, 3>;
template <class N>
using Tetrahedron = std::array<Point<N>, 4>;

template <class N = Number>
Point<N> point(Vec3 const& x) {
  return {N(x.x), N(x.y), N(x.z)};
}

template <class N>
N determinant(Tetrahedron<N> const& t) {
  std::array<Point<N>, 3> e;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t d = 0; d < 3; ++d) e[i][d] = t[i + 1][d] - t[0][d];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// Where the edge from a to b meets the plane, at heights ha and hb of opposite sign. Coordinates that both ends share
/// stay as they are, which keeps intervals thin and ties certain.
template <class N>
Point<N> crossing(Point<N> const& a, Point<N> const& b, N const& ha, N const& hb, std::size_t d, int plane) {
  N const s = ha / (ha - hb);
  Point<N> p;
  for (std::size_t k = 0; k < 3; ++k) {
    N const width = b[k] - a[k];
    p[k] = a[k] + s * width;
  }
  p[d] = N(plane);
  return p;
}

/// Keeps the part of the tetrahedra with sign * (x_d - plane) <= 0.
template <class N>
void cut(std::vector<Tetrahedron<N>>& all, std::size_t d, int plane, int sign) {
  std::vector<Tetrahedron<N>> kept;
  for (auto const& t : all) {
    std::vector<std::size_t> in, out;
    std::array<N, 4> height;
    for (std::size_t v = 0; v < 4; ++v) {
      height[v] = N(sign) * (t[v][d] - N(plane));
      (height[v] <= N(0) ? in : out).push_back(v);
    }
    auto const at = [&](std::size_t a, std::size_t b) { return crossing(t[a], t[b], height[a], height[b], d, plane); };
    // A wedge between two triangles is three tetrahedra.
    auto const wedge = [&](std::array<Point<N>, 3> const& a, std::array<Point<N>, 3> const& b) {
      kept.push_back({a[0], a[1], a[2], b[0]});
      kept.push_back({a[1], a[2], b[0], b[1]});
      kept.push_back({a[2], b[0], b[1], b[2]});
    };
    if (in.size() == 4) kept.push_back(t);
    if (in.size() == 1) kept.push_back({t[in[0]], at(in[0], out[0]), at(in[0], out[1]), at(in[0], out[2])});
    if (in.size() == 3)
      wedge({t[in[0]], t[in[1]], t[in[2]]}, {at(in[0], out[0]), at(in[1], out[0]), at(in[2], out[0])});
    if (in.size() == 2)
      wedge({t[in[0]], at(in[0], out[0]), at(in[0], out[1])}, {t[in[1]], at(in[1], out[0]), at(in[1], out[1])});
  }
  all = std::move(kept);
}

/// Signed volume of a tetrahedron within a cell of the unit lattice.
template <class N>
N within(Tetrahedron<N> const& t, CellIndex const& cell) {
  N const whole = determinant(t);
  if (whole == N(0)) return N(0);
  std::vector<Tetrahedron<N>> parts{t};
  for (std::size_t d = 0; d < 3; ++d) {
    cut(parts, d, cell[d], -1);
    cut(parts, d, cell[d] + 1, 1);
  }
  N sum(0);
  for (auto const& p : parts) sum += CGAL::abs(determinant(p));
  return (whole > N(0) ? sum : N(-sum)) / N(6);
}

/// A number from intervals where they decide every sign and stay below `width`, else from rationals. `f(N)` computes it
/// in the numbers of its argument. Counts what needed rationals.
template <class F>
Real evaluate(F const& f, long& rational) {
  try {
    CGAL::Protect_FPU_rounding<true> const rounding;
    CGAL::Interval_nt<false> const x = f(CGAL::Interval_nt<false>{});
    if (x.sup() - x.inf() <= 1e-14) return 0.5 * (x.sup() + x.inf());
  } catch (CGAL::Uncertain_conversion_exception const&) {
  }
  ++rational;
  return CGAL::to_double(f(Number{}));
}

using Triangle = std::array<Vec3, 3>;  ///< in grid units

inline bool misses(Triangle const& t, Vec3 const& apex, CellIndex const& cell) {
  for (int d = 0; d < 3; ++d) {
    Real const c = cell[static_cast<std::size_t>(d)];
    if (min(min(t[0][d], t[1][d]), min(t[2][d], apex[d])) >= c + 1) return true;
    if (max(max(t[0][d], t[1][d]), max(t[2][d], apex[d])) <= c) return true;
  }
  return false;
}

/// Integral over the cell of the winding number of the closed surface, from tetrahedra.
inline Real winding(std::vector<Triangle> const& surface, CellIndex const& cell, long& rational) {
  Vec3 const apex = surface.front()[0];
  return evaluate(
      [&]<class N>(N) {
        N sum(0);
        for (auto const& t : surface)
          if (!misses(t, apex, cell))
            sum += within<N>({point<N>(apex), point<N>(t[0]), point<N>(t[1]), point<N>(t[2])}, cell);
        return sum;
      },
      rational);
}

/// A polygon cut to sign * (x_d - plane) <= 0.
template <class N>
void keep(std::vector<Point<N>>& p, std::size_t d, int plane, int sign) {
  std::vector<Point<N>> q;
  for (std::size_t i = 0; i < p.size(); ++i) {
    Point<N> const &u = p[i], &v = p[(i + 1) % p.size()];
    N const hu = N(sign) * (u[d] - N(plane)), hv = N(sign) * (v[d] - N(plane));
    bool const in = hu <= N(0), next = hv <= N(0);
    if (in) q.push_back(u);
    if (in != next) q.push_back(crossing(u, v, hu, hv, d, plane));
  }
  p = std::move(q);
}

/// The part of a triangle in the row of cells along d through `cell`; empty when it is beside it.
template <class N>
std::vector<Point<N>> in_row(Triangle const& t, CellIndex const& cell, std::size_t d) {
  for (std::size_t e : {(d + 1) % 3, (d + 2) % 3}) {
    int const k = static_cast<int>(e);
    if (min(min(t[0][k], t[1][k]), t[2][k]) >= cell[e] + 1 || max(max(t[0][k], t[1][k]), t[2][k]) <= cell[e]) return {};
  }
  std::vector<Point<N>> p{point<N>(t[0]), point<N>(t[1]), point<N>(t[2])};
  for (std::size_t e : {(d + 1) % 3, (d + 2) % 3}) {
    keep(p, e, cell[e], -1);
    keep(p, e, cell[e] + 1, 1);
  }
  return p;
}

/// Integrals over a polygon of its projection along d, and of that times the height above `low`.
template <class N>
std::array<N, 2> projection(std::vector<Point<N>> const& p, std::size_t d, int low) {
  std::size_t const a = (d + 1) % 3, b = (d + 2) % 3;
  N area(0), moment(0);
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    N const s = ((p[i][a] - p[0][a]) * (p[i + 1][b] - p[0][b]) - (p[i + 1][a] - p[0][a]) * (p[i][b] - p[0][b])) / N(2);
    area += s;
    moment += s * ((p[0][d] - N(low)) + (p[i][d] - N(low)) + (p[i + 1][d] - N(low))) / N(3);
  }
  return {area, moment};
}

/// The same as winding(), from the parts of the triangles in the row of cells along d: those within the cell count to
/// its low face, those above for the whole height.
inline Real winding_along(std::vector<Triangle> const& surface, CellIndex const& cell, std::size_t d, long& rational) {
  int const k = static_cast<int>(d), low = cell[d];
  return evaluate(
      [&]<class N>(N) {
        N sum(0);
        for (auto const& t : surface) {
          if (t[0][k] <= low && t[1][k] <= low && t[2][k] <= low) continue;
          auto above = in_row<N>(t, cell, d);
          keep(above, d, low, -1);
          auto within_cell = above;
          keep(above, d, low + 1, -1);
          sum += projection(above, d, low)[0];
          if (t[0][k] >= low + 1 && t[1][k] >= low + 1 && t[2][k] >= low + 1) continue;  // maybe flat on the high face
          keep(within_cell, d, low + 1, 1);
          sum += projection(within_cell, d, low)[1];
        }
        return sum;
      },
      rational);
}

/// Integral of the winding number over the low face of `cell` along d. `flat`: area of the triangles that touch the
/// face and are within 1e-3 of parallel to it: they decide nothing (they lie in it) or their place is known to rounding
/// only, where they cross it.
inline Real winding_on_face(std::vector<Triangle> const& surface, CellIndex const& cell, std::size_t d, Real& flat,
                            long& rational) {
  int const k = static_cast<int>(d), plane = cell[d];
  flat = 0;
  for (auto const& t : surface) {
    Vec3 const s = 0.5 * cross(t[1] - t[0], t[2] - t[0]);
    Real const low = min(min(t[0][k], t[1][k]), t[2][k]), high = max(max(t[0][k], t[1][k]), t[2][k]);
    if (low > plane + 1e-9 || high < plane - 1e-9 || !(std::abs(s[k]) > 0.999999 * norm(s))) continue;
    flat += min(std::abs(s[k]), 1);
  }
  return evaluate(
      [&]<class N>(N) {
        N sum(0);
        for (auto const& t : surface) {
          if (t[0][k] >= plane && t[1][k] >= plane && t[2][k] >= plane) continue;
          auto below = in_row<N>(t, cell, d);
          keep(below, d, plane, 1);
          sum -= projection(below, d, plane)[0];
        }
        return sum;
      },
      rational);
}

}  // namespace brisance::testing::exact
