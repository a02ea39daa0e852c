#include "drivers/history.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "parallel/error.hpp"

namespace brisance::drivers {

namespace {

void require_written(std::ofstream const& file, std::string const& path) {
  require(file.good(), Failure::system, path + ": cannot be written (is the disk full?)");
}

void start_file(std::string const& path, std::string kept, std::int64_t step) {
  std::ifstream old(path);
  std::string line;
  if (step > 0 && std::getline(old, line))
    while (std::getline(old, line))
      if (std::atoll(line.c_str()) <= step) kept += line + "\n";
  old.close();
  std::ofstream file(path);
  file << kept << std::flush;
  require_written(file, path);
}

void append(std::string const& path, std::string const& rows) {
  std::ofstream file(path, std::ios::app);
  file << rows << std::flush;
  require_written(file, path);
}

std::string history_header() {
  return "step,time,dt,limited_by,mass,energy,energy_fluid,energy_kinetic,energy_elastic,energy_stored,energy_"
         "dissipated,defect_mass,"
         "defect_momentum_x,"
         "defect_momentum_y,defect_momentum_z,defect_exchange_energy,defect_energy,defect_energy_fluid,defect_energy_"
         "solid,"
         "links_broken\n";
}

/// Where the energy defect comes from, over the scale of defect_energy: the fluid and its walls (sweeps, flow_update,
/// mix), and the steps of the solid (kick to fracture). Their sum is defect_energy.
std::array<Real, 2> energy_defects(Ledger const& l) {
  auto const stored = l.store();  // begins with the totals of the start
  auto const change = [&](Entry e) { return l.total(e) - stored[static_cast<std::size_t>(e)]; };
  Real const fluid = change(Entry::fluid_energy) - l.received(Entry::fluid_in_energy) + l.received(Entry::wall_work);
  Real const all = change(Entry::energy) - l.received(Entry::in_energy) + l.received(Entry::dissipated);
  Real const scale =
      max(max(std::abs(l.total(Entry::energy)), std::abs(stored[static_cast<std::size_t>(Entry::energy)])),
          l.received(Entry::exchanged_energy));
  return scale > 0 ? std::array<Real, 2>{fluid / scale, (all - fluid) / scale}
                   : std::array<Real, 2>{fluid, all - fluid};
}

std::string history_row(World const& world) {
  Simulation const& s = *world.simulation;
  Ledger const& l = s.ledger();
  Conservation const& c = l.conservation();
  std::array<Real, 2> const energy = energy_defects(l);
  return fmt::format(
      "{},{:.17g},{:.17g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g}"
      ",{:.3g},{:.3g},{:.3g},{}\n",
      s.clock().step, s.clock().time, s.clock().dt, s.limited_by(), l.total(Entry::mass), l.total(Entry::energy),
      l.total(Entry::fluid_energy), l.total(Entry::solid_kinetic), l.total(Entry::solid_elastic),
      l.total(Entry::solid_stored), l.received(Entry::dissipated), c.mass, c.momentum.x, c.momentum.y, c.momentum.z,
      c.exchange_energy, c.energy_final, energy[0], energy[1],
      static_cast<std::int64_t>(l.received(Entry::links_broken)));
}

std::string stage_header() { return "step,time,stage,mass,momentum_x,momentum_y,momentum_z,energy\n"; }

std::string stage_rows(World const& world) {
  Clock const& clock = world.simulation->clock();
  StageLedger const& stages = *world.simulation->stages();
  std::string rows;
  for (std::size_t p = 0; p < part_count; ++p) {
    Part const part = static_cast<Part>(p);
    if (!stages.charged(part)) continue;
    std::array<Real, 5> const d = stages.defect(part);
    rows += fmt::format("{},{:.17g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", clock.step, clock.time, name(part),
                        d[0], d[1], d[2], d[3], d[4]);
  }
  return rows;
}

/// Multiples of the interval that have passed.
double passed(Clock const& clock, double interval) { return std::floor(clock.time / interval * (1 + 1e-12)); }

}  // namespace

History::History(World const& world, std::string const& directory, std::optional<double> interval)
    : world_(world),
      history_(directory + "/history.csv"),
      stages_(world.simulation->stages() ? directory + "/stages.csv" : ""),
      interval_(interval) {
  if (world.comm->rank() != 0) return;
  Clock const& clock = world.simulation->clock();
  start_file(history_, history_header(), clock.step);
  if (!stages_.empty()) start_file(stages_, stage_header(), clock.step);
  if (interval_) next_ = passed(clock, *interval_) + 1;
}

void History::row() {
  if (world_.comm->rank() != 0) return;
  if (interval_) {
    Clock const& clock = world_.simulation->clock();
    if (clock.time < next_ * *interval_ * (1 - 1e-12)) return;
    next_ = passed(clock, *interval_) + 1;
  }
  append(history_, history_row(world_));
  if (!stages_.empty()) append(stages_, stage_rows(world_));
}

}  // namespace brisance::drivers
