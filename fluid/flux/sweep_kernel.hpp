// From boxes and bundles to pencils: who stands in which lane, and the transposes of an x sweep. Included by one .cpp
// per order.
#pragma once
#include <vector>

#include "fluid/flux/pencil.hpp"

namespace brisance::fluid::detail {

template <int Order, class Curve, bool Smooth>
SweepReport sweep_box_of(CellBox const& box, int direction, Real sigma, Gas const& gas, SweepOptions const& options);
template <int Order, class Curve, bool Smooth>
SweepReport sweep_lines_of(LineBundle const& lines, std::uint32_t valid_lanes, Real sigma, Gas const& gas,
                           SweepOptions const& options);

inline constexpr int width = lanes_of<Pack>;

/// Lanes of one gathered bundle: where the first cell of each stands, and the pencil it is (a part of).
struct Lanes {
  std::array<std::ptrdiff_t, width> offset{};
  std::array<Index, width> pencil{}, first{};
  std::uint32_t valid = 0, counted_last = 0, counted_low = 0, counted_high = 0;
  Index n = 0;
};

/// Copies cells of scattered pencils into scratch [cell][5][lane]. Tiles of lanes x lanes cells are transposed in
/// registers; the last tile overlaps the one before it, so that nothing outside the pencil is read.
inline void gather(std::array<Real*, 5> const& u, Lanes const& lanes, std::ptrdiff_t stride, Index begin, Index end,
                   Pack* scratch) {
  Real* const values = reinterpret_cast<Real*>(scratch);
  for (std::size_t q = 0; q < 5; ++q) {
    if (stride == 1 && end - begin >= width) {
      for (Index c = begin; c < end; c = c + 2 * width <= end || c + width == end ? c + width : end - width) {
        Pack tile[width];
        for (std::size_t lane = 0; lane < width; ++lane) tile[lane] = load<Pack>(u[q] + lanes.offset[lane] + c);
        transpose(tile);
        Pack* const to = scratch + std::ptrdiff_t{c - begin} * 5 + static_cast<std::ptrdiff_t>(q);
        for (int i = 0; i < width; ++i) to[5 * i] = tile[i];
      }
    } else {
      for (Index c = begin; c < end; ++c)
        for (std::size_t lane = 0; lane < width; ++lane)
          values[(std::size_t(c - begin) * 5 + q) * width + lane] = u[q][lanes.offset[lane] + c * stride];
    }
  }
}
/// The way back, cells 0..n-1 of the valid lanes.
inline void scatter(std::array<Real*, 5> const& u, Lanes const& lanes, std::ptrdiff_t stride, Pack const* scratch) {
  Real const* const values = reinterpret_cast<Real const*>(scratch);
  Index const n = lanes.n;
  for (std::size_t q = 0; q < 5; ++q) {
    if (stride == 1 && n >= width) {
      for (Index c = 0; c < n; c = c + 2 * width <= n || c + width == n ? c + width : n - width) {
        Pack tile[width];
        Pack const* const from = scratch + std::ptrdiff_t{c} * 5 + static_cast<std::ptrdiff_t>(q);
        for (int i = 0; i < width; ++i) tile[i] = from[5 * i];
        transpose(tile);
        for (std::size_t lane = 0; lane < width; ++lane)
          if (lanes.valid >> lane & 1) store(u[q] + lanes.offset[lane] + c, tile[lane]);
      }
    } else {
      for (Index c = 0; c < n; ++c)
        for (std::size_t lane = 0; lane < width; ++lane)
          if (lanes.valid >> lane & 1)
            u[q][lanes.offset[lane] + c * stride] = values[(std::size_t(c) * 5 + q) * width + lane];
    }
  }
}

/// The sweep of one box: bundles of neighbours in x as they stand, all other pencils through scratch memory.
template <int Order, class Curve, bool Smooth>
class BoxSweep {
 public:
  BoxSweep(CellBox const& box, int direction, Real sigma, Gas const& gas, SweepOptions const& options)
      : box_(box),
        sigma_(sigma),
        gas_(gas),
        options_(options),
        along_(static_cast<std::size_t>(direction)),
        fast_(direction == 0 ? 1 : 0),
        slow_(direction == 2 ? 1 : 2),
        n_(box.size[along_]),
        component_(sweep_components(direction)) {
    for (std::size_t q = 0; q < 5; ++q) {
      u_[q] = box.u[component_[q]];
      result_[q] = box.result[0] ? box.result[component_[q]] : u_[q];
    }
  }

  SweepReport run() {
    bool const as_they_stand = along_ != 0 && box_.stride[0] == 1;
    Index const bundles = as_they_stand ? box_.size[0] / width : 0;
    for (Index s = 0; s < box_.size[slow_]; ++s)
      for (Index b = 0; b < bundles; ++b) sweep_in_place(b * width, s);
    sweep_gathered(bundles * width);
    for (int lane = 0; lane < width; ++lane)
      report_.signal_max = max(report_.signal_max, signal_.get(std::size_t(lane)));
    return report_;
  }

 private:
  static Index min(Index a, Index b) { return a < b ? a : b; }
  static constexpr std::uint32_t all = (1u << width) - 1;

  std::ptrdiff_t offset(Index fast, Index slow) const { return fast * box_.stride[fast_] + slow * box_.stride[slow_]; }

  bool cured() const { return options_.shear_dissipation > 0 && box_.marks; }
  /// The marks of a bundle, a bit a lane; `start(lane)` is the place of its cell 0. A bundle without any runs as if
  /// there were no cure: most do, so that is found out first.
  template <class Start>
  void gather_marks(PencilData& data, Start start) {
    auto const across = static_cast<std::uint8_t>(7u & ~(1u << along_));
    std::ptrdiff_t const stride = box_.mark_stride[along_];
    std::array<std::uint8_t const*, width> mark;
    std::uint8_t any = 0;
    for (std::size_t lane = 0; lane < width; ++lane) mark[lane] = box_.marks + start(lane);
    if (stride == 1) {
      for (std::uint8_t const* const row : mark)
        for (Index c = -1; c <= data.n; ++c) any = static_cast<std::uint8_t>(any | row[c]);
    } else if (data.valid == all && mark[width - 1] - mark[0] == width - 1) {  // lanes side by side
      for (Index c = -1; c <= data.n; ++c)
        for (std::size_t lane = 0; lane < width; ++lane)
          any = static_cast<std::uint8_t>(any | mark[0][c * stride + static_cast<std::ptrdiff_t>(lane)]);
    } else {
      any = across;
    }
    if (!(any & across)) return;
    marks_.assign(static_cast<std::size_t>(data.n) + 2, 0);
    for (std::size_t lane = 0; lane < width; ++lane) {
      if (!(data.valid >> lane & 1)) continue;
      for (Index c = -1; c <= data.n; ++c)
        marks_[static_cast<std::size_t>(c + 1)] |= (mark[lane][c * stride] & across) != 0 ? 1u << lane : 0u;
    }
    data.marks = marks_.data() + 1;
  }

  std::ptrdiff_t mark_offset(Index fast, Index slow) const {
    return fast * box_.mark_stride[fast_] + slow * box_.mark_stride[slow_];
  }

  void sweep_in_place(Index fast, Index slow) {
    PencilData data{n_, {}, {}, box_.stride[along_], box_.stride[along_], all, all, all};
    for (std::size_t q = 0; q < 5; ++q) {
      data.in[q] = u_[q] + offset(fast, slow);
      data.out[q] = result_[q] + offset(fast, slow);
    }
    Lanes lanes;
    for (Index lane = 0; lane < width; ++lane) lanes.pencil[std::size_t(lane)] = fast + lane;
    lanes.counted_low = lanes.counted_high = all;
    if (cured()) gather_marks(data, [&](std::size_t lane) { return mark_offset(lanes.pencil[lane], slow); });
    take(data, lanes, [&](std::size_t lane) { return std::array{lanes.pencil[lane], slow}; });
  }

  /// All pencils from column `start` on, through scratch memory. While one bundle is swept the next one is asked for.
  void sweep_gathered(Index start) {
    constexpr Index ghosts = Stencil<Order>::ghosts;
    Index const span = box_.size[fast_] - start, pencils = span * box_.size[slow_];
    std::ptrdiff_t const stride = box_.stride[along_];
    thread_local std::vector<Pack> scratch;
    Lanes next;
    if (pencils > 0) next = fill_lanes(start, span, 0, min(pencils, width));
    for (Index first = 0; first < pencils; first += width) {
      Lanes const lanes = next;
      if (first + width < pencils) next = fill_lanes(start, span, first + width, min(pencils - first - width, width));
      auto const needed = static_cast<std::size_t>(lanes.n + 2 * ghosts) * 5;
      if (scratch.size() < needed) scratch.resize(needed);
      gather(u_, lanes, stride, -ghosts, lanes.n + ghosts, scratch.data());
      Pack* const origin = scratch.data() + 5 * ghosts;
      PencilData data{lanes.n, {}, {}, 5 * width, 5 * width, lanes.valid, lanes.counted_last, lanes.counted_high};
      for (std::size_t q = 0; q < 5; ++q) {
        data.in[q] = data.out[q] = reinterpret_cast<Real*>(origin + q);
        data.next[q] = u_[q];
      }
      data.next_offset = next.offset.data();
      if (cured())
        gather_marks(data, [&](std::size_t lane) {
          return mark_offset(start + lanes.pencil[lane] % span, lanes.pencil[lane] / span) +
                 lanes.first[lane] * box_.mark_stride[along_];
        });
      take(data, lanes, [&](std::size_t lane) {
        return std::array{start + lanes.pencil[lane] % span, lanes.pencil[lane] / span};
      });
      scatter(result_, lanes, stride, origin);
    }
  }

  /// Pencils first..first+count-1 of those numbered fast-first over `span` columns from `start`. When they are few,
  /// each is cut into parts that fill the lanes: the same bits, since a cell's value does not depend on where its
  /// pencil starts.
  Lanes fill_lanes(Index start, Index span, Index first, Index count) const {
    Index const parts = min(width / count, n_ < 2 ? 1 : n_ / 2), length = (n_ + parts - 1) / parts;
    Index const shorter = length * parts - n_;  // parts of one cell less; their last cell is also the next part's first
    Lanes lanes;
    lanes.n = length;
    for (Index lane = 0; lane < width; ++lane) {
      auto const l = static_cast<std::size_t>(lane);
      Index const used = min(lane, count * parts - 1), part = used % parts;
      lanes.pencil[l] = first + used / parts;
      lanes.first[l] = part * length - min(part, shorter);
      lanes.offset[l] =
          offset(start + lanes.pencil[l] % span, lanes.pencil[l] / span) + lanes.first[l] * box_.stride[along_];
      if (lane >= count * parts) continue;
      lanes.valid |= 1u << lane;
      if (part >= shorter) lanes.counted_last |= 1u << lane;
      if (part == 0) lanes.counted_low |= 1u << lane;
      if (part == parts - 1) lanes.counted_high |= 1u << lane;
    }
    return lanes;
  }

  /// Sweeps a bundle and adds what it saw to the report of the box; `place(lane)` gives the pencil's (fast, slow)
  /// indices.
  template <class Place>
  void take(PencilData const& data, Lanes const& lanes, Place place) {
    PencilReport<Pack> seen;
    seen.signal = signal_;
    pencil_.sweep(data, nullptr, sigma_, gas_, options_, seen);
    signal_ = seen.signal;
    report_.fallback_faces += seen.fallback;
    report_.fallback_faces_high_end += seen.fallback_high;
    if (seen.health != 0 && report_.health == 0) {
      auto const lane = static_cast<std::size_t>(seen.bad_lane);
      auto const [fast, slow] = place(lane);
      report_.where[along_] = lanes.first[lane] + seen.bad_cell;
      report_.where[fast_] = fast;
      report_.where[slow_] = slow;
    }
    report_.health |= seen.health;
    for (std::size_t q = 0; q < 5; ++q)
      for (std::size_t lane = 0; lane < width; ++lane) {
        if (lanes.counted_low >> lane & 1) report_.flux_low[component_[q]] += seen.flux_low[q].get(lane);
        if (lanes.counted_high >> lane & 1) report_.flux_high[component_[q]] += seen.flux_high[q].get(lane);
      }
  }

  CellBox const& box_;
  Real const sigma_;
  Gas const& gas_;
  SweepOptions const& options_;
  std::size_t const along_, fast_, slow_;
  Index const n_;
  std::array<std::size_t, 5> const component_;
  std::array<Real*, 5> u_{}, result_{};
  Pencil<Order, Pack, Curve, false, Smooth> pencil_;
  std::vector<std::uint32_t> marks_;
  Pack signal_ = Pack(0.0);
  SweepReport report_;
};

template <int Order, class Curve, bool Smooth>
SweepReport sweep_box_of(CellBox const& box, int direction, Real sigma, Gas const& gas, SweepOptions const& options) {
  return BoxSweep<Order, Curve, Smooth>(box, direction, sigma, gas, options).run();
}

template <int Order, class Curve, bool Smooth>
SweepReport sweep_lines_of(LineBundle const& lines, std::uint32_t valid_lanes, Real sigma, Gas const& gas,
                           SweepOptions const& options) {
  PencilData data{lines.n, {}, {}, 5 * width, 5 * width, valid_lanes, valid_lanes, valid_lanes};
  for (std::size_t q = 0; q < 5; ++q) {
    data.in[q] = lines.u + q * width;
    data.out[q] = lines.result + q * width;
  }
  if (options.shear_dissipation > 0) data.marks = lines.marks;
  RunData const runs{lines.flux, lines.pressure, lines.face_order};
  Pencil<Order, Pack, Curve, true, Smooth> pencil;
  PencilReport<Pack> seen;
  pencil.sweep(data, &runs, sigma, gas, options, seen);
  SweepReport report;
  for (std::size_t lane = 0; lane < width; ++lane)
    if (valid_lanes >> lane & 1) report.signal_max = max(report.signal_max, seen.signal.get(lane));
  report.fallback_faces = seen.fallback;
  report.fallback_faces_high_end = seen.fallback_high;
  return report;
}

#define BRISANCE_INSTANTIATE_SWEEP(Order, Curve, Smooth)                                                               \
  namespace brisance::fluid::detail {                                                                                  \
  template SweepReport sweep_box_of<Order, Curve, Smooth>(CellBox const&, int, Real, Gas const&, SweepOptions const&); \
  template SweepReport sweep_lines_of<Order, Curve, Smooth>(LineBundle const&, std::uint32_t, Real, Gas const&,        \
                                                            SweepOptions const&);                                      \
  }

}  // namespace brisance::fluid::detail
