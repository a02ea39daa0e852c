// The effect output.gauges: values at points after every step, and their files. Reads the flow and changes nothing of
// it.
#pragma once
#include <string>
#include <vector>

#include "core/model/sampled_files.hpp"
#include "fluid/flow.hpp"
#include "fluid/fluid_volume.hpp"
#include "fluid/gauges/gauge_history.hpp"

namespace brisance::fluid {

/// Every rank notes the cells it owns; rank 0 interpolates, so that files depend on the contents of cells alone.
class Gauges : public SampledFiles {
 public:
  /// `volume`: fluid volume of the cells; it must stay valid.
  Gauges(std::vector<GaugeConfig> gauges, FlowConfig const& flow_config, Flow& flow, FluidVolume volume);

  std::vector<GaugeConfig> const& configs() const { return configs_; }
  GaugeFigures const& figures(std::size_t gauge) const { return histories_[gauge].figures(); }  ///< on rank 0

 private:
  struct Cell {
    Block const* block;
    Index i, j, k;
    CellIndex global;
  };
  std::size_t count() const override { return configs_.size(); }
  std::string const& name_of(std::size_t gauge) const override { return configs_[gauge].name; }
  bool is_state(Clock const& clock) const override;
  void note() override;
  void keep_first(std::size_t notes) override { notes_.resize(notes * mine_.size()); }
  void drop_first(std::size_t notes) override;
  std::size_t note_bytes() const override { return notes_.capacity() * sizeof(GaugeValue); }
  void collect(std::size_t notes) override;
  SampledSeries& series(std::size_t gauge) override { return histories_[gauge]; }
  void start(std::size_t gauge, Real time, std::string& rows) override;
  void add(std::size_t gauge, Real time, std::size_t note, std::string& rows) override;
  GaugeValue at_gauge(std::size_t gauge, std::vector<GaugeValue> const& slots) const;

  std::vector<GaugeConfig> configs_;
  Flow& flow_;
  FluidVolume volume_;
  std::vector<GaugeStencil> stencils_;
  std::vector<GaugeHistory> histories_;
  std::vector<int> slot_owner_;                  ///< rank of every stencil cell, gauge by gauge
  std::vector<std::size_t> first_slot_;          ///< of every gauge
  std::vector<Cell> mine_;                       ///< stencil cells of this rank, in the order of the slots
  std::vector<GaugeValue> notes_;                ///< [note][cell of mine_]
  std::vector<std::vector<GaugeValue>> values_;  ///< collected on rank 0: of all stencil cells, [note][slot]
};

}  // namespace brisance::fluid
