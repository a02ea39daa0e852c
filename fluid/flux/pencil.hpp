// One rolling pass of OSMP along a bundle of pencils, one pencil per lane: a new cell gives its primitives, then one
// face; the flux `reach` faces behind has then its whole window, and the cell before it its new state. Source:
// theory/fluid.md 2.4, 4.2; arrangement: theory/fluid_speed.md 4.
#pragma once
#include <array>
#include <cstddef>

#include "fluid/flux/positivity.hpp"
#include "fluid/flux/smooth.hpp"
#include "fluid/flux/sweep.hpp"

namespace brisance::fluid {

/// The last N items of a stream. The table of slots stands twice, so that no index is ever reduced.
template <class T, int N>
class Ring {
 public:
  Ring() {
    for (int i = 0; i < 2 * N; ++i) slot_[i] = &item_[i % N];
  }
  Ring(Ring const&) = delete;
  Ring& operator=(Ring const&) = delete;
  void restart() { base_ = 0; }
  /// 0: the oldest, N - 1: the newest.
  BRISANCE_INLINE T& operator[](int age) { return *slot_[base_ + age]; }
  BRISANCE_INLINE void advance() { base_ = base_ + 1 == N ? 0 : base_ + 1; }

 private:
  alignas(64) T item_[N];
  T* slot_[2 * N];
  std::ptrdiff_t base_ = 0;
};

/// Where the cells of a bundle stand: component q of cell c, all lanes, at in[q] + c * in_stride. May be the same
/// place.
struct PencilData {
  Index n;
  std::array<Real const*, 5> in;
  std::array<Real*, 5> out;
  std::ptrdiff_t in_stride, out_stride;
  /// Lanes that stand for cells of their own; those whose low face of cell n-1, and whose high face, is nobody else's
  /// to count.
  std::uint32_t valid, counted_last, counted_high;
  /// Rows the next bundle will come from, one offset a lane: asked for ahead, one line of one row per cell. Null: the
  /// pencil itself walks with a stride the hardware does not follow; ask for its cell 12 ahead.
  std::array<Real const*, 5> next{};
  std::ptrdiff_t const* next_offset = nullptr;
  /// Of the cells -1 .. n, at cell 0: the lanes beside a shock that runs across the sweep. Null: none.
  std::uint32_t const* marks = nullptr;
};

/// Runs between walls: what the caller wants back, and the order of each face. Arrays as in LineBundle.
struct RunData {
  Real* flux;
  Real* pressure;
  std::uint8_t const* face_order;
};

/// What the pass saw, lane by lane; kept over the bundles of a block by the caller.
template <class V>
struct PencilReport {
  V signal = V(0.0);
  std::int64_t fallback = 0, fallback_high = 0;
  std::uint64_t health = 0;
  int bad_lane = 0;
  Index bad_cell = 0;
  V flux_low[5], flux_high[5];
};

/// Order, value type, kind of gas, whether the pencils are runs between walls and whether the terms of `smooth` count,
/// fixed at compile time.
template <int Order, class V, class Curve, bool Runs, bool Smooth>
class Pencil {
 public:
  static constexpr int reach = Stencil<Order>::reach, half = Stencil<Order>::half, ghosts = Stencil<Order>::ghosts;
  static constexpr int lanes = lanes_of<V>;

  /// Advances cells 0..n-1 by one sweep; `report` gathers.
  void sweep(PencilData const& data, RunData const* runs, Real sigma, Gas const& gas, SweepOptions const& options,
             PencilReport<V>& report) {
    SweepConstants<V, Curve> const k(gas, sigma, options);
    faces_.restart(), jumps_.restart();
    if constexpr (Smooth) smooth_faces_.restart();
    for (V& x : faces_[newest - 1].low_flux)
      x = V(0.0);  // of the first face's missing neighbour: no result depends on it
    Cell<V, Curve> left, right;
    V before[5] = {V(0.0), V(0.0), V(0.0), V(0.0), V(0.0)};
    fetch(data, runs, -ghosts, left, k, report);
    for (Index f = -reach; f < reach; ++f) {
      fetch(data, runs, f, right, k, report);
      push(left, right, data, f, k);
      left = right;
      advance();
    }
    for (Index f = 0; f <= data.n; ++f) {
      fetch(data, runs, f + reach, right, k, report);
      push(left, right, data, f + reach, k);
      left = right;
      V difference[5];
      flux(difference, k, data.marks != nullptr, runs ? runs->face_order + std::ptrdiff_t{f} * lanes : nullptr);
      keep_positive(difference, gas, k, f, data, runs, report);
      if constexpr (Runs) {
        give_flux(difference, runs->flux + std::ptrdiff_t{f} * 5 * lanes);
      } else if (f == 0 || f == data.n) {
        V* const end = f == 0 ? report.flux_low : report.flux_high;
        BRISANCE_UNROLL for (int n = 0; n < 5; ++n) end[n] = faces_[here].low_flux[n] + difference[n];
      }
      if (f > 0) update(difference, before, data, f - 1, k, gas, report);
      BRISANCE_UNROLL for (int n = 0; n < 5; ++n) before[n] = difference[n];
      advance();
    }
  }

 private:
  static constexpr int here = 2, newest = reach + 2;  ///< places in the ring of faces
  static constexpr int middle = half < 2 ? 2 : half;  ///< of this face in the ring of jumps
  Ring<Face<V, Curve>, reach + 3> faces_;
  Ring<Jump<V>, reach + middle + 1> jumps_;
  [[no_unique_address]] std::conditional_t<Smooth, Ring<SmoothFace<V>, reach + 3>, Nothing> smooth_faces_;
  Mask<V> vacuum_left_{}, vacuum_right_{};
  bool any_vacuum_left_ = false, any_vacuum_right_ = false;

  BRISANCE_INLINE void advance() {
    faces_.advance(), jumps_.advance();
    if constexpr (Smooth) smooth_faces_.advance();
  }

  BRISANCE_INLINE void fetch(PencilData const& data, RunData const* runs, Index c, Cell<V, Curve>& cell,
                             SweepConstants<V, Curve> const& k, PencilReport<V>& report) {
    BRISANCE_UNROLL for (std::size_t q = 0; q < 5; ++q) cell.state[q] = load<V>(data.in[q] + c * data.in_stride);
    ask_ahead(data, c);
    primitives(cell, k);
    vacuum_left_ = vacuum_right_, any_vacuum_left_ = any_vacuum_right_;
    vacuum_right_ = is_vacuum(cell, k);
    any_vacuum_right_ = any_of(vacuum_right_);
    if (any_vacuum_right_) [[unlikely]] {
      // copies: an address given away would keep the originals out of the registers everywhere
      Cell<V, Curve> copy = cell;
      SweepConstants<V, Curve> const constants = k;
      empty_cell(copy, vacuum_right_, constants);
      cell = copy;
    }
    if (c < 0 || c >= data.n) return;
    if constexpr (Runs) {
      store(runs->pressure + std::ptrdiff_t{c} * lanes, pressure_of(cell, k));
      report.signal = max(report.signal, select(inside(runs, c), cell.signal, V(0.0)));
    } else {
      report.signal = max(report.signal, cell.signal);
      if (auto const fast = cell.signal > k.inv_sigma; any_of(fast)) [[unlikely]]
        note(static_cast<std::uint64_t>(Health::courant), bits_of(fast) & data.valid, c, report);
    }
  }

  static BRISANCE_INLINE void ask_ahead(PencilData const& data, Index c) {
    if (data.next_offset) {
      std::ptrdiff_t const tile = c & ~(lanes - 1), offset = data.next_offset[c & (lanes - 1)] + tile;
      BRISANCE_UNROLL for (std::size_t q = 0; q < 5; ++q) __builtin_prefetch(data.next[q] + offset);
    } else {
      BRISANCE_UNROLL for (std::size_t q = 0; q < 5; ++q) __builtin_prefetch(data.in[q] + (c + 12) * data.in_stride);
    }
  }

  /// The face between the cells c-1 and c, newest of the ring.
  BRISANCE_INLINE void push(Cell<V, Curve> const& left, Cell<V, Curve> const& right, PencilData const& data, Index c,
                            SweepConstants<V, Curve> const& k) {
    Face<V, Curve>&face = faces_[newest], &previous = faces_[newest - 1];
    Jump<V>& window = jumps_[reach + middle];
    form_face<Order>(left, right, previous, face, window, k);
    if (data.marks) [[unlikely]]
      face.cure = cure_speed(data, c, min(k.shear * max(left.sound, right.sound), k.inv_sigma));
    if (any_vacuum_left_ || any_vacuum_right_) [[unlikely]] {
      Cell<V, Curve> const l = left, r = right;
      SweepConstants<V, Curve> const constants = k;
      empty_face<Order>(l, r, vacuum_left_ | vacuum_right_, previous, face, window, constants);
    }
    if constexpr (Smooth) form_smooth_face<Order>(left, right, face, smooth_faces_[newest], k);
  }

  /// `speed` in the lanes where one of the cells c-1 and c is marked by a shock across the sweep, else 0. Marks reach
  /// one cell beyond the pencil.
  static V cure_speed(PencilData const& data, Index c, V speed) {
    if (c < 0 || c > data.n) return V(0.0);  // no flux of this pencil
    std::uint32_t const marked = data.marks[c - 1] | data.marks[c];
    if (marked == 0) return V(0.0);
    Real mark[lanes];
    for (int lane = 0; lane < lanes; ++lane) mark[lane] = marked >> lane & 1;
    return select(load<V>(mark) > V(0.0), speed, V(0.0));
  }

  /// Flux of the face in the middle of the window, minus its low-order flux.
  BRISANCE_INLINE void flux(V* difference, SweepConstants<V, Curve> const& k, bool cure,
                            std::uint8_t const* face_order) {
    Face<V, Curve> const& f = faces_[here];
    V const q = V(0.5) * fma(f.u, f.u, fma(f.v, f.v, f.w * f.w));
    Frame<V> const frame = make_frame(f.u, f.v, f.w, q, f.inv_sound, k.kappa, f.bend);
    V part[5];
    if constexpr (Order == 1) {
      V const speed0 = V(-0.5) * abs(f.u);
      part[0] = V(-0.5) * f.speed1 * f.strength[0];
      part[4] = V(-0.5) * f.speed5 * f.strength[4];
      BRISANCE_UNROLL for (int n = 1; n < 4; ++n) part[n] = speed0 * f.strength[n];
    } else {
      V steepest = f.steep;
      BRISANCE_UNROLL for (int z = -2; z <= 2; ++z) if (z != 0) steepest = max(steepest, faces_[here + z].steep);
      if (Mask<V> const steep = steepest > V(0.0); k.hybrid && any_of(steep)) [[unlikely]] {
        Frame<V> const seen = frame;
        SweepConstants<V, Curve> const constants = k;
        V mixed[5];
        mixed_fluxes(f, seen, mixed, constants, face_order, steep);
        for (int n = 0; n < 5; ++n) part[n] = mixed[n];
      } else
        characteristic_fluxes<false>(f, frame, part, k, face_order, Mask<V>{});
    }
    if (cure) [[unlikely]] {
      V const missing = V(-0.5) * max(f.cure - abs(f.u), V(0.0));
      for (int n = 1; n < 4; ++n) part[n] = fma(missing, f.strength[n], part[n]);
    }
    V total[5];
    assemble(part, f, frame.q_entropy, total);
    if constexpr (Smooth) add_coupling(f, smooth_faces_[here], least_size(), q, k, total);
    BRISANCE_UNROLL for (int n = 0; n < 5; ++n) difference[n] = f.above_low[n] + total[n];
  }

  /// Smallest size of the five faces around: negative if one of them is no smooth flow.
  BRISANCE_INLINE V least_size() {
    V least = smooth_faces_[here].size;
    BRISANCE_UNROLL for (int z = -2; z <= 2; ++z) if (z != 0) least = min(least, smooth_faces_[here + z].size);
    return least;
  }
  BRISANCE_INLINE auto smooth_window(Face<V, Curve> const& f, Frame<V> const& frame) {
    if constexpr (Smooth)
      return SmoothWindow<Order, V>(least_size(), smooth_faces_[here - 1], smooth_faces_[here], smooth_faces_[here + 1],
                                    f, frame);
    else
      return NoSmoothWindow{};
  }

  /// Apart from the common path, which then stays short in the instruction cache.
  [[gnu::noinline]] void mixed_fluxes(Face<V, Curve> const& f, Frame<V> const& frame, V* part,
                                      SweepConstants<V, Curve> const& k, std::uint8_t const* face_order,
                                      Mask<V> steep) {
    characteristic_fluxes<true>(f, frame, part, k, face_order, steep);
  }

  /// The five fields. `Mixed`: lanes that are `steep` take the third-order terms of the acoustic waves with the
  /// coefficients of this face from the jumps, the others as they are (theory/fluid.md 2.4, `hybrid`).
  template <bool Mixed>
  BRISANCE_INLINE void characteristic_fluxes(Face<V, Curve> const& f, Frame<V> const& frame, V* part,
                                             SweepConstants<V, Curve> const& k, std::uint8_t const* face_order,
                                             Mask<V> steep) {
    constexpr int wide = Mixed ? middle : 2;
    Acoustic<V> jumps[2 * middle + 1], thirds[2 * half + 1];
    V const *x[2 * middle + 1], *p[2 * half + 1];
    BRISANCE_UNROLL for (int z = -wide; z <= wide; ++z) {
      x[middle + z] = jumps_[middle + z].jump;
      if (z != 0 || Mixed) jumps[middle + z] = project(x[middle + z], frame);
    }
    BRISANCE_UNROLL for (int z = -half; z <= half; ++z) {
      p[half + z] = jumps_[middle + z].third;
      thirds[half + z] = project(p[half + z], frame);
    }
    Face<V, Curve> const &low = faces_[here - 1], &high = faces_[here + 1];
    V const two(2.0);
    auto const smooth = smooth_window(f, frame);
    auto run = [&](auto const& keep) __attribute__((always_inline)) {
      // One field: `component(a, y)` is its strength in a jump or correction y with the acoustic part a.
      auto field = [&](Wave<Order, V> const& wave, V strength, auto acoustic, auto const& component)
          __attribute__((always_inline)) {
        auto jump = [&](int z) __attribute__((always_inline)) { return component(jumps[middle + z], x[middle + z]); };
        auto third = [&](int z) __attribute__((always_inline)) {
          V const own = component(thirds[half + z], p[half + z]);
          if constexpr (!Mixed || !acoustic.value) return own;
          V const nu = min(k.sigma * (two * wave.half_speed), V(1.0));
          V const factor = flip(V(1.0 / 3) * wave.half_speed * fnma(nu, nu, V(1.0)), wave.sign);
          return select(steep, factor * (z == 0 ? strength : jump(z)), own);
        };
        return field_flux<Order>(wave, strength, jump, third, keep,
                                 smooth.template field < Mixed && acoustic.value > (wave, component, steep));
      };
      using A = Acoustic<V>;
      part[0] = field(
          make_wave(f.u - f.sound, f.speed1, low.room1, high.room1, k), f.strength[0], std::true_type{},
          [](A const& a, V const*) __attribute__((always_inline)) { return a.pressure - a.velocity; });
      part[4] = field(
          make_wave(f.u + f.sound, f.speed5, low.room5, high.room5, k), f.strength[4], std::true_type{},
          [](A const& a, V const*) __attribute__((always_inline)) { return a.pressure + a.velocity; });
      auto const wave = make_wave(f.u, abs(f.u), low.room0, high.room0, k);
      part[1] = field(
          wave, f.strength[1], std::false_type{}, [&](A const& a, V const* y) __attribute__((always_inline)) {
            return fnma(two, a.pressure, y[0]);
          });
      part[2] = field(
          wave, f.strength[2], std::false_type{}, [&](A const&, V const* y) __attribute__((always_inline)) {
            return fnma(frame.v, y[0], y[2]);
          });
      part[3] = field(
          wave, f.strength[3], std::false_type{}, [&](A const&, V const* y) __attribute__((always_inline)) {
            return fnma(frame.w, y[0], y[3]);
          });
    };
    if constexpr (Runs && Order >= 5) {
      V const order = spread(face_order);
      run([order](int q, V sum)
              __attribute__((always_inline)) { return select(order >= V(2.0 * q + 1), sum, V(0.0)); });
    } else {
      run(AllOrders{});
    }
  }

  static BRISANCE_INLINE Wave<Order, V> make_wave(V lambda, V speed, V room_low, V room_high,
                                                  SweepConstants<V, Curve> const& k) {
    Wave<Order, V> wave;
    V const nu = min(k.sigma * speed, V(1.0));
    wave.leftward = negative(lambda);
    wave.sign = lambda;
    wave.half_speed = V(0.5) * speed;
    wave.second = fnma(wave.half_speed, nu, wave.half_speed);
    wave.room = select(wave.leftward, room_high, room_low);
    set_ratios(wave, nu);
    return wave;
  }

  /// Both cells of the face take twice the difference alone: if that leaves them admissible, so does the whole step.
  BRISANCE_INLINE void keep_positive(V* difference, Gas const& gas, SweepConstants<V, Curve> const& k, Index f,
                                     PencilData const& data, RunData const* runs, PencilReport<V>& report) {
    Face<V, Curve> const &face = faces_[here], &next = faces_[here + 1];
    V const twice = V(2.0) * k.sigma;
    V const margin = min(positivity_margin(face.low_state, face.energy_floor, difference, -twice, k),
                         positivity_margin(next.low_state, next.energy_floor, difference, twice, k));
    Mask<V> const failed = !(margin >= V(0.0));
    if (any_of(failed)) [[unlikely]] {
      V copy[5];
      for (int n = 0; n < 5; ++n) copy[n] = difference[n];
      std::uint32_t limited = limit_face(copy, face.low_state, next.low_state, gas, k.sigma, bits_of(failed));
      limited &= f == data.n ? data.counted_high : f == data.n - 1 ? data.counted_last : data.valid;
      if constexpr (Runs) limited &= existing_faces(runs, f);
      (f < data.n ? report.fallback : report.fallback_high) += __builtin_popcount(limited);
      for (int n = 0; n < 5; ++n) difference[n] = copy[n];
    }
  }

  BRISANCE_INLINE void update(V const* difference, V const* before, PencilData const& data, Index c,
                              SweepConstants<V, Curve> const& k, Gas const& gas, PencilReport<V>& report) {
    V x[5];
    Face<V, Curve> const& face = faces_[here];
    BRISANCE_UNROLL for (std::size_t q = 0; q < 5; ++q) {
      x[q] = fnma(k.sigma, difference[q] - before[q], face.low_state[q]);
      store(data.out[q] + c * data.out_stride, x[q]);
    }
    if constexpr (!Runs) {
      if (auto const mask = suspect(x, k); any_of(mask)) [[unlikely]]
        judge_cell(data, c, bits_of(mask) & data.valid, gas, report);
    }
  }

  BRISANCE_INLINE void give_flux(V const* difference, Real* p) {
    BRISANCE_UNROLL for (int n = 0; n < 5; ++n) store(p + n * lanes, faces_[here].low_flux[n] + difference[n]);
  }

  [[gnu::noinline, gnu::cold]] void judge_cell(PencilData const& data, Index c, std::uint32_t lanes_asked,
                                               Gas const& gas, PencilReport<V>& report) {
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(lanes_asked >> lane & 1)) continue;
      State u;
      for (std::size_t q = 0; q < 5; ++q) u[q] = data.out[q][c * data.out_stride + lane];
      if (std::uint64_t const bits = judge(u, gas)) note(bits, 1u << lane, c, report);
    }
  }
  [[gnu::noinline, gnu::cold]] void note(std::uint64_t health, std::uint32_t where, Index c, PencilReport<V>& report) {
    if (where == 0) return;
    if (report.health == 0) report.bad_lane = __builtin_ctz(where), report.bad_cell = c;
    report.health |= health;
  }

  /// Orders of a face as numbers of the lanes.
  static V spread(std::uint8_t const* face_order) {
    Real order[lanes];
    for (int lane = 0; lane < lanes; ++lane) order[lane] = face_order[lane];
    return load<V>(order);
  }
  /// Lanes in which cell c belongs to the run: both its faces exist (order above 0).
  static Mask<V> inside(RunData const* runs, Index c) {
    std::uint8_t const* const p = runs->face_order + std::ptrdiff_t{c} * lanes;
    return (spread(p) > V(0.0)) & (spread(p + lanes) > V(0.0));
  }
  static std::uint32_t existing_faces(RunData const* runs, Index f) {
    return bits_of(spread(runs->face_order + std::ptrdiff_t{f} * lanes) > V(0.0));
  }
};

}  // namespace brisance::fluid
