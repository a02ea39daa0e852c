// The effect output.gauges: values at points after every step, and their files. Reads the flow and changes nothing of
// it.
#pragma once
#include <string>
#include <vector>

#include "core/model/plan.hpp"
#include "fluid/flow.hpp"
#include "fluid/fluid_volume.hpp"
#include "fluid/gauges/gauge_history.hpp"

namespace brisance::fluid {

/// Every rank notes the cells it owns, without a message; from time to time rank 0 collects the notes, interpolates
/// and appends rows. So files depend on cell contents and step times alone, not on ranks or on when they were written.
class Gauges : public Effect {
 public:
  /// `volume`: fluid volume of the cells; it must stay valid.
  Gauges(std::vector<GaugeConfig> gauges, FlowConfig const& flow_config, Flow& flow, FluidVolume volume);
  void join(Plan& plan) override;

  /// Collective. Call when the state of the start or of a checkpoint is in place. Files of gauges that the checkpoint
  /// knows lose the rows after it; the others begin here. Returns what a user ought to know (rank 0).
  /// Errors: Failure::system when a file cannot be written.
  std::vector<std::string> open(std::string const& directory, Clock const& clock);
  /// Collective. The pair that ended at clock.time is accepted.
  void accept(Clock const& clock);
  /// Collective. All accepted steps are in the files and in the figures of rank 0.
  void flush();

  std::vector<GaugeConfig> const& configs() const { return configs_; }
  GaugeFigures const& figures(std::size_t gauge) const { return histories_[gauge].figures(); }  ///< on rank 0

 private:
  struct Cell {
    Block const* block;
    Index i, j, k;
    CellIndex global;
  };
  void note(Real time);
  /// Collective. On rank 0: values of all stencil cells, [note][slot].
  std::vector<std::vector<GaugeValue>> collect(std::size_t notes);
  GaugeValue at_gauge(std::size_t gauge, std::vector<GaugeValue> const& slots) const;
  std::string path(std::size_t gauge) const;

  std::vector<GaugeConfig> configs_;
  Flow& flow_;
  FluidVolume volume_;
  std::vector<GaugeStencil> stencils_;
  std::vector<GaugeHistory> histories_;
  std::vector<int> slot_owner_;          ///< rank of every stencil cell, gauge by gauge
  std::vector<std::size_t> first_slot_;  ///< of every gauge
  std::vector<Cell> mine_;               ///< stencil cells of this rank, in the order of the slots
  std::vector<Real> times_;              ///< of the notes
  std::vector<GaugeValue> notes_;        ///< [note][cell of mine_]
  std::size_t accepted_ = 0;             ///< notes of accepted pairs
  std::string directory_;                ///< empty until opened
};

}  // namespace brisance::fluid
