#include "core/solid/fracture/census.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Sums over the particles of a fragment, exact in any order.
struct Sums {
  enum Item { mass, volume, moment, momentum = moment + 3, kinetic = momentum + 3, elastic, count };
  std::int64_t particles = 0;
  Real separated = Fragments::never;
  std::array<parallel::ExactSum, count> sums;

  void add(Item item, Vec3 const& v) {
    for (int d = 0; d < 3; ++d) sums[static_cast<std::size_t>(item + d)].add(v[d]);
  }
  void add(Sums const& other) {
    particles += other.particles;
    separated = max(separated, other.separated);
    for (std::size_t s = 0; s < count; ++s) sums[s].add(other.sums[s]);
  }
  Vec3 vector(std::size_t item) const { return {sums[item].value(), sums[item + 1].value(), sums[item + 2].value()}; }
};

FragmentFigures figures(GlobalId label, Mesh const& mesh, Sums const& s) {
  Real const mass = s.sums[Sums::mass].value();
  return {label,
          mesh.particle(label).body,
          s.particles,
          mass,
          s.sums[Sums::volume].value(),
          s.vector(Sums::moment) / mass,
          s.vector(Sums::momentum) / mass,
          s.sums[Sums::kinetic].value(),
          s.sums[Sums::elastic].value(),
          s.separated};
}

void add_particle(Sums& to, Solid const& solid, Index p, Real separated) {
  Mesh const& mesh = solid.mesh();
  GlobalId const id = solid.id(p);
  Real const mass = mesh.particle(id).mass;
  ++to.particles;
  to.separated = max(to.separated, separated);
  to.sums[Sums::mass].add(mass);
  to.sums[Sums::volume].add(mesh.shape(id).volume);
  to.add(Sums::moment, mass * solid.pose()[at(p)].x);
  to.add(Sums::momentum, mass * solid.motion()[at(p)].v);
  to.sums[Sums::kinetic].add(solid.kinetic_energy(p));
  to.sums[Sums::elastic].add(solid.volumetric_energy(p));
}

}  // namespace

std::vector<FragmentFigures> take_census(Solid const& solid, Fragments const& fragments, parallel::Comm& comm) {
  auto const label = fragments.label();
  Index const owned = solid.owned();
  std::vector<Index> order(at(owned));
  for (Index p = 0; p < owned; ++p) order[at(p)] = p;
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return label[at(a)] < label[at(b)]; });
  // Links of each owned particle, by their first end.
  LinkStore const& links = solid.link_store();
  std::vector<std::size_t> first(at(owned) + 1, 0), link_of;
  for (std::size_t k = 0; k < links.count(); ++k)
    if (links.end_i(k) < owned) ++first[at(links.end_i(k)) + 1];
  for (std::size_t p = 1; p < first.size(); ++p) first[p] += first[p - 1];
  link_of.resize(first.back());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::size_t k = 0; k < links.count(); ++k)
    if (links.end_i(k) < owned) link_of[next[at(links.end_i(k))]++] = k;

  std::vector<FragmentFigures> mine;
  std::map<int, parallel::Message> outgoing;
  for (std::size_t n = 0; n < order.size();) {
    GlobalId const of = label[at(order[n])];
    Sums sums;
    for (; n < order.size() && label[at(order[n])] == of; ++n) {
      Index const p = order[n];
      add_particle(sums, solid, p, fragments.separated()[at(p)]);
      for (std::size_t l = first[at(p)]; l < first[at(p) + 1]; ++l)
        sums.sums[Sums::elastic].add(solid.link_energy(link_of[l]));
    }
    auto const shared = fragments.shared();
    if (!std::binary_search(shared.begin(), shared.end(), of)) {
      mine.push_back(figures(of, solid.mesh(), sums));
      continue;
    }
    parallel::Message& m = outgoing[solid.owner(of)];
    m.rank = solid.owner(of);
    parallel::put(m.data, of);
    parallel::put(m.data, sums);
  }
  std::vector<parallel::Message> messages;
  for (auto& [rank, message] : outgoing) messages.push_back(std::move(message));
  std::map<GlobalId, Sums> parts;
  for (parallel::Message const& message : comm.deliver(std::move(messages)))
    for (std::span<std::byte const> in(message.data); !in.empty();) {
      auto const of = parallel::take<GlobalId>(in);
      parts[of].add(parallel::take<Sums>(in));
    }
  for (auto const& [of, sums] : parts) mine.push_back(figures(of, solid.mesh(), sums));

  parallel::Bytes bytes;
  for (FragmentFigures const& f : mine) parallel::put(bytes, f);
  std::vector<FragmentFigures> all;
  for (parallel::Bytes const& part : comm.gather(bytes, 0))
    for (std::span<std::byte const> in(part); !in.empty();) all.push_back(parallel::take<FragmentFigures>(in));
  std::sort(all.begin(), all.end(),
            [](FragmentFigures const& a, FragmentFigures const& b) { return a.label < b.label; });
  return all;
}

std::string census_header() {
  return "step,time,fragment,body,particles,mass,volume,x,y,z,velocity_x,velocity_y,velocity_z,kinetic_energy,"
         "elastic_energy,separation_time\n";
}

std::string census_row(FragmentFigures const& f, Mesh const& mesh, std::int64_t step, Real time) {
  std::string const separated = f.separated == Fragments::never ? "" : fmt::format("{:.17g}", f.separated);
  return fmt::format(
      "{},{:.17g},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{}\n", step,
      time, f.label, mesh.bodies[at(f.body)].name, f.particles, f.mass, f.volume, f.centre.x, f.centre.y, f.centre.z,
      f.velocity.x, f.velocity.y, f.velocity.z, f.kinetic, f.elastic, separated);
}

}  // namespace brisance::solid
