#include "drivers/assembly.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/base/errors.hpp"
#include "coupling/cut_cells/cell_geometry.hpp"
#include "fluid/boundary/boundary_config.hpp"
#include "fluid/cell_fields.hpp"
#include "fluid/initial_state.hpp"

namespace brisance::drivers {

std::vector<std::string> const& catalogue() {
  static std::vector<std::string> const names{
      "fluid.euler",        "fluid.viscosity",     "fluid.gravity",      "solid.motion",        "solid.links",
      "solid.gravity",      "solid.supports",      "solid.pressure",     "solid.traction",      "solid.blast",
      "solid.point_force",  "solid.moment_tensor", "solid.absorbing",    "solid.plasticity",    "solid.contact",
      "solid.damping",      "solid.fracture",      "coupling.cut_cells", "coupling.body_loads", "output.gauges",
      "output.solid_gauges"};
  return names;
}

/// Runs of cells and groups of small cells do not reach through periodic sides.
void require_clear_periodic_sides(Scene const& scene, fluid::Grid const& grid, solid::Mesh const& mesh,
                                  solid::Surface const& surface) {
  Index const reach = fluid::ghost_depth(scene.fluid->order()) + 3;
  for (solid::Element const& t : surface.elements())
    for (std::size_t a = 0; a < static_cast<std::size_t>(grid.dimension); ++a) {
      coupling::CellIndex const c = coupling::cell_of(grid, surface.reference(t.vertex[a], mesh));
      for (std::size_t d = 0; d < static_cast<std::size_t>(grid.dimension); ++d)
        if (grid.periodic[d] && (c[d] < reach || c[d] >= grid.cells[d] - reach))
          scene_error(scene.fluid->at,
                      "solid.body \"" + mesh.bodies[static_cast<std::size_t>(mesh.particle(t.particle).body)].name +
                          "\" is closer than " + std::to_string(reach) + " cells to a side that is periodic along " +
                          "xyz"[d] + ": move it away, or make the side another");
    }
}

/// Gauges stand in the gas: on the surface of a body, but not in it.
void require_gauges_in_the_gas(Scene const& scene, fluid::Grid const& grid, solid::Mesh const& mesh) {
  for (fluid::GaugeConfig const& gauge : scene.output.gauge)
    for (GlobalId p = 0; p < mesh.size(); ++p) {
      Real depth = std::numeric_limits<Real>::infinity();
      for (solid::FaceGeometry const& face : mesh.shape(p).faces)
        if (!solid::is_side_of_slab(face, grid.dimension))
          depth = min(depth, dot(face.normal, face.centroid + mesh.particle(p).centre - gauge.position));
      if (depth > 1e-9 * coupling::smallest_spacing(grid))
        scene_error(gauge.at, "output.gauge \"" + gauge.name + "\" stands inside solid.body \"" +
                                  mesh.bodies[static_cast<std::size_t>(mesh.particle(p).body)].name +
                                  "\": move it into the gas");
    }
}

parallel::Partition assign_owners(Scene const& scene, fluid::Grid const* grid, solid::Mesh const* mesh,
                                  std::vector<std::int64_t> const& wall_work_of_block, int ranks) {
  std::int64_t const blocks = grid ? grid->block_count() : 0, particles = mesh ? mesh->size() : 0;
  std::int64_t const units = grid ? blocks : particles;
  require(ranks <= units, Failure::scene,
          (scene.fluid ? scene.fluid->at.text() : scene.solid->at.text()) + ": " + std::to_string(ranks) +
              " ranks, but the scene has only " + std::to_string(units) + (grid ? " fluid block" : " particle") +
              (units == 1 ? "" : "s") + ": every rank needs one. Use at most " + std::to_string(units) + " ranks" +
              (grid ? ", or set a smaller fluid.block." : "."));
  struct Edge {
    std::int64_t a, b, weight;
  };
  std::vector<Edge> edges;
  parallel::Graph graph;
  graph.constraints = grid && mesh ? 2 : 1;
  auto const nc = static_cast<std::size_t>(graph.constraints);
  graph.vertex_weight.assign(static_cast<std::size_t>(blocks + particles) * nc, 0);
  Index const ghost = scene.fluid ? fluid::ghost_depth(scene.fluid->order()) : 0;
  for (Index b = 0; b < blocks; ++b) {
    auto const p = grid->block_position(b);
    std::array<std::int64_t, 3> size{};
    for (std::size_t d = 0; d < 3; ++d)
      size[d] = grid->cuts[d][static_cast<std::size_t>(p[d]) + 1] - grid->cuts[d][static_cast<std::size_t>(p[d])];
    std::int64_t const cells = size[0] * size[1] * size[2];
    std::int64_t ghosts = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(grid->dimension); ++d) {
      ghosts += 2 * ghost * cells / size[d];
      if (p[d] + 1 >= grid->blocks_along(static_cast<int>(d)) && !grid->periodic[d]) continue;
      auto n = p;
      n[d] = (p[d] + 1) % grid->blocks_along(static_cast<int>(d));
      if (grid->block_id(n) != b) edges.push_back({b, grid->block_id(n), 40 * 2 * ghost * cells / size[d]});
    }
    std::int64_t const walls = wall_work_of_block.empty() ? 0 : wall_work_of_block[static_cast<std::size_t>(b)];
    graph.vertex_weight[static_cast<std::size_t>(b) * nc] = cells + ghosts + walls;  // coupling 8.4
  }
  if (mesh) {
    for (solid::Link const& link : mesh->links)
      if (link.j >= 0) edges.push_back({blocks + link.i, blocks + link.j, 128});
    for (std::int64_t p = 0; p < particles; ++p) {
      auto const free_faces = static_cast<std::int64_t>(mesh->free_faces_of(p).size());
      graph.vertex_weight[static_cast<std::size_t>(blocks + p) * nc + nc - 1] =
          1 + static_cast<std::int64_t>(mesh->links_of(p).size()) + 5 * 2 * free_faces;
      if (!grid || free_faces == 0) continue;
      fluid::CellIndex const c = coupling::into_domain(*grid, coupling::cell_of(*grid, mesh->particle(p).centre));
      edges.push_back({blocks + p, grid->block_of(c), 400 * free_faces});
    }
  }
  for (std::size_t e = 0, n = edges.size(); e < n; ++e) edges.push_back({edges[e].b, edges[e].a, edges[e].weight});
  std::sort(edges.begin(), edges.end(),
            [](Edge const& x, Edge const& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  graph.first.assign(static_cast<std::size_t>(blocks + particles) + 1, 0);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    bool const again = e > 0 && edges[e].a == edges[e - 1].a && edges[e].b == edges[e - 1].b;
    if (again) {
      graph.edge_weight.back() += edges[e].weight;
      continue;
    }
    graph.neighbour.push_back(edges[e].b);
    graph.edge_weight.push_back(edges[e].weight);
    ++graph.first[static_cast<std::size_t>(edges[e].a) + 1];
  }
  for (std::size_t v = 1; v < graph.first.size(); ++v) graph.first[v] += graph.first[v - 1];
  return parallel::partition(graph, ranks, units);
}

namespace {

/// Every rank reads and cuts the bodies for itself: a mesh file that differs between machines would end in nonsense.
void require_same_mesh(solid::Mesh const& mesh, parallel::Comm& comm) {
  std::uint64_t hash = 0;
  for (solid::Particle const& p : mesh.particles)
    for (int d = 0; d < 3; ++d) hash = 0x100000001B3u * (hash ^ std::bit_cast<std::uint64_t>(p.centre[d]));
  std::array<Real, 4> ends{};
  for (std::size_t half = 0; half < 2; ++half) {
    ends[2 * half] = static_cast<Real>(hash >> (32 * half) & 0xFFFFFFFFu);
    ends[2 * half + 1] = -ends[2 * half];
  }
  comm.min(std::span(ends));
  require(ends[0] == -ends[1] && ends[2] == -ends[3], Failure::system,
          "the ranks built different bodies: do all machines see the same mesh files and run the same program?");
}

}  // namespace

std::unique_ptr<World> assemble(Scene const& scene, parallel::Comm& comm) {
  auto world = std::make_unique<World>();
  World& w = *world;
  w.comm = &comm;
  if (scene.output.ledger == "stage") w.plan.charge_stages();
  std::optional<fluid::Grid> grid;
  if (scene.fluid) {
    fluid::check(*scene.fluid);
    grid = fluid::make_grid(*scene.fluid);
    fluid::check_walls(*scene.fluid, *grid, scene.end_time);
    w.dimension = grid->dimension;
    fluid::check(scene.output.gauge, *scene.fluid, *grid, scene.end_time);
    fluid::check_cell_fields(scene.output.fields, *scene.fluid, grid->dimension, scene.output.at);
  }
  bool const coupled = scene.coupling && scene.coupling->cut_cells;
  require(!coupled || w.dimension >= 2, Failure::scene, "coupling.cut_cells needs a fluid in 2 or 3 dimensions");
  if (coupled && !scene.fluid->euler)
    scene_error(scene.fluid->at, "coupling.cut_cells needs the effect fluid.euler: add euler = {} to [fluid]");
  if (scene.fluid && w.dimension > 1 && scene.fluid->splitting() == fluid::Splitting::merged) {
    char const* const other = coupled                  ? "coupling.cut_cells"
                              : scene.fluid->viscosity ? "fluid.viscosity"
                              : scene.fluid->gravity   ? "fluid.gravity"
                                                       : nullptr;
    if (other)
      scene_error(scene.fluid->euler->at, std::string("fluid.euler.splitting = \"merged\" has no whole steps, which ") +
                                              other + " acts between: take \"pair\" with it");
  }
  if (coupled && scene.fluid->products)
    scene_error(scene.fluid->products->at,
                "fluid.products: cut cells do not carry products yet; use charges of model \"balloon\" beside solids.");
  if (scene.solid) {
    w.mesh = std::make_unique<solid::Mesh>(solid::build_mesh(*scene.solid, w.dimension));
    require_same_mesh(*w.mesh, comm);
    w.surface = std::make_shared<solid::Surface>(*w.mesh);
  }
  if (coupled && w.mesh->has(solid::FarSide::Kind::shifted))
    scene_error(
        scene.solid->at,
        "coupling.cut_cells: a periodic body has no closed surface for the gas to meet. Model the whole body, or "
        "leave out the coupling");
  if (coupled && w.mesh->has(solid::FarSide::Kind::mirror))
    scene_error(
        scene.solid->at,
        "coupling.cut_cells: the gas would press on the faces that lie on a plane of symmetry, as on all others. "
        "Model the whole body, or leave out the coupling");
  if (coupled) require_clear_periodic_sides(scene, *grid, *w.mesh, *w.surface);
  if (coupled) require_gauges_in_the_gas(scene, *grid, *w.mesh);
  if (coupled) w.walls = survey_walls(*grid, *w.mesh, *w.surface);
  if (!w.walls.thin.empty()) w.plan.remark(w.walls.thin);
  w.partition = assign_owners(scene, grid ? &*grid : nullptr, w.mesh.get(), w.walls.work, comm.size());
  auto const blocks = static_cast<std::ptrdiff_t>(grid ? grid->block_count() : 0);
  auto const& owner = w.partition.owner;
  if (grid)
    w.flow = std::make_unique<fluid::Flow>(*scene.fluid, *grid, std::vector<int>(owner.begin(), owner.begin() + blocks),
                                           comm);
  if (w.mesh)
    w.solid = std::make_unique<solid::Solid>(
        *w.mesh, *scene.solid, std::vector<int>(owner.begin() + blocks, owner.end()), comm, w.dimension,
        coupled ? w.surface.get() : nullptr,
        scene.solid->breaks() ? solid::Solid::Opens::anywhere : solid::Solid::Opens::never);
  if (scene.fluid && scene.fluid->euler) w.euler = std::make_unique<fluid::Euler>(*scene.fluid->euler, *w.flow);
  if (scene.fluid && scene.fluid->viscosity) w.viscosity = std::make_unique<fluid::Viscosity>(*scene.fluid, *w.flow);
  if (scene.fluid && scene.fluid->gravity) w.gravity = std::make_unique<fluid::Gravity>(*scene.fluid->gravity, *w.flow);
  if (w.solid) w.dynamics = std::make_unique<solid::Dynamics>(*scene.solid, *w.solid);
  if (w.solid) w.solid_effects = solid::make_effects(*scene.solid, *w.solid, comm);
  if (coupled) {
    fluid::GasState const& air = scene.fluid->ambient;
    w.cut_cells = std::make_unique<coupling::CutCells>(
        *scene.coupling->cut_cells, scene.coupling->time_coupling(), *w.flow, *w.solid, w.surface,
        w.flow->gas().conserved(air.density, air.velocity, air.pressure), comm);
  }
  if (w.cut_cells) w.cut_cells->watch_light_solids(scene.fluid->euler->cfl, scene.coupling->light_solids == "limit");
  if (w.euler && w.cut_cells) w.euler->set_fluid_volume(w.cut_cells->fluid_volumes());
  if (w.viscosity && w.cut_cells) {
    w.viscosity->set_fluid_volume(w.cut_cells->fluid_volumes());
    w.viscosity->set_walls(&w.cut_cells->add_viscosity(w.viscosity->transport()));
  }
  if (w.gravity && w.cut_cells) {
    w.gravity->set_fluid_volume(w.cut_cells->fluid_volumes());
    w.cut_cells->expect_sources();
  }
  if (coupled && scene.coupling->cut_cells->wall && !scene.fluid->viscosity)
    scene_error(
        scene.coupling->cut_cells->wall->at,
        "coupling.cut_cells.wall needs the effect fluid.viscosity: without it the gas slips along the bodies. Add "
        "viscosity = {} to [fluid], or leave the wall out");

  if (w.euler) w.euler->join(w.plan);
  if (w.viscosity) w.viscosity->join(w.plan);
  if (w.gravity) w.gravity->join(w.plan);
  if (w.dynamics) w.dynamics->join(w.plan);
  for (auto const& effect : w.solid_effects) effect->join(w.plan);
  if (w.cut_cells) w.cut_cells->join(w.plan);
  if (scene.coupling && scene.coupling->body_loads) {
    if (!coupled)
      scene_error(scene.coupling->body_loads->at,
                  "coupling.body_loads needs coupling.cut_cells: nothing else lets a fluid act on bodies. Add it");
    w.body_loads = std::make_unique<coupling::BodyLoads>(*w.solid, comm);
    w.body_loads->join(w.plan);
  }
  if (w.solid) solid::require_multirate_support(*scene.solid, w.plan);
  if (!scene.output.gauge.empty()) {
    w.gauges = std::make_unique<fluid::Gauges>(scene.output.gauge, *scene.fluid, *w.flow, fluid_volumes(w));
    w.sampled_files.push_back(w.gauges.get());
    w.gauges->join(w.plan);
  }
  if (!scene.output.solid_gauge.empty()) {
    std::vector<std::string> taken;
    for (fluid::GaugeConfig const& gauge : scene.output.gauge) taken.push_back(gauge.name);
    solid::check(scene.output.solid_gauge, taken, *w.mesh, scene.end_time);
    w.solid_gauges = std::make_unique<solid::SolidGauges>(scene.output.solid_gauge, *w.solid, comm);
    w.sampled_files.push_back(w.solid_gauges.get());
    w.solid_gauges->join(w.plan);
  }
  TimeControl control{scene.end_time, w.flow ? fluid::steps_per_pair(w.dimension) : 1,
                      scene.output.interval.value_or(0)};
  if (scene.coupling) {
    control.coupling = scene.coupling->time_coupling();
    control.least_sub_steps = scene.coupling->sub_steps.value_or(1);
    control.most_sub_steps = scene.coupling->largest_sub_steps();
  }
  w.simulation = std::make_unique<Simulation>(w.plan, comm, control);
  if (StageLedger const* const stages = w.simulation->stages())
    w.plan.finding([&w, stages] {
      std::string const text = open_accounts(*stages, w.simulation->ledger().scales());
      return w.comm->rank() == 0 ? text : std::string();
    });
  return world;
}

fluid::FluidVolume fluid_volumes(World const& world) {
  return world.cut_cells ? world.cut_cells->fluid_volumes() : fluid::FluidVolume{};
}

void start_effects(World& world) {
  for (auto const& effect : world.solid_effects) effect->start();
}

void start(World& w, Scene const& scene) {
  if (w.cut_cells) w.cut_cells->cut_initial_geometry();
  if (w.flow) fluid::fill(*w.flow, *scene.fluid, fluid_volumes(w));
  if (w.cut_cells) w.cut_cells->begin();
  if (w.dynamics) w.dynamics->start();
  start_effects(w);
  w.simulation->audit();
}

}  // namespace brisance::drivers
