// brisance bench: what this machine does. Bandwidth and arithmetic first, then kernels and whole steps against them.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/solid/bench_links.hpp"
#include "core/solid/contact/bench_contact.hpp"
#include "coupling/cut_cells/bench.hpp"
#include "drivers/commands.hpp"
#include "fluid/bench_steps.hpp"
#include "fluid/diffusion/bench_viscous.hpp"
#include "fluid/flux/bench_sweep.hpp"

namespace brisance::drivers {
namespace {

using Row = fluid::BenchRow;
constexpr double not_counted = std::numeric_limits<double>::quiet_NaN();

/// A row that is measured when it is asked for.
struct Bench {
  std::string name;
  std::function<Row(fluid::MachineRoofs const&)> measure;
};

/// Scalar code that follows the geometry: neither its bytes nor its operations are the same from item to item.
Row geometry_row(std::string const& name, coupling::GeometryRate rate) {
  return {name, rate.items / rate.seconds, not_counted, not_counted, not_counted};
}

Row link_row(std::string const& name, Index side, fluid::MachineRoofs const& roofs) {
  solid::LinkRate const rate = solid::bench_links(side);
  double const flops = rate.items_per_s * rate.flops_per_item / roofs.flops_per_s;
  double const bytes = rate.items_per_s * rate.bytes_per_item / roofs.bytes_per_s;
  // In cache no bytes come from memory: the arithmetic is the limit.
  return {name, rate.items_per_s, rate.bytes_per_item, rate.flops_per_item, side == 10 ? flops : max(flops, bytes)};
}

std::vector<Bench> all_benches(parallel::Comm& comm) {
  std::vector<Bench> benches = {{"stream.triad", fluid::bench_triad},
                                {"arithmetic.multiply_add", fluid::bench_multiply_add}};
  for (int order = 1; order <= 11; order += 2)
    benches.push_back({fmt::format("fluid.kernel.3d.order{}", order),
                       [=](auto const& roofs) { return fluid::bench_sweep(order, 3, false, roofs); }});
  for (int order = 3; order <= 11; order += 2)
    benches.push_back({fmt::format("fluid.kernel.3d.smooth.order{}", order),
                       [=](auto const& roofs) { return fluid::bench_sweep(order, 3, true, roofs); }});
  auto const steps = [&](std::string const& name, int order, std::vector<int> const& cells) {
    benches.push_back(
        {name, [=, &comm](auto const& roofs) { return fluid::bench_steps(name, order, cells, comm, roofs); }});
  };
  for (int order = 1; order <= 11; order += 2) {
    steps(fmt::format("fluid.3d.order{}", order), order, {96, 96, 96});
    steps(fmt::format("fluid.2d.order{}", order), order, {941, 940});
    steps(fmt::format("fluid.1d.order{}", order), order, {96 * 96 * 96});
    steps(fmt::format("fluid.1d.order{}.short", order), order, {10000});
  }
  for (int dimension = 2; dimension <= 3; ++dimension)
    benches.push_back({fmt::format("fluid.kernel.{}d.viscous", dimension),
                       [=](auto const& roofs) { return fluid::bench_viscous(dimension, roofs); }});
  benches.push_back({"solid.links.cache", [](auto const& roofs) { return link_row("solid.links.cache", 10, roofs); }});
  benches.push_back(
      {"solid.links.memory", [](auto const& roofs) { return link_row("solid.links.memory", 96, roofs); }});
  benches.push_back({"solid.contact", [](auto const&) {
                       return Row{"solid.contact", solid::bench_contact(20), not_counted, not_counted, not_counted};
                     }});
  benches.push_back({"coupling.cut_cells",
                     [](auto const&) { return geometry_row("coupling.cut_cells", coupling::bench_cut_cells()); }});
  benches.push_back({"coupling.closest_points", [](auto const&) {
                       return geometry_row("coupling.closest_points", coupling::bench_closest_points());
                     }});
  benches.push_back({"coupling.projections",
                     [](auto const&) { return geometry_row("coupling.projections", coupling::bench_projections()); }});
  return benches;
}

/// The benches whose name begins with one of `names`; all when there are none.
std::vector<Bench> chosen_benches(std::vector<std::string> const& names, parallel::Comm& comm) {
  std::vector<Bench> all = all_benches(comm);
  if (names.empty()) return all;
  std::vector<std::string> known;
  for (Bench const& bench : all) known.push_back(bench.name);
  std::vector<Bench> chosen;
  for (std::string const& name : names) {
    std::size_t const before = chosen.size();
    for (Bench const& bench : all)
      if (bench.name.starts_with(name)) chosen.push_back(bench);
    require(chosen.size() > before, Failure::scene,
            "no bench row begins with " + name + "; the nearest is " + nearest(name, known) +
                " (rows: " + joined(known) + ")");
  }
  return chosen;
}

/// The mean over the ranks, all of which measure at the same time: what a core does while the others are busy too.
double mean(double value, parallel::Comm& comm) {
  parallel::Bytes mine;
  parallel::put(mine, value);
  double sum = 0;
  for (parallel::Bytes const& bytes : comm.all_gather(mine)) {
    std::span<std::byte const> in(bytes);
    sum += parallel::take<double>(in);
  }
  return sum / comm.size();
}

std::string cell(double value, char const* format) {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value);
}

void print_row(Row const& row) {
  fmt::print("{:<26}{:>14}{:>14}{:>12}{:>12}{:>10}\n", row.name, cell(row.items_per_s / 1e6, "{:.4g}"),
             cell(1e6 / row.items_per_s, "{:.4g}"), cell(row.bytes_per_item, "{:.0f}"),
             cell(row.flops_per_item, "{:.0f}"), cell(100 * row.limit_share, "{:.1f} %"));
  std::fflush(stdout);
}

void write_json(std::vector<Row> const& rows, std::string const& path, parallel::Comm& comm) {
  std::int64_t failed = 0;
  if (comm.rank() == 0) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (Row const& row : rows)  // a quantity that is not counted becomes null
      list.push_back({{"name", row.name},
                      {"items_per_s", row.items_per_s},
                      {"bytes_per_item", row.bytes_per_item},
                      {"flops_per_item", row.flops_per_item},
                      {"limit_share", row.limit_share}});
    std::ofstream file(path);
    file << list.dump(2) << "\n";
    file.close();
    failed = file.fail();
  }
  comm.sum(std::span(&failed, 1));
  require(failed == 0, Failure::system, path + ": cannot be written");
}

}  // namespace

int run_bench(BenchOptions const& options, parallel::Comm& comm) {
  std::vector<Bench> const benches = chosen_benches(options.names, comm);
  if (comm.rank() == 0)
    fmt::print("{:<26}{:>14}{:>14}{:>12}{:>12}{:>10}\n", fmt::format("{} rank(s), per core", comm.size()), "Mitems/s",
               "us/item", "bytes/item", "flops/item", "of limit");
  comm.barrier();
  fluid::MachineRoofs const roofs = fluid::measure_roofs();
  std::vector<Row> rows;
  for (Bench const& bench : benches) {
    comm.barrier();
    Row row = bench.measure(roofs);
    row.items_per_s = mean(row.items_per_s, comm);
    row.limit_share = mean(row.limit_share, comm);
    if (comm.rank() == 0) print_row(row);
    rows.push_back(row);
  }
  if (!options.json.empty()) write_json(rows, options.json, comm);
  return 0;
}

}  // namespace brisance::drivers
