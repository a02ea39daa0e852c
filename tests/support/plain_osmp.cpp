#include "tests/support/plain_osmp.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::testing {
namespace {

using std::abs;

double curvature(double a, double b) {
  if (a * b <= 0) return 0;
  double const m = std::min(abs(a), abs(b)), big = std::max(abs(a), abs(b));
  return std::copysign(std::max(0.0, std::min(m, 4 * m - big)), a);
}

struct PlainCell {
  bool vacuum = false;
  double u = 0, v = 0, w = 0, p = 0, c = 0, enthalpy = 0;
  double scale = 0;         // rho c^2 / gamma
  double f = 0, slope = 0;  // p_ref - Gamma rho e_ref and its derivative
  State flux{};
};

struct PlainFace {
  bool vacuum = false;
  double u = 0, v = 0, w = 0, enthalpy = 0, c = 1;
  double bend = 0;  // chi / Gamma
  bool steep = false;
  double size = 0, density = 1;  // of `smooth`: size < 0 where the flow is none
  State fourth{};                // Q
  State lambda{}, speed{}, jump{}, strength{}, third{}, low{}, mean{};

  State into(State const& x, double kappa) const {
    double const q = 0.5 * (u * u + v * v + w * w), m = x[1] - u * x[0];
    double const pi = kappa * ((q + bend) * x[0] - u * x[1] - v * x[2] - w * x[3] + x[4]);
    return {(pi - c * m) / (2 * c * c), x[0] - pi / (c * c), x[2] - v * x[0], x[3] - w * x[0],
            (pi + c * m) / (2 * c * c)};
  }
  State out_of(State const& h) const {
    double const q = 0.5 * (u * u + v * v + w * w) - bend;
    return {h[0] + h[1] + h[4], h[0] * (u - c) + h[1] * u + h[4] * (u + c), (h[0] + h[1] + h[4]) * v + h[2],
            (h[0] + h[1] + h[4]) * w + h[3],
            h[0] * (enthalpy - u * c) + h[1] * q + h[2] * v + h[3] * w + h[4] * (enthalpy + u * c)};
  }
};

PlainCell evaluate(State const& x, Gas const& gas) {
  PlainCell c;
  c.vacuum = gas.vacuum(x);
  if (c.vacuum) {
    c.p = c.flux[1] = gas.pressure(x);
    return c;
  }
  c.u = x[1] / x[0], c.v = x[2] / x[0], c.w = x[3] / x[0];
  c.p = gas.pressure(x), c.c = gas.sound_speed(x), c.enthalpy = (x[4] + c.p) / x[0];
  c.scale = x[0] * c.c * c.c / gas.gamma;
  auto const f_at = [&](double rho) { return gas.reference_pressure(rho) - gas.kappa() * gas.reference_energy(rho); };
  c.f = f_at(x[0]);
  c.slope =
      gas.reference_slope(x[0]) - gas.kappa() * (gas.reference_energy(x[0]) + gas.reference_pressure(x[0])) / x[0];
  c.flux = {x[1], x[1] * c.u + c.p, x[2] * c.u, x[3] * c.u, (x[4] + c.p) * c.u};
  return c;
}

PlainFace face_between(State const& ul, State const& ur, PlainCell const& l, PlainCell const& r, double sigma,
                       Gas const& gas) {
  PlainFace f;
  double const al = abs(l.u) + l.c, ar = abs(r.u) + r.c, a = std::max(al, ar);
  f.vacuum = l.vacuum || r.vacuum;
  for (std::size_t k = 0; k < 5; ++k) f.mean[k] = 0.5 * (l.flux[k] + r.flux[k]);
  if (!f.vacuum) {
    double const wl = std::sqrt(ul[0]) / (std::sqrt(ul[0]) + std::sqrt(ur[0])), wr = 1 - wl;
    f.u = wl * l.u + wr * r.u, f.v = wl * l.v + wr * r.v, f.w = wl * l.w + wr * r.w;
    f.enthalpy = wl * l.enthalpy + wr * r.enthalpy;
    double const drho = ur[0] - ul[0];
    f.bend = (std::abs(drho) > 1e-6 * (ul[0] + ur[0]) ? (r.f - l.f) / drho : 0.5 * (l.slope + r.slope)) / gas.kappa();
    double const c2 = gas.kappa() * (f.bend + f.enthalpy - 0.5 * (f.u * f.u + f.v * f.v + f.w * f.w));
    f.c = c2 > 0 ? std::sqrt(c2) : std::min(l.c, r.c);
    f.lambda = {f.u - f.c, f.u, f.u, f.u, f.u + f.c};
    for (std::size_t k = 0; k < 5; ++k) f.speed[k] = abs(f.lambda[k]), f.jump[k] = ur[k] - ul[k];
    f.speed[0] = std::max({f.speed[0], f.lambda[0] - (l.u - l.c), (r.u - r.c) - f.lambda[0]});
    f.speed[4] = std::max({f.speed[4], f.lambda[4] - (l.u + l.c), (r.u + r.c) - f.lambda[4]});
    f.strength = f.into(f.jump, gas.kappa());
    State h;
    for (std::size_t k = 0; k < 5; ++k) {
      double const nu = std::min(1.0, sigma * f.speed[k]);
      h[k] = (f.lambda[k] >= 0 ? 1 : -1) * f.speed[k] * (1 - nu * nu) * f.strength[k] / 3;
    }
    f.third = f.out_of(h);
    for (std::size_t k = 0; k < 5; ++k) {
      double const nu = std::min(1.0, sigma * f.speed[k]);
      h[k] = f.speed[k] * nu * (1 - nu * nu) * f.strength[k] / 3;
    }
    f.fourth = f.out_of(h);
    f.size =
        abs(f.strength[0]) + abs(f.strength[4]) + abs(f.strength[1]) + (abs(f.strength[2]) + abs(f.strength[3])) / f.c;
    double const root = 0.5 * (std::sqrt(ul[0]) + std::sqrt(ur[0]));
    f.density = root * root;
  }
  if (f.vacuum || std::abs(r.p - l.p) > 0.2 * std::min(l.scale, r.scale)) f.size = -1;
  f.steep = std::abs(r.p - l.p) > 0.2 * std::min(l.scale, r.scale) && (gas.curve.exponential() ? r.u < l.u : r.u > l.u);
  double const hlle_courant = gas.gamma <= 1.67 && !gas.curve.exponential() ? 0.905 : gas.kappa() <= 2 ? 0.8 : 0.5;
  bool const llf = f.vacuum || sigma * a > hlle_courant;
  double const sl = std::min({0.0, l.u - l.c, f.u - f.c}), sr = std::max({0.0, r.u + r.c, f.u + f.c});
  for (std::size_t k = 0; k < 5; ++k)
    f.low[k] = llf ? f.mean[k] - 0.5 * a * (ur[k] - ul[k])
                   : (sr * l.flux[k] - sl * r.flux[k] + sl * sr * (ur[k] - ul[k])) / (sr - sl);
  return f;
}

double const binomial[6][9] = {
    {}, {1}, {1, -2, 1}, {1, -4, 6, -4, 1}, {1, -6, 15, -20, 15, -6, 1}, {1, -8, 28, -56, 70, -56, 28, -8, 1}};

double least_size(std::vector<PlainFace> const& faces, std::size_t f) {
  double least = faces[f].size;
  for (std::size_t z = f - 2; z <= f + 2; ++z) least = std::min(least, faces[z].size);
  return least;
}

/// dt^2/6 [F''(F_x, F_x) - F''(U_x, A F_x)] of a gas without f'', in the closed form of fluid/README.md.
State coupling(PlainFace const& f, double sigma, double kappa) {
  State const& a = f.strength;
  double const k3 = sigma * sigma * f.c * f.c * f.c / (6 * f.density), e = k3 * (a[4] - a[0]);
  double const q = 0.5 * (f.u * f.u + f.v * f.v + f.w * f.w);
  double const m = 4 * (2 - kappa) * k3 * f.c * a[0] * a[4], v = -e * a[2], w = -e * a[3];
  return {0, m, v, w, f.u * m + f.v * v + f.w * w + e * (f.enthalpy - q) * a[1]};
}

/// G - |a| jump / 2 of field k at face f. Source: theory/fluid.md 2.4 step 3, 2.5; `smooth`: fluid/README.md.
double field(std::vector<PlainFace> const& faces, std::size_t f, std::size_t k, int order, double sigma, double kappa,
             fluid::SweepOptions const& options) {
  PlainFace const& face = faces[f];
  double const speed = face.speed[k], nu = std::min(1.0, sigma * speed), own = face.strength[k];
  int const s = face.lambda[k] >= 0 ? 1 : -1;
  auto at = [&](int z) { return static_cast<std::size_t>(static_cast<int>(f) + z); };
  if (order == 1 || face.vacuum) return -0.5 * speed * own;
  auto jump = [&](int z) { return face.into(faces[at(z)].jump, kappa)[k]; };
  bool frozen = false;
  for (int z = -2; z <= 2; ++z) frozen = frozen || (options.hybrid && (k == 0 || k == 4) && faces[at(z)].steep);
  auto third = [&](int z) {
    return frozen ? speed * (1 - nu * nu) / 3 * jump(z) : s * face.into(faces[at(z)].third, kappa)[k];
  };
  auto even = [&](int q, int centre) {
    double sum = 0;
    for (int z = -(q - 1); z <= q - 1; ++z) sum += binomial[q][z + q - 1] * third(centre + z);
    return sum;
  };
  double total = speed * (1 - nu) * own - (even(1, 0) - even(1, -s)), ratio = 1;
  for (int o = 4; o <= order; ++o) {
    int const q = o / 2;
    if (o % 2 == 0) {
      ratio *= (nu - q) / o;
      total += ratio * even(q, 0);
      if (o == 4 && options.smooth && !frozen) {
        auto fourth = [&](int z) { return face.into(faces[at(z)].fourth, kappa)[k]; };
        total += 0.25 * (fourth(-1) - 2 * fourth(0) + fourth(1) - nu * even(2, 0));
      }
    } else {
      ratio *= (nu + q) / o;
      total -= ratio * (even(q, 0) - even(q, -s));
    }
  }
  double const room = (1 - std::min(1.0, sigma * faces[at(-s)].speed[k])) / sigma;
  double const m_here = curvature(own - jump(-1), jump(1) - own);
  double const m_up = curvature(jump(-s) - jump(-s - 1), jump(-s + 1) - jump(-s));
  double const av = speed * own, md = 0.5 * (av - s * speed * m_here);
  double const ul = room * jump(-s), lc = 0.5 * room * (jump(-s) + s * m_up);
  double slack = 0;
  if (double const size = least_size(faces, f); options.smooth && size > 0 && speed > 2e-10 * (abs(face.u) + face.c))
    slack = 0.2 * size * size / face.density * (abs(face.u) + face.c);
  double const low = std::max(std::min({0.0, av, md}), std::min({0.0, ul, lc}));
  double const high = std::min(std::max({0.0, av, md}), std::max({0.0, ul, lc}));
  return std::min(std::max(0.5 * total, low - slack), high + slack) - 0.5 * speed * own;
}

/// theta of theory/fluid.md 4.2 with the cheap test as its only trigger.
double blending(State const (&low)[2], State const& difference, double sigma, Gas const& gas) {
  auto const energy = [&](State const& x) { return gas.internal_energy(x); };
  double const eps = 1e-2;
  auto state = [&](int side, double theta) {
    State z;
    for (std::size_t k = 0; k < 5; ++k) z[k] = low[side][k] + (side ? 2 : -2) * sigma * theta * difference[k];
    return z;
  };
  bool asked = false;
  for (int side = 0; side < 2; ++side) {
    State const z = state(side, 1), &w = low[side];
    asked = asked || z[0] < eps * w[0] || z[0] * energy(z) < eps * eps * w[0] * energy(w);
  }
  if (!asked) return 1;
  double theta = 1;
  for (int side = 0; side < 2; ++side) {
    State const& w = low[side];
    double const after = state(side, 1)[0];
    if (after < eps * w[0]) theta = std::min(theta, (1 - eps) * w[0] / (w[0] - after));
    for (int turn = 0; turn < 2; ++turn)
      if (double const e = energy(state(side, theta)); e < eps * energy(w))
        theta *= (1 - eps) * energy(w) / (energy(w) - e);
  }
  return theta;
}

}  // namespace

PlainSweep plain_sweep(PlainPencil const& pencil, int order, double sigma, Gas const& gas,
                       fluid::SweepOptions const& options) {
  auto const& u = pencil.cells;
  std::vector<PlainCell> cell;
  for (State const& x : u) cell.push_back(evaluate(x, gas));
  std::vector<PlainFace> face(u.size());  // face i: low side of cell i
  for (std::size_t i = 1; i < u.size(); ++i) face[i] = face_between(u[i - 1], u[i], cell[i - 1], cell[i], sigma, gas);
  auto low_state = [&](std::size_t i) {
    State w;
    for (std::size_t k = 0; k < 5; ++k) w[k] = u[i][k] - sigma * (face[i + 1].low[k] - face[i].low[k]);
    return w;
  };
  PlainSweep result;
  auto const first = static_cast<std::size_t>(pencil.first), n = static_cast<std::size_t>(pencil.n);
  for (std::size_t f = 0; f <= n; ++f) {
    std::size_t const i = first + f;
    int const own_order = pencil.face_order.empty() ? order : pencil.face_order[f];
    State d;
    for (std::size_t k = 0; k < 5; ++k) d[k] = field(face, i, k, own_order, sigma, gas.kappa(), options);
    if (!pencil.marked.empty() && (pencil.marked[i - 1] || pencil.marked[i])) {
      double const least = std::min(options.shear_dissipation * std::max(cell[i - 1].c, cell[i].c), 1 / sigma);
      for (std::size_t k = 1; k < 4; ++k)
        d[k] -= 0.5 * std::max(0.0, least - std::abs(face[i].u)) * face[i].strength[k];
    }
    d = face[i].out_of(d);
    if (options.smooth && own_order > 1 && least_size(face, i) >= 0) {
      State const extra = coupling(face[i], sigma, gas.kappa());
      for (std::size_t k = 0; k < 5; ++k) d[k] += extra[k];
    }
    for (std::size_t k = 0; k < 5; ++k) d[k] += face[i].mean[k] - face[i].low[k];
    double const theta = face[i].vacuum ? 0 : blending({low_state(i - 1), low_state(i)}, d, sigma, gas);
    if (theta < 1 && !face[i].vacuum) ++result.limited;
    State flux = face[i].low;
    for (std::size_t k = 0; k < 5; ++k) flux[k] += theta * d[k];
    result.flux.push_back(flux);
  }
  for (std::size_t i = 0; i < n; ++i) {
    State x = u[first + i];
    for (std::size_t k = 0; k < 5; ++k) x[k] -= sigma * (result.flux[i + 1][k] - result.flux[i][k]);
    result.cells.push_back(x);
    result.pressure.push_back(cell[first + i].p);
  }
  return result;
}

}  // namespace brisance::testing
