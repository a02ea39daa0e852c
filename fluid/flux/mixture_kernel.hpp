// From boxes to bundles of pencils of a mixture: copies to scratch memory and back. Included by one .cpp per order.
#pragma once
#include <vector>

#include "fluid/flux/mixture_pencil.hpp"

namespace brisance::fluid::detail {

/// The sweep of one box; always through scratch memory, since seven strided streams cost more than the copy.
template <int Order>
MixtureReport sweep_mixture_of(MixtureBox const& box, int direction, Real sigma, Mixture const& mixture,
                               SweepOptions const& options) {
  constexpr int width = lanes_of<Pack>;
  constexpr Index ghosts = Stencil<Order>::ghosts;
  auto const along = static_cast<std::size_t>(direction);
  std::size_t const fast = direction == 0 ? 1 : 0, slow = direction == 2 ? 1 : 2;
  std::array<std::size_t, 5> const swapped = sweep_components(direction);
  std::array<std::size_t, 7> const component{swapped[0], swapped[1], swapped[2], swapped[3], swapped[4], 5, 6};
  Index const n = box.size[along], span = box.size[fast], pencils = span * box.size[slow];
  thread_local std::vector<Pack> scratch;
  auto const needed = static_cast<std::size_t>(n + 2 * ghosts) * 7;
  if (scratch.size() < needed) scratch.resize(needed);
  Real* const origin = reinterpret_cast<Real*>(scratch.data() + 7 * ghosts);

  MixturePencil<Order, Pack> pencil;
  MixtureReport report;
  Pack signal(0.0);
  for (Index first = 0; first < pencils; first += width) {
    Index const count = pencils - first < width ? pencils - first : width;
    std::array<std::ptrdiff_t, width> offset, mark_offset;
    for (int lane = 0; lane < width; ++lane) {
      Index const used = first + (lane < count ? lane : count - 1);  // lanes left over repeat the last pencil
      auto const l = static_cast<std::size_t>(lane);
      offset[l] = used % span * box.stride[fast] + used / span * box.stride[slow];
      mark_offset[l] = used % span * box.mark_stride[fast] + used / span * box.mark_stride[slow];
    }
    std::ptrdiff_t const stride = box.stride[along];
    for (Index c = -ghosts; c < n + ghosts; ++c)
      for (std::size_t q = 0; q < 7; ++q)
        for (std::size_t lane = 0; lane < width; ++lane)
          origin[(std::ptrdiff_t{c} * 7 + std::ptrdiff_t(q)) * width + std::ptrdiff_t(lane)] =
              box.u[component[q]][offset[lane] + c * stride];
    std::uint32_t const valid = (1u << count) - 1;
    MixturePencilReport<Pack> seen;
    seen.signal = signal;
    MixtureBundle data{n, origin, valid};
    if (options.shear_dissipation > 0 && box.marks) {
      data.marks = box.marks, data.mark_stride = box.mark_stride[along];
      data.mark_mask = static_cast<std::uint8_t>(7u & ~(1u << along));
      data.mark_offset = mark_offset;
    }
    pencil.sweep(data, sigma, mixture, options, seen);
    signal = seen.signal;
    for (Index c = 0; c < n; ++c)
      for (std::size_t q = 0; q < 7; ++q)
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(count); ++lane)
          box.u[component[q]][offset[lane] + c * stride] =
              origin[(std::ptrdiff_t{c} * 7 + std::ptrdiff_t(q)) * width + std::ptrdiff_t(lane)];

    report.fallback_faces += seen.fallback;
    report.fallback_faces_high_end += seen.fallback_high;
    if (seen.health != 0 && report.health == 0) {
      report.where[along] = seen.bad_cell;
      report.where[fast] = (first + seen.bad_lane) % span;
      report.where[slow] = (first + seen.bad_lane) / span;
    }
    report.health |= seen.health;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(count); ++lane) {
      for (std::size_t q = 0; q < 5; ++q) {
        report.flux_low[component[q]] += seen.flux_low[q].get(lane);
        report.flux_high[component[q]] += seen.flux_high[q].get(lane);
      }
      report.products_low += seen.flux_low[5].get(lane);
      report.products_high += seen.flux_high[5].get(lane);
    }
  }
  for (std::size_t lane = 0; lane < width; ++lane) report.signal_max = max(report.signal_max, signal.get(lane));
  return report;
}

#define BRISANCE_INSTANTIATE_MIXTURE(Order)                                                     \
  template brisance::fluid::MixtureReport brisance::fluid::detail::sweep_mixture_of<Order>(     \
      brisance::fluid::MixtureBox const&, int, brisance::Real, brisance::fluid::Mixture const&, \
      brisance::fluid::SweepOptions const&);

}  // namespace brisance::fluid::detail
