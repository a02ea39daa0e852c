// brisance check: validates a scene and says what a run would do, hold and cost; runs nothing.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/solid/loads/blast_report.hpp"
#include "core/solid/meshes/quality.hpp"
#include "drivers/assembly.hpp"
#include "drivers/commands.hpp"
#include "drivers/log.hpp"
#include "fluid/charges.hpp"
#include "fluid/flux/sweep.hpp"

namespace brisance::drivers {

namespace {

struct FluidStep {
  Real dt = std::numeric_limits<Real>::infinity();
  std::string where = "ambient";
};

/// Acoustic step of the initial states; a run adds the slow start and what the flow becomes.
FluidStep initial_acoustic_step(fluid::FlowConfig const& flow, fluid::Grid const& grid, fluid::Gas const& gas,
                                std::vector<fluid::ChargeReport> const& charges) {
  FluidStep best;
  if (!flow.euler) return best;
  auto const consider = [&](std::string const& where, Real density, Real pressure, Vec3 const& velocity) {
    if (!(density > 0)) return;
    Real const c = gas.sound_speed(gas.conserved(density, velocity, pressure));
    for (int d = 0; d < grid.dimension; ++d) {
      Real const dt = flow.euler->cfl * grid.spacing[d] / (std::abs(velocity[d]) + c);
      if (dt < best.dt) best = {dt, where};
    }
  };
  consider("fluid.ambient", flow.ambient.density, flow.ambient.pressure, flow.ambient.velocity);
  for (std::size_t r = 0; r < flow.region.size(); ++r)
    consider("fluid.region." + std::to_string(r), flow.region[r].density, flow.region[r].pressure,
             flow.region[r].velocity);
  for (fluid::ChargeReport const& charge : charges)
    for (int d = 0; d < grid.dimension; ++d)
      if (Real const dt = flow.euler->cfl * grid.spacing[d] / charge.sound_speed; dt < best.dt)
        best = {dt, charge.name};
  return best;
}

/// Limit of the viscous terms for the initial states; a run sub-cycles before it shortens the step.
Real initial_viscous_step(fluid::FlowConfig const& flow, fluid::Grid const& grid) {
  Real largest = 0;
  if (!flow.viscosity) return std::numeric_limits<Real>::infinity();
  fluid::Transport const transport(*flow.viscosity, fluid::make_gas(flow));
  auto const consider = [&](Real density, Real pressure) {
    if (density > 0)
      largest = max(largest, transport.viscosity(transport.gas.temperature(density, pressure)) / density);
  };
  consider(flow.ambient.density, flow.ambient.pressure);
  for (fluid::RegionConfig const& r : flow.region) consider(r.density, r.pressure);
  return fluid::viscous_time_step(*flow.viscosity, transport, grid, largest);
}

/// Cell-steps per second of this machine, measured on a small box in a few milliseconds.
Real measured_rate(fluid::FlowConfig const& config, fluid::Grid const& grid) {
  fluid::Grid small = grid;
  for (std::size_t d = 0; d < 3; ++d)
    small.cells[d] = d < static_cast<std::size_t>(grid.dimension) ? (grid.dimension == 3   ? 32
                                                                     : grid.dimension == 2 ? 64
                                                                                           : 512)
                                                                  : 1;
  small.periodic = {true, true, true};
  for (std::size_t d = static_cast<std::size_t>(grid.dimension); d < 3; ++d) small.periodic[d] = false;
  fluid::divide(small, 512, fluid::ghost_depth(config.order()));
  fluid::FlowConfig plain = config;
  plain.sleep = false;  // it is the awake rate that is asked for
  plain.region.clear();
  plain.charge.clear();
  auto const alone = parallel::serial();
  fluid::Flow flow(plain, small, std::vector<int>(static_cast<std::size_t>(small.block_count()), 0), *alone);
  Real const dt = 1e-9;
  using Timer = std::chrono::steady_clock;
  Real best = 0;
  for (int repeat = 0; repeat < 4; ++repeat) {
    auto const begin = Timer::now();
    for (int d = 0; d < grid.dimension; ++d) flow.sweep(d, dt);
    Real const seconds = std::chrono::duration<Real>(Timer::now() - begin).count();
    best = max(best, static_cast<Real>(small.cell_count()) / seconds);
  }
  return best;
}

std::string human_time(Real seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

nlohmann::ordered_json mesh_report(solid::MeshQuality const& q, solid::Mesh const& mesh) {
  nlohmann::ordered_json j = {{"body", mesh.bodies[static_cast<std::size_t>(q.body)].name},
                              {"parts", q.parts},
                              {"volume_deviation", q.volume},
                              {"worst_angle_degrees", q.angle.value},
                              {"face_offset", q.offset},
                              {"worst_aspect_ratio", q.aspect.value},
                              {"single_layer_share", q.single_layer},
                              {"stairs", q.stairs}};
  if (q.moduli)
    j["effective"] = {{"poisson_ratio", q.poisson_ratio},       {"patch_particles", q.patch},
                      {"young_deviation", q.moduli->young},     {"shear_deviation", q.moduli->shear},
                      {"poisson_deviation", q.moduli->poisson}, {"scatter", q.moduli->scatter}};
  j["warnings"] = solid::warnings(q, mesh);
  return j;
}

std::string why_off(std::string const& effect, Scene const& scene) {
  std::string const domain = effect.substr(0, effect.find('.'));
  bool const open = domain == "fluid"    ? scene.fluid.has_value()
                    : domain == "solid"  ? scene.solid.has_value()
                    : domain == "output" ? true
                                         : scene.coupling.has_value();
  if (open && effect == "solid.supports") return "no support moves by a history or turns";
  return open ? effect.substr(effect.find('.') + 1) + " is not in [" + domain + "]" : "no [" + domain + "]";
}

}  // namespace

int check_scene(CheckOptions const& options, parallel::Comm& comm) {
  start_log(comm, true);
  LoadedScene const loaded = load_scene(options.scene, options.overrides, comm);
  Scene const& scene = loaded.scene;
  auto const world = assemble(scene, comm);  // validates bodies, geometry and ownership as a run does
  fluid::Grid const* grid = world->flow ? &world->flow->grid() : nullptr;
  parallel::Partition const partition = assign_owners(scene, grid, world->mesh.get(), world->walls.work, options.ranks);

  GlobalId const cells = grid ? grid->cell_count() : 0;
  std::int64_t cut = 0;
  for (Index const n : world->walls.cells) cut += n;
  std::int64_t const particles = world->mesh ? world->mesh->size() : 0;
  auto const links = static_cast<std::int64_t>(world->mesh ? world->mesh->links.size() : 0);
  std::vector<fluid::ChargeReport> charges;
  if (scene.fluid && !scene.fluid->charge.empty()) {
    if (world->cut_cells) world->cut_cells->cut_initial_geometry();  // charges fill what bodies leave to the gas
    charges = fluid::measure_charges(*world->flow, *scene.fluid, fluid_volumes(*world));
  }
  FluidStep const acoustic =
      scene.fluid ? initial_acoustic_step(*scene.fluid, *grid, world->flow->gas(), charges) : FluidStep{};
  std::vector<Real> links_dt{world->solid ? world->solid->stable_step() : std::numeric_limits<Real>::infinity()};
  comm.min(std::span(links_dt));
  if (scene.coupling) links_dt[0] *= scene.coupling->largest_sub_steps();
  Real dt = min(acoustic.dt, links_dt[0]);
  std::string limited_by = acoustic.dt <= links_dt[0] ? "fluid.acoustic (" + acoustic.where + ")" : "solid.links";
  if (scene.fluid && scene.fluid->viscosity) {
    Real const stable = initial_viscous_step(*scene.fluid, *grid);
    Real const viscous = world->cut_cells ? fluid::share_at_walls * stable
                                          : fluid::sub_cycled_limit(*scene.fluid->viscosity, stable, dt);
    if (viscous < dt) dt = viscous, limited_by = "fluid.viscous";
  }
  Real const steps = scene.end_time / dt;

  std::vector<Real> bytes(static_cast<std::size_t>(options.ranks), 30e6);  // the program, MPI and HDF5
  Index const ghost = scene.fluid ? fluid::ghost_depth(scene.fluid->order()) : 0;
  Index const blocks = grid ? grid->block_count() : 0;
  for (Index b = 0; b < blocks; ++b) {
    auto const p = grid->block_position(b);
    Real stored = 1, plain = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      Index const n = grid->cuts[d][static_cast<std::size_t>(p[d]) + 1] - grid->cuts[d][static_cast<std::size_t>(p[d])];
      plain *= n;
      stored *= d == 0 ? n + 16 : d < static_cast<std::size_t>(grid->dimension) ? n + 2 * ghost : 1;
    }
    Real need = (scene.fluid->products ? 112 : 80) * stored;  // five or seven doubles, and a copy for rejected pairs
    if (scene.fluid->viscosity && scene.fluid->viscosity->time == "strang") need += 32 * plain;
    if (!world->walls.cells.empty() && world->walls.cells[static_cast<std::size_t>(b)] > 0)
      need += (40 + 48.0 * grid->dimension) * plain + 4000.0 * world->walls.cells[static_cast<std::size_t>(b)];
    bytes[static_cast<std::size_t>(partition.owner[static_cast<std::size_t>(b)])] += need;
  }
  for (std::int64_t p = 0; p < particles; ++p)
    bytes[static_cast<std::size_t>(partition.owner[static_cast<std::size_t>(blocks + p)])] += 2500;
  Real const most = *std::max_element(bytes.begin(), bytes.end());

  Real const rate = scene.fluid && scene.fluid->euler ? measured_rate(*scene.fluid, *grid) : 0;
  Real const cut_cost = grid && grid->dimension == 3 ? 60e-6 : 5e-6;  // s per cut cell and step, from `brisance bench`
  Real per_step = (rate > 0 ? static_cast<Real>(cells) / rate : 0) + cut_cost * static_cast<Real>(cut) +
                  5e-8 * static_cast<Real>(links);
  Real const worst =
      partition.imbalance.empty() ? 1 : *std::max_element(partition.imbalance.begin(), partition.imbalance.end());
  Real const wall = steps * per_step / options.ranks * worst;

  if (comm.rank() != 0) return 0;
  std::vector<std::string> remarks = world->plan.remarks();
  if (world->cut_cells)
    if (std::string text = world->cut_cells->remark_on_weight(scene.fluid->ambient.density); !text.empty())
      remarks.push_back(std::move(text));
  bool const linked = world->solid && scene.solid->links;
  auto const quality = linked ? solid::measure_quality(*world->mesh) : std::vector<solid::MeshQuality>{};
  solid::StepLimit const step_limit = linked ? solid::describe_step_limit(*world->solid) : solid::StepLimit{};
  std::vector<std::string> on;
  for (Plan::EffectCost const& e : world->plan.effects()) on.push_back(e.name);
  auto const active = [&](std::string const& name) { return std::find(on.begin(), on.end(), name) != on.end(); };
  if (options.json) {
    nlohmann::ordered_json j;
    j["scene"] = options.scene;
    j["dimension"] = world->dimension;
    j["cells"] = cells;
    j["blocks"] = blocks;
    j["cut_cells"] = cut;
    j["particles"] = particles;
    j["links"] = links;
    for (std::string const& name : catalogue()) j["effects"][name] = active(name);
    for (fluid::ChargeReport const& c : charges)
      j["charges"].push_back({{"name", c.name},
                              {"mass", c.mass},
                              {"energy", c.energy},
                              {"tnt_mass_by_energy", c.tnt_mass},
                              {"radius", c.radius},
                              {"cells_across", c.cells_across},
                              {"density", c.density},
                              {"pressure", c.pressure}});
    if (!remarks.empty()) j["remarks"] = remarks;
    if (scene.fluid) j["options"]["fluid.sleep"] = world->flow->may_sleep();
    if (scene.solid) j["options"]["solid.sleep"] = world->solid->may_sleep();
    if (world->solid && world->solid->levels())
      j["multirate"] = {{"levels", world->solid->levels()->top + 1}, {"gain", world->solid->levels()->gain()}};
    for (solid::MeshQuality const& q : quality) j["meshes"].push_back(mesh_report(q, *world->mesh));
    if (!step_limit.text.empty())
      j["step_limit"] = {{"text", step_limit.text}, {"share_of_median", step_limit.share_of_median}};
    j["dt"] = {{"initial", dt}, {"limited_by", limited_by}};
    j["steps"] = std::ceil(steps);
    j["ranks"] = options.ranks;
    j["memory_bytes_per_rank"] = bytes;
    j["partition"] = {{"imbalance", partition.imbalance}, {"edge_cut", partition.edge_cut}};
    j["predicted_wall_s"] = wall;
    std::printf("%s\n", j.dump(2).c_str());
    return 0;
  }
  fmt::print("{}: the scene is good\n\neffects\n", options.scene);
  for (std::string const& name : catalogue())
    fmt::print("  {:<24} {}\n", name, active(name) ? "on" : "off: " + why_off(name, scene));
  fmt::print("\noptions\n");
  if (scene.fluid)
    fmt::print("  {:<24} {}\n", "fluid.sleep",
               world->flow->may_sleep() ? "on: uniform blocks are not swept; the predicted time counts all blocks"
               : scene.fluid->sleep     ? "off: products, viscosity or gravity act on all blocks"
                                        : "off: all blocks are swept");
  if (scene.solid)
    fmt::print("  {:<24} {}\n", "solid.sleep",
               world->solid->may_sleep() ? "on: parts that nothing has reached yet are skipped"
               : scene.solid->sleep
                   ? "off: gravity, multi-rate steps, moving walls, symmetry or periodic faces act on particles at rest"
                   : "off: all particles are stepped");
  if (world->solid && world->solid->levels())
    fmt::print("\nmulti-rate steps\n  {} levels, {:.2f} times fewer links computed than with one step for all\n",
               world->solid->levels()->top + 1, world->solid->levels()->gain());
  fmt::print("\nstages\n");
  for (std::size_t s = 0; s < static_cast<std::size_t>(Stage::count); ++s) {
    auto const& tasks = world->plan.tasks(static_cast<Stage>(s));
    if (tasks.empty()) continue;
    std::string line;
    for (Plan::Task const& t : tasks) line += (line.empty() ? "" : ", ") + world->plan.effects()[t.effect].name;
    fmt::print("  {:<24} {}\n", name(static_cast<Stage>(s)), line);
  }
  fmt::print("\nsize\n  {} cells in {} blocks, {} cut; {} particles, {} links\n", cells, blocks, cut, particles, links);
  fmt::print("  memory per rank: at most {:.0f} MB on {} ranks\n", most / 1e6, options.ranks);
  if (linked) fmt::print("\nmesh of the solid\n");
  for (solid::MeshQuality const& q : quality) {
    fmt::print("  {}: {}\n", world->mesh->bodies[static_cast<std::size_t>(q.body)].name,
               solid::describe(q, *world->mesh));
    for (std::string const& text : solid::warnings(q, *world->mesh)) fmt::print("  warning: {}\n", text);
  }
  if (!step_limit.text.empty()) fmt::print("  {}\n", step_limit.text);
  if (scene.solid && !scene.solid->blast.empty()) {
    fmt::print("\nblasts\n");
    for (std::string const& line : solid::describe_blasts(*scene.solid, *world->mesh)) fmt::print("  {}\n", line);
  }
  if (!charges.empty()) fmt::print("\ncharges\n");
  for (fluid::ChargeReport const& c : charges) {
    fmt::print("  {}\n", fluid::describe(c, world->dimension));
    if (std::string const text = fluid::warning(c); !text.empty()) fmt::print("  warning: {}\n", text);
  }
  if (!remarks.empty()) fmt::print("\nremarks\n");
  for (std::string const& text : remarks) fmt::print("  {}\n", text);
  fmt::print("\ntime step\n  {:.3g} s at the start, limited by {}; about {:.0f} steps to {:.3g} s\n", dt, limited_by,
             std::ceil(steps), scene.end_time);
  fmt::print("\npartition on {} ranks\n  imbalance (largest over mean):", options.ranks);
  for (Real const x : partition.imbalance) fmt::print(" {:.2f}", x);
  fmt::print("; edge cut {} bytes\n\npredicted wall time\n  {} (this machine's cores, {} ranks)\n", partition.edge_cut,
             human_time(wall), options.ranks);
  return 0;
}

}  // namespace brisance::drivers
