#include "drivers/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace brisance::drivers {

namespace {

nlohmann::json number_or_null(double x) { return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr); }

double imbalance(std::vector<double> const& per_rank) {
  double sum = 0, most = 0;
  for (double const x : per_rank) sum += x, most = std::max(most, x);
  return sum > 0 ? most * static_cast<double>(per_rank.size()) / sum : 1;
}

nlohmann::ordered_json gauge_figures(fluid::Gauges const& gauges) {
  nlohmann::ordered_json all;
  for (std::size_t g = 0; g < gauges.configs().size(); ++g) {
    fluid::GaugeConfig const& gauge = gauges.configs()[g];
    fluid::GaugeFigures const& f = gauges.figures(g);
    all[gauge.name] = {{"position", {gauge.position.x, gauge.position.y, gauge.position.z}},
                       {"arrival_time", number_or_null(f.arrival)},
                       {"peak_overpressure", number_or_null(f.peak)},
                       {"peak_time", number_or_null(f.peak_time)},
                       {"lowest_overpressure", number_or_null(f.lowest)},
                       {"positive_duration", number_or_null(f.phase_end - f.phase_start)},
                       {"positive_phase_impulse",
                        std::isnan(f.phase_start) ? nlohmann::json(nullptr) : number_or_null(f.phase_impulse)},
                       {"impulse", f.impulse}};
  }
  return all;
}

nlohmann::ordered_json gauge_figures(solid::SolidGauges const& gauges) {
  nlohmann::ordered_json all;
  for (std::size_t g = 0; g < gauges.configs().size(); ++g) {
    Vec3 const& place = gauges.probe(g).place();
    RowSampler const& rows = gauges.rows(g);
    nlohmann::ordered_json figures{{"place", {place.x, place.y, place.z}}};
    for (std::size_t c = 0; c < rows.columns().size(); ++c)
      figures[rows.columns()[c]] = {number_or_null(rows.lowest()[c]), number_or_null(rows.highest()[c])};
    all[gauges.configs()[g].name] = figures;
  }
  return all;
}

nlohmann::ordered_json stage_figures(StageLedger const& stages, Ledger const& ledger) {
  DefectScales const scale = ledger.scales();
  nlohmann::ordered_json all;
  for (std::size_t p = 0; p < part_count; ++p) {
    Part const part = static_cast<Part>(p);
    if (!stages.charged(part)) continue;
    std::array<Real, 5> const most = stages.largest(part);
    all[name(part)] = {{"mass", most[0] / scale.mass},
                       {"momentum", {most[1] / scale.momentum, most[2] / scale.momentum, most[3] / scale.momentum}},
                       {"energy", most[4] / scale.energy},
                       {"energy_final", stages.defect(part)[4] / scale.energy}};
  }
  return all;
}

}  // namespace

void update_extrema(World& world, RunState& run) {
  if (!world.flow) return;
  fluid::Extremes const e = fluid::extremes(*world.flow, fluid_volumes(world));
  std::array<double, 2> low{e.density_min, e.pressure_min};
  std::array<double, 1> high{e.mach_max};
  world.comm->min(low);
  world.comm->max(high);
  run.density_min = min(run.density_min, low[0]);
  run.pressure_min = min(run.pressure_min, low[1]);
  run.mach_max = max(run.mach_max, high[0]);
}

void write_summary(World& world, RunState const& run, std::string const& directory) {
  parallel::Comm& comm = *world.comm;
  for (SampledFiles* files : world.sampled_files) files->flush();
  Simulation& simulation = *world.simulation;
  std::string const digest = simulation.digest().hex();

  // Gathered per rank: peak memory, wall time in tasks, then wall time and bytes of every effect.
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::vector<double> mine{static_cast<double>(usage.ru_maxrss) * 1024, 0};
  coupling::WallCost const walls = world.cut_cells ? world.cut_cells->cost() : coupling::WallCost{};
  for (Plan::EffectCost const& e : world.plan.effects()) {
    mine[1] += e.wall_s;
    mine.push_back(e.wall_s);
    mine.push_back(static_cast<double>(e.bytes()));
  }
  fluid::Flow::Saved const saved = world.flow ? world.flow->saved_by_sleep() : fluid::Flow::Saved{};
  mine.insert(mine.end(), {walls.geometry_s, walls.closest_s, walls.exchange_s});
  std::int64_t counts[] = {world.cut_cells ? world.cut_cells->cut_cell_count() : 0,
                           world.euler ? world.euler->fallback_faces() : 0,
                           world.euler ? world.euler->cell_updates() : 0,
                           world.dynamics ? world.dynamics->link_updates() : 0,
                           world.cut_cells ? world.cut_cells->cost().cut : 0,
                           saved.block_sweeps,
                           saved.block_sweeps_skipped,
                           saved.cell_sweeps,
                           saved.cell_sweeps_skipped,
                           world.dynamics ? world.dynamics->links_asleep() : 0,
                           world.cut_cells ? world.cut_cells->cost().moving : 0,
                           world.cut_cells ? world.cut_cells->cost().mixed : 0};
  comm.sum(std::span(counts));
  parallel::Bytes bytes(mine.size() * sizeof(double));
  std::memcpy(bytes.data(), mine.data(), bytes.size());
  auto const gathered = comm.gather(bytes, 0);

  std::string text;
  if (comm.rank() == 0) {
    std::vector<double> memory, busy, cells;
    std::array<double, 3> wall_s{};  // geometry, closest points, exchange, over all ranks
    std::vector<double> effect_wall(world.plan.effects().size(), 0), effect_bytes(world.plan.effects().size(), 0);
    for (parallel::Bytes const& b : gathered) {
      std::vector<double> v(mine.size());
      std::memcpy(v.data(), b.data(), b.size());
      memory.push_back(v[0]);
      for (std::size_t w = 0; w < 3; ++w) wall_s[w] += v[v.size() - 3 + w];
      busy.push_back(v[1]);
      for (std::size_t e = 0; e < effect_wall.size(); ++e) {
        effect_wall[e] = std::max(effect_wall[e], v[2 + 2 * e]);
        effect_bytes[e] += v[3 + 2 * e];
      }
    }
    cells.assign(static_cast<std::size_t>(comm.size()), 0);
    if (world.flow) {
      fluid::Grid const& g = world.flow->grid();
      for (Index b = 0; b < g.block_count(); ++b) {
        auto const p = g.block_position(b);
        double n = 1;
        for (std::size_t d = 0; d < 3; ++d)
          n *= g.cuts[d][static_cast<std::size_t>(p[d]) + 1] - g.cuts[d][static_cast<std::size_t>(p[d])];
        cells[static_cast<std::size_t>(world.flow->owner(b))] += n;
      }
    }
    Clock const& clock = simulation.clock();
    StepStatistics const& s = simulation.statistics();
    Conservation const& c = simulation.ledger().conservation();
    double const loop_s = std::max(run.wall_s - run.setup_s, 1e-9);
    nlohmann::ordered_json j;
    j["program"] = "brisance";
    j["version"] = BRISANCE_VERSION;
    j["scene"] = run.scene;
    j["ranks"] = comm.size();
    j["exit"] = run.exit;
    j["steps"] = clock.step;
    j["time"] = clock.time;
    j["wall_s"] = run.wall_s;
    j["setup_s"] = run.setup_s;
    j["cells"] = world.flow ? world.flow->grid().cell_count() : 0;
    j["cut_cells"] = counts[0];
    j["particles"] = world.mesh ? world.mesh->size() : 0;
    j["links"] = world.mesh ? static_cast<std::int64_t>(world.mesh->links.size()) : 0;
    j["links_broken"] = static_cast<std::int64_t>(simulation.ledger().received(Entry::links_broken));
    j["dt"] = {{"min", s.dt_min}, {"max", s.dt_max}, {"limited_by", s.limited_by}};
    if (world.cut_cells)
      j["sub_steps"] = {
          {"min", s.sub_steps_min},
          {"mean", clock.step > 0 ? static_cast<double>(s.solid_steps) / static_cast<double>(clock.step) : 0},
          {"max", s.sub_steps_max}};
    j["conservation"] = {{"mass", c.mass},
                         {"momentum", {c.momentum.x, c.momentum.y, c.momentum.z}},
                         {"exchange_energy", c.exchange_energy},
                         {"energy", c.energy},
                         {"energy_final", c.energy_final}};
    j["extrema"] = {{"density_min", number_or_null(run.density_min)},
                    {"pressure_min", number_or_null(run.pressure_min)},
                    {"mach_max", run.mach_max}};
    j["retries"] = s.retries;
    j["fallback_faces"] = counts[1];
    j["throughput"] = {{"cell_updates_per_s", static_cast<double>(counts[2]) / loop_s},
                       {"link_updates_per_s", static_cast<double>(counts[3]) / loop_s},
                       {"cut_cells_per_s", static_cast<double>(counts[4]) / loop_s}};
    if (world.cut_cells) {
      double const all_s = loop_s * comm.size(),
                   cells_done = static_cast<double>(walls.steps) * static_cast<double>(world.flow->grid().cell_count());
      j["geometry"] = {
          {"wall_s", wall_s[0]},
          {"share", wall_s[0] / all_s},
          {"closest_points_s", wall_s[1]},
          {"exchange_s", wall_s[2]},
          {"cut_cells_per_cell", cells_done > 0 ? static_cast<double>(counts[4]) / cells_done : 0},
          {"moving_cut_cells", counts[10]},
          {"mixed_divided_cells", counts[11]},
          {"us_per_moving_cut_cell", counts[10] > 0 ? nlohmann::json(1e6 * wall_s[0] / static_cast<double>(counts[10]))
                                                    : nlohmann::json(nullptr)}};
    }
    if (world.flow && counts[7] > 0) {
      // Share of the work of the sweeps, and how much faster they are for it. Since the program started, as timings.
      double const share = static_cast<double>(counts[8]) / static_cast<double>(counts[7]);
      j["sleep"] = {{"block_sweeps", counts[5]},
                    {"block_sweeps_skipped", counts[6]},
                    {"share", share},
                    {"gain", number_or_null(1 / (1 - share))}};
    }
    if (world.solid && world.solid->may_sleep()) {
      auto const all = static_cast<double>(counts[3] + counts[9]);
      j["sleep"]["solid"] = {{"link_updates", counts[3]},
                             {"link_updates_skipped", counts[9]},
                             {"share", all > 0 ? static_cast<double>(counts[9]) / all : 0}};
    }
    if (world.solid && world.solid->levels())
      j["multirate"] = {{"levels", world.solid->levels()->top + 1},
                        {"link_updates_per_step", world.solid->levels()->link_updates()},
                        {"gain", world.solid->levels()->gain()}};
    nlohmann::ordered_json effects;
    for (std::string const& name : catalogue()) {
      auto const& known = world.plan.effects();
      auto const at = std::find_if(known.begin(), known.end(), [&](auto const& e) { return e.name == name; });
      bool const active = at != known.end();
      auto const i = static_cast<std::size_t>(at - known.begin());
      effects[name] = {
          {"active", active}, {"wall_s", active ? effect_wall[i] : 0}, {"bytes", active ? effect_bytes[i] : 0}};
    }
    j["effects"] = effects;
    j["memory_peak_bytes_per_rank"] = memory;
    j["partition"] = {{"imbalance_cells", imbalance(cells)},
                      {"imbalance_measured", imbalance(busy)},
                      {"edge_cut", world.partition.edge_cut}};
    if (StageLedger const* const stages = simulation.stages())
      j["stages"] = stage_figures(*stages, simulation.ledger());
    if (world.gauges) j["gauges"] = gauge_figures(*world.gauges);
    if (world.solid_gauges) j["solid_gauges"] = gauge_figures(*world.solid_gauges);
    j["state_digest"] = digest;
    text = j.dump(2) + "\n";
  }
  parallel::write_text_atomically(comm, directory + "/summary.json", text);
}

}  // namespace brisance::drivers
