#include "fluid/euler.hpp"

#include <algorithm>

#include "fluid/rows.hpp"

namespace brisance::fluid {

void Euler::join(Plan& plan) {
  plan.effect("fluid.euler", [this] { return flow_.bytes(); });
  int const dimension = flow_.grid().dimension;
  for (std::size_t sweep = 0; sweep < static_cast<std::size_t>(most_sweeps(dimension, flow_.splitting())); ++sweep) {
    auto const run = [this, sweep, dimension](Clock const& clock) {
      std::vector<Sweep> const sequence = sweeps(dimension, clock.step, flow_.splitting());
      if (sweep >= sequence.size()) return;  // the second step of a merged pair
      auto const [direction, share, middle] = sequence[sweep];
      if (sweep == 0 && clock.step % steps_per_pair(dimension) == 0) flow_.begin_pair();
      SweepReport const report = flow_.sweep(direction, share * clock.dt, clock.time + middle * clock.dt);
      fallback_faces_ += report.fallback_faces;
      if (report.health != 0 && report_.health == 0) report_.where = report.where;
      report_.health |= report.health;
      if (sweep == 0)
        for (Block const& block : std::as_const(flow_).blocks())
          cell_updates_ += std::int64_t{block.size()[0]} * block.size()[1] * block.size()[2];
    };
    auto const part = [this, sweep, dimension](Clock const& clock) {
      std::vector<Sweep> const sequence = sweeps(dimension, clock.step, flow_.splitting());
      return sweep_part(sequence[std::min(sweep, sequence.size() - 1)].direction);
    };
    plan.at(Stage::sweeps, run, part);
  }
  plan.limit("fluid.acoustic", [this](Clock const& clock) { return acoustic_limit(clock); });
  plan.health([this](Clock const&) { return judge(); });
  plan.account([this](Ledger& ledger) { account(ledger); });

  Plan::Keep keep;
  keep.save = [this] {
    flow_.save();
    saved_fallback_faces_ = fallback_faces_;
  };
  keep.restore = [this] {
    flow_.restore();
    fallback_faces_ = saved_fallback_faces_;
    report_ = {};
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    file.rows("fluid/cells", flow_.grid().cell_count(), flow_.components(), block_rows(flow_), pack_cells(flow_));
    std::int64_t faces = fallback_faces_;
    flow_.comm().sum(std::span(&faces, 1));
    file.attribute("fallback_faces", faces);
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    unpack_cells(flow_, file.rows("fluid/cells", flow_.components(), block_rows(flow_)));
    fallback_faces_ = flow_.comm().rank() == 0 ? file.integer("fallback_faces") : 0;
  };
  keep.digest = [this](parallel::Digest& digest) { add_cells(digest, flow_, volume_); };
  plan.keep(std::move(keep));
}

Real Euler::acoustic_limit(Clock const& clock) {
  std::array<Real, 3> const speeds = signal_speeds(flow_, volume_);
  // The slow start is part of the rule; the minimum over ranks is taken by the simulation.
  Real const cfl = courant_number(flow_.grid().dimension, clock.step, config_.cfl);
  return min(acoustic_time_step(flow_.grid(), speeds, cfl), side_time_step(flow_, clock.time, cfl));
}

Verdict Euler::judge() const {
  if (report_.health == 0) return {};
  CellIndex const c = report_.where;
  Vec3 const x = flow_.grid().centre(c);
  return {false, describe(report_.health) + " in cell (" + std::to_string(c[0]) + ", " + std::to_string(c[1]) + ", " +
                     std::to_string(c[2]) + ") at (" + std::to_string(x.x) + ", " + std::to_string(x.y) + ", " +
                     std::to_string(x.z) + ") m, rank " + std::to_string(flow_.comm().rank())};
}

void Euler::account(Ledger& ledger) {
  LocalTotals const held = local_totals(flow_, volume_);
  ledger.add(Entry::mass, held.mass);
  ledger.add(Entry::momentum_x, held.momentum[0]);
  ledger.add(Entry::momentum_y, held.momentum[1]);
  ledger.add(Entry::momentum_z, held.momentum[2]);
  ledger.add(Entry::energy, held.energy);
  ledger.add(Entry::fluid_energy, held.energy);
  ledger.add(Entry::momentum_size, held.momentum_size);
  BoundaryLedger::Crossed const crossed = flow_.ledger().take();
  ledger.add(Entry::in_mass, crossed.gained[0]);
  ledger.add(Entry::in_momentum_x, crossed.gained[1]);
  ledger.add(Entry::in_momentum_y, crossed.gained[2]);
  ledger.add(Entry::in_momentum_z, crossed.gained[3]);
  ledger.add(Entry::in_energy, crossed.gained[4]);
  ledger.add(Entry::fluid_in_energy, crossed.gained[4]);
  ledger.add(Entry::pressure_impulse, crossed.impulse);
  ledger.add(Entry::exchanged_energy, crossed.energy_size);
}

}  // namespace brisance::fluid
