#include "core/solid/contact/bench_contact.hpp"

#include <ctime>

#include "core/solid/contact/contact.hpp"

namespace brisance::solid {
namespace {

Real now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<Real>(t.tv_sec) + 1e-9 * static_cast<Real>(t.tv_nsec);
}

BodyConfig layer(Vec3 const& low, Index side) {
  BodyConfig body;
  body.material = "unit";
  body.low = low;
  body.high = low + Vec3{1.0 * side, 1.0 * side, 1};
  body.cells = {side, side, 1};
  return body;
}

}  // namespace

Real bench_contact(Index side) {
  SolidConfig config;
  config.material["unit"] = {1, 1, 0.3, {}};
  config.links.emplace();
  config.contact.emplace();
  config.contact->friction = 0.3;
  config.contact->restitution = 0.5;
  config.body = {layer({0, 0, 0}, side), layer({0.5, 0.5, 1}, side)};
  Mesh const mesh = build_mesh(config, 3);
  auto const comm = parallel::serial();
  Solid solid(mesh, config, std::vector<int>(mesh.particles.size(), 0), *comm, 3);
  for (Index p = 0; p < solid.owned(); ++p)
    if (mesh.particle(solid.id(p)).body == 1) solid.pose()[static_cast<std::size_t>(p)].x.z -= 1e-3;
  Contact contact(config, solid, *comm);
  contact.start();
  Clock clock;
  clock.dt = 0.1;
  Real best = 1e300;
  for (int repetition = 0; repetition < 7; ++repetition) {
    Real const start = now();
    for (int step = 0; step < 10; ++step, ++clock.step) contact.apply(clock);
    best = min(best, (now() - start) / 10);
  }
  return static_cast<Real>(contact.overlapping_pairs()) / best;
}

}  // namespace brisance::solid
