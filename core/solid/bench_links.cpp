#include "core/solid/bench_links.hpp"

#include <ctime>

#include <algorithm>
#include <cmath>

#include "core/solid/solid.hpp"

namespace brisance::solid {
namespace {

// Counted on the text of link_law.hpp and solid_step.cpp; the turn of a particle taken with three sweeps.
constexpr Real flops_per_link = 144 + 287, flops_per_particle = 386;
// Links are read by both passes; of a particle, the columns that each pass reads or writes.
constexpr Real bytes_per_link = 2 * sizeof(LinkBlock) / lanes, bytes_per_particle = 1084;

Real now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<Real>(t.tv_sec) + 1e-9 * static_cast<Real>(t.tv_nsec);
}

SolidConfig block(Index side) {
  SolidConfig config;
  config.material["unit"] = {1, 1, 0.3, {}};
  config.links.emplace();
  BodyConfig body;
  body.material = "unit";
  body.low = Vec3{};
  body.high = Vec3{1.0 * side, 1.0 * side, 1.0 * side};
  body.cells = {side, side, side};
  config.body.push_back(body);
  return config;
}

}  // namespace

LinkRate bench_links(Index side) {
  SolidConfig const config = block(side);
  Mesh const mesh = build_mesh(config, 3);
  auto const comm = parallel::serial();
  Solid solid(mesh, config, std::vector<int>(mesh.particles.size(), 0), *comm, 3);
  for (std::size_t p = 0; p < solid.motion().size(); ++p) {
    Vec3 const x = solid.pose()[p].x;
    solid.motion()[p].v = {1e-3 * std::sin(3 * x.x / side), 1e-3 * std::cos(2 * x.y / side), 0};
    solid.motion()[p].spin = {1e-5 * x.x / side, 0, 0};
  }
  int const steps = std::max(1, 400000 / (side * side * side)), repetitions = 7;
  Real best = 1e300;
  for (int r = 0; r < repetitions; ++r) {
    Real const start = now();
    for (int s = 0; s < steps; ++s) solid.step(0.3);
    best = min(best, now() - start);
  }
  Real const links = static_cast<Real>(solid.links()), particles = static_cast<Real>(solid.owned()) / links;
  return {links * steps / best, bytes_per_link + particles * bytes_per_particle,
          flops_per_link + particles * flops_per_particle};
}

}  // namespace brisance::solid
