// One rolling pass of OSMP along a bundle of pencils of a mixture, one pencil per lane: the arrangement of pencil.hpp
// with seven fields. Source: theory/fluid.md 1.4, 2.4, 4.2.
#pragma once
#include "fluid/flux/mixture_compose.hpp"
#include "fluid/flux/mixture_sweep.hpp"
#include "fluid/flux/pencil.hpp"

namespace brisance::fluid {

/// A bundle in scratch memory: component q of cell c, all lanes, at values + (7 c + q) lanes. Swept in place.
struct MixtureBundle {
  Index n;
  Real* values;
  std::uint32_t valid;  ///< lanes that stand for pencils of their own
  /// Marks of the transverse cure: of cell c of a lane at marks[mark_offset[lane] + c * mark_stride]; those in
  /// `mark_mask` count. Null: no cure.
  std::uint8_t const* marks = nullptr;
  std::array<std::ptrdiff_t, lanes_of<Pack>> mark_offset{};
  std::ptrdiff_t mark_stride = 0;
  std::uint8_t mark_mask = 0;
};

/// What the pass saw, lane by lane.
template <class V>
struct MixturePencilReport {
  V signal = V(0.0);
  std::int64_t fallback = 0, fallback_high = 0;
  std::uint64_t health = 0;
  int bad_lane = 0;
  Index bad_cell = 0;
  V flux_low[6], flux_high[6];
};

template <int Order, class V>
class MixturePencil {
 public:
  static constexpr int reach = Stencil<Order>::reach, half = Stencil<Order>::half, ghosts = Stencil<Order>::ghosts;
  static constexpr int lanes = lanes_of<V>;

  /// Advances cells 0..n-1 by one sweep; `report` gathers.
  void sweep(MixtureBundle const& data, Real sigma, Mixture const& mixture, SweepOptions const& options,
             MixturePencilReport<V>& report) {
    MixtureConstants<V> const k(mixture, sigma);
    faces_.restart(), jumps_.restart();
    // of the first face's missing neighbour: no result depends on it
    for (V& x : faces_[newest - 1].low_flux) x = V(0.0);
    faces_[newest - 1].low_right = V(0.0);
    MixtureCell<V> left, right;
    MixtureDifference<V> before{}, difference;
    fetch(data, -ghosts, left, k, report);
    for (Index f = -reach; f <= data.n + reach; ++f) {
      fetch(data, f, right, k, report);
      push(left, right, data, f, options, k);
      left = right;
      if (Index const at = f - reach; at >= 0) {
        flux(difference, options.hybrid, data.marks != nullptr, k);
        keep_positive(difference, sigma, at, data, mixture, k, report);
        if (at == 0 || at == data.n) {
          V* const end = at == 0 ? report.flux_low : report.flux_high;
          BRISANCE_UNROLL for (int n = 0; n < 6; ++n) end[n] = faces_[here].low_flux[n] + difference.flux[n];
        }
        if (at > 0) update(difference, before, data, at - 1, mixture, k, report);
        before = difference;
      }
      faces_.advance(), jumps_.advance();
    }
  }

 private:
  static constexpr int here = 1, newest = reach + 1;  ///< places in the ring of faces
  static constexpr int middle = reach;                ///< of this face in the ring of jumps
  Ring<MixtureFace<V>, reach + 2> faces_;
  Ring<MixtureJump<V>, 2 * reach + 1> jumps_;
  Mask<V> vacuum_left_{}, vacuum_right_{};

  void fetch(MixtureBundle const& data, Index c, MixtureCell<V>& cell, MixtureConstants<V> const& k,
             MixturePencilReport<V>& report) {
    Real const* const from = data.values + std::ptrdiff_t{7} * c * lanes;
    BRISANCE_UNROLL for (int q = 0; q < 7; ++q) cell.state[q] = load<V>(from + q * lanes);
    primitives(cell, k);
    vacuum_left_ = vacuum_right_;
    vacuum_right_ = is_vacuum(cell, k);
    if (any_of(vacuum_right_)) [[unlikely]]
      empty_cell(cell, vacuum_right_);
    if (c < 0 || c >= data.n) return;
    report.signal = max(report.signal, cell.signal);
    if (auto const fast = cell.signal > k.inv_sigma; any_of(fast)) [[unlikely]]
      note(static_cast<std::uint64_t>(Health::courant), bits_of(fast) & data.valid, c, report);
  }

  /// The face between the two cells, newest of the rings.
  void push(MixtureCell<V> const& left, MixtureCell<V> const& right, MixtureBundle const& data, Index c,
            SweepOptions const& options, MixtureConstants<V> const& k) {
    MixtureFace<V>&face = faces_[newest], &previous = faces_[newest - 1];
    MixtureJump<V>& jump = jumps_[2 * reach];
    form_face<Order>(left, right, previous, face, jump, k);
    if (data.marks) [[unlikely]]
      face.cure = cure_speed(data, c, min(V(options.shear_dissipation) * max(left.sound, right.sound), k.inv_sigma));
    if (Mask<V> const vacuum = vacuum_left_ | vacuum_right_; any_of(vacuum)) [[unlikely]]
      empty_face<Order>(left, right, vacuum, previous, face, jump, k);
  }

  /// `speed` in the lanes where one of the cells c-1 and c is marked by a shock across the sweep, else 0. Marks reach
  /// one cell beyond the pencil.
  [[gnu::noinline, gnu::cold]] static V cure_speed(MixtureBundle const& data, Index c, V speed) {
    auto const marked = [&](Index cell) {
      Index const at = cell < -1 ? -1 : cell > data.n ? data.n : cell;
      Real mark[lanes];
      for (int lane = 0; lane < lanes; ++lane)
        mark[lane] =
            data.marks[data.mark_offset[static_cast<std::size_t>(lane)] + at * data.mark_stride] & data.mark_mask;
      return load<V>(mark) > V(0.0);
    };
    return select(marked(c - 1) | marked(c), speed, V(0.0));
  }

  /// Flux of the face in the middle of the window, minus its low-order flux.
  void flux(MixtureDifference<V>& d, bool hybrid, bool cure, MixtureConstants<V> const& k) {
    MixtureFace<V> const& f = faces_[here];
    V part[7];  // acoustic left, alpha, products, rest, shears, acoustic right
    if constexpr (Order == 1) {
      V const speed0 = V(-0.5) * abs(f.u);
      part[0] = V(-0.5) * f.speed1 * f.strength[0];
      part[6] = V(-0.5) * f.speed5 * f.strength[6];
      BRISANCE_UNROLL for (int n = 1; n < 6; ++n) part[n] = speed0 * f.strength[n];
    } else {
      characteristic_fluxes(f, part, hybrid, k);
    }
    if (cure) [[unlikely]] {  // all that travels with the flow but the surface of the products, which stays as sharp
      V const missing = V(-0.5) * max(f.cure - abs(f.u), V(0.0));
      for (int n = 2; n < 6; ++n) part[n] = fma(missing, f.strength[n], part[n]);
    }
    compose(f, part, faces_[here - 1].u, faces_[here + 1], k, d);
  }

  void characteristic_fluxes(MixtureFace<V> const& f, V* part, bool hybrid, MixtureConstants<V> const& k) {
    V const inv_sound = V(1.0) / f.sound, pressure = V(0.5) * (inv_sound * inv_sound);
    V const velocity = V(0.5) * f.density * inv_sound, rest = V(1.0) - f.share;
    MixtureFace<V> const &low = faces_[here - 1], &high = faces_[here + 1];
    // `value(x)` takes one field out of the primitive jumps or third-order corrections of a face
    auto field = [&](Wave<Order, V> const& wave, V own, auto const& value) __attribute__((always_inline)) {
      return field_flux<Order>(
          wave, own, [&](int z) __attribute__((always_inline)) { return value(jumps_[middle + z].jump); },
          [&](int z) __attribute__((always_inline)) { return value(jumps_[middle + z].third); }, AllOrders{});
    };
    // Acoustic waves beside shocks in the products take the coefficients of this face for the whole stencil
    // (theory/fluid.md 2.4, `hybrid`); elsewhere that loses (fluid/README.md).
    V steepest = V(0.0);
    if (hybrid) BRISANCE_UNROLL for (int z = -2; z <= 2; ++z) steepest = max(steepest, jumps_[middle + z].steep);
    Mask<V> const steep = steepest > V(0.0);
    auto acoustic = [&](Wave<Order, V> const& wave, V lambda, V own, auto const& value) __attribute__((always_inline)) {
      V const speed = wave.half_speed + wave.half_speed, nu = min(k.sigma * speed, V(1.0));
      V const factor = flip(V(1.0 / 6) * speed * fnma(nu, nu, V(1.0)), lambda);
      auto jump = [&](int z) __attribute__((always_inline)) { return value(jumps_[middle + z].jump); };
      return field_flux<Order>(
          wave, own, jump,
          [&](int z) __attribute__((always_inline)) {
            return select(steep, factor * jump(z), value(jumps_[middle + z].third));
          },
          AllOrders{});
    };
    auto wave_of = [&](V lambda, V speed, V room_low, V room_high) __attribute__((always_inline)) {
      Wave<Order, V> wave;
      V const nu = min(k.sigma * speed, V(1.0));
      wave.leftward = negative(lambda);
      wave.sign = lambda;
      wave.half_speed = V(0.5) * speed;
      wave.second = fnma(wave.half_speed, nu, wave.half_speed);
      wave.room = select(wave.leftward, room_high, room_low);
      set_ratios(wave, nu);
      return wave;
    };
    auto const left = wave_of(f.u - f.sound, f.speed1, low.room1, high.room1);
    part[0] = acoustic(
        left, f.u - f.sound,
        f.strength[0], [&](V const* x) __attribute__((always_inline)) { return fms(pressure, x[0], velocity * x[1]); });
    auto const right = wave_of(f.u + f.sound, f.speed5, low.room5, high.room5);
    part[6] = acoustic(
        right, f.u + f.sound,
        f.strength[6], [&](V const* x) __attribute__((always_inline)) { return fma(pressure, x[0], velocity * x[1]); });
    auto const slow = wave_of(f.u, abs(f.u), low.room0, high.room0);
    V const twice = pressure + pressure, share = twice * f.share, other = twice * rest;
    part[1] = field(
        slow, f.strength[1], [](V const* x) __attribute__((always_inline)) { return x[4]; });
    V const room = select(slow.leftward, high.room_fraction, low.room_fraction);
    V const up = select(slow.leftward, jumps_[middle + 1].jump[4], jumps_[middle - 1].jump[4]);
    part[1] = monotone_fraction(f, part[1], (room + room) * up);
    part[2] = field(
        slow, f.strength[2], [&](V const* x) __attribute__((always_inline)) { return fnma(share, x[0], x[5]); });
    part[3] = field(
        slow, f.strength[3], [&](V const* x) __attribute__((always_inline)) { return fnma(other, x[0], x[6]); });
    part[4] = field(
        slow, f.strength[4], [&](V const* x) __attribute__((always_inline)) { return f.density * x[2]; });
    part[5] = field(
        slow, f.strength[5], [&](V const* x) __attribute__((always_inline)) { return f.density * x[3]; });
  }

  /// Both cells of the face take twice the difference alone: if that leaves them admissible, so does the whole step.
  void keep_positive(MixtureDifference<V>& d, Real sigma, Index f, MixtureBundle const& data, Mixture const& mixture,
                     MixtureConstants<V> const& k, MixturePencilReport<V>& report) {
    MixtureFace<V> const &face = faces_[here], &next = faces_[here + 1];
    V const twice(2 * sigma);
    Mask<V> const failed =
        !(stays_admissible(face, d, d.left, -twice, k) & stays_admissible(next, d, -d.right, twice, k));
    if (any_of(failed)) [[unlikely]] {
      std::uint32_t const limited = limit_face(d, face, next, 2 * sigma, mixture, bits_of(failed)) & data.valid;
      (f < data.n ? report.fallback : report.fallback_high) += __builtin_popcount(limited);
    }
  }

  void update(MixtureDifference<V> const& d, MixtureDifference<V> const& before, MixtureBundle const& data, Index c,
              Mixture const& mixture, MixtureConstants<V> const& k, MixturePencilReport<V>& report) {
    MixtureFace<V> const& face = faces_[here];
    V x[7];
    BRISANCE_UNROLL for (int q = 0; q < 6; ++q) x[q] = fnma(k.sigma, d.flux[q] - before.flux[q], face.low_state[q]);
    x[6] = fnma(k.sigma, d.left + before.right, face.low_state[6]);
    Real* const to = data.values + std::ptrdiff_t{7} * c * lanes;
    BRISANCE_UNROLL for (int q = 0; q < 7; ++q) store(to + q * lanes, x[q]);
    V const thermal = thermal_energy(x, k);
    if (Mask<V> const suspect = !((x[0] >= V(0.0)) & (thermal >= V(0.0)) & (thermal < V(1e300)) &
                                  (abs(x[5]) < V(1e300)) & (abs(x[6]) < V(2.0)));
        any_of(suspect)) [[unlikely]]
      judge_cell(to, c, bits_of(suspect) & data.valid, mixture, report);
  }

  [[gnu::noinline, gnu::cold]] void judge_cell(Real const* cell, Index c, std::uint32_t asked, Mixture const& mixture,
                                               MixturePencilReport<V>& report) {
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(asked >> lane & 1)) continue;
      MixtureState x;
      for (std::size_t q = 0; q < 7; ++q) x[q] = cell[static_cast<int>(q) * lanes + lane];
      if (std::uint64_t const bits = judge(x, mixture)) note(bits, 1u << lane, c, report);
    }
  }
  [[gnu::noinline, gnu::cold]] void note(std::uint64_t health, std::uint32_t where, Index c,
                                         MixturePencilReport<V>& report) {
    if (where == 0) return;
    if (report.health == 0) report.bad_lane = __builtin_ctz(where), report.bad_cell = c;
    report.health |= health;
  }
};

}  // namespace brisance::fluid
