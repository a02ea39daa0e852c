#include "fluid/gauges/gauges.hpp"

#include <cstring>

#include "fluid/cell_state.hpp"

namespace brisance::fluid {

Gauges::Gauges(std::vector<GaugeConfig> gauges, FlowConfig const& flow_config, Flow& flow, FluidVolume volume)
    : SampledFiles("output.gauges", "gauges", flow.comm()),
      configs_(std::move(gauges)),
      flow_(flow),
      volume_(std::move(volume)) {
  Grid const& grid = flow.grid();
  for (GaugeConfig const& gauge : configs_) {
    GaugeStencil const& stencil = stencils_.emplace_back(grid, gauge.position);
    histories_.emplace_back(gauge, flow_config, grid.dimension);
    first_slot_.push_back(slot_owner_.size());
    for (CellIndex const c : stencil.cells()) {
      Index const id = grid.block_of(c);
      slot_owner_.push_back(flow.owner(id));
      if (Block const* block = flow.find(id)) {
        CellIndex const first = block->first();
        mine_.push_back({block, c[0] - first[0], c[1] - first[1], c[2] - first[2], c});
      }
    }
  }
}

bool Gauges::is_state(Clock const& clock) const {
  // Inside a merged pair the directions stand at different times: only its end is a state.
  bool const merged = flow_.splitting() == Splitting::merged && flow_.grid().dimension > 1;
  return !merged || clock.step % 2 != 0;
}

void Gauges::note() {
  Real const whole = flow_.grid().cell_volume();
  for (Cell const& c : mine_) {
    Real const share = volume_.cuts(c.block->id()) ? volume_(c.global) / whole : 1;
    if (flow_.mixture()) {
      CellState const cell(flow_, *c.block, c.i, c.j, c.k);
      notes_.push_back({cell.density(), cell.pressure(), cell.velocity(), share});
    } else {
      notes_.push_back(gauge_value(flow_.gas(), c.block->load(c.i, c.j, c.k), share));
    }
  }
}

void Gauges::collect(std::size_t notes) {
  parallel::Bytes bytes(notes * mine_.size() * sizeof(GaugeValue));
  std::memcpy(bytes.data(), notes_.data(), bytes.size());
  std::vector<parallel::Bytes> const all = flow_.comm().gather(bytes, 0);
  if (flow_.comm().rank() != 0) return;
  std::vector<std::span<std::byte const>> in(all.begin(), all.end());
  values_.assign(notes, {});
  for (std::vector<GaugeValue>& slots : values_)
    for (int const rank : slot_owner_) slots.push_back(parallel::take<GaugeValue>(in[static_cast<std::size_t>(rank)]));
}

GaugeValue Gauges::at_gauge(std::size_t gauge, std::vector<GaugeValue> const& slots) const {
  return stencils_[gauge].value(std::span(slots).subspan(first_slot_[gauge], stencils_[gauge].cells().size()));
}

void Gauges::drop_first(std::size_t notes) {
  notes_.erase(notes_.begin(), notes_.begin() + static_cast<std::ptrdiff_t>(notes * mine_.size()));
}

void Gauges::start(std::size_t gauge, Real time, std::string& rows) {
  histories_[gauge].start(time, at_gauge(gauge, values_.front()), rows);
}

void Gauges::add(std::size_t gauge, Real time, std::size_t note, std::string& rows) {
  histories_[gauge].add(time, at_gauge(gauge, values_[note]), rows);
}

}  // namespace brisance::fluid
