#include "coupling/body_loads/body_loads.hpp"

#include <fmt/format.h>

namespace brisance::coupling {

namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <class Sums>
void add_vector(Sums& to, std::size_t first, Vec3 const& v) {
  for (int d = 0; d < 3; ++d) to[first + static_cast<std::size_t>(d)].add(v[d]);
}

template <class Sums>
Vec3 vector_of(Sums const& from, std::size_t first) {
  return {from[first].value(), from[first + 1].value(), from[first + 2].value()};
}

/// A name between quotes, as tables of comma-separated values write it.
std::string quoted(std::string const& name) {
  std::string text = "\"";
  for (char const c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace

BodyLoads::BodyLoads(solid::Solid& solid, parallel::Comm& comm)
    : solid_(solid), comm_(comm), sums_(solid.mesh().bodies.size()) {}

void BodyLoads::add(Real dt) {
  solid::Solid const& s = solid_;
  for (Index l = 0; l < s.owned(); ++l) {
    solid::Wrench const& load = s.load()[at(l)];
    if (load.force == Vec3{} && load.torque == Vec3{}) continue;
    Sums& sums = sums_[at(s.mesh().particle(s.id(l)).body)];
    solid::HalfVelocity const& half = s.half_velocity()[at(l)];
    add_vector(sums, impulse, dt * load.force);
    add_vector(sums, angular_impulse, dt * (load.torque + cross(s.pose()[at(l)].x, load.force)));
    sums[energy].add(dt * (dot(load.force, half.v) + dot(load.torque, half.omega)));
  }
}

std::vector<BodyLoads::Row> BodyLoads::rows() {
  solid::Solid const& s = solid_;
  constexpr std::size_t columns = items + 6;
  std::vector<parallel::ExactSum> all(sums_.size() * columns);
  auto const body = [&](std::size_t b) { return std::span(all).subspan(b * columns, columns); };
  for (std::size_t b = 0; b < sums_.size(); ++b) std::copy(sums_[b].begin(), sums_[b].end(), body(b).begin());
  for (Index l = 0; l < s.owned(); ++l) {
    solid::Wrench const& load = s.load()[at(l)];
    auto const sums = body(at(s.mesh().particle(s.id(l)).body));
    add_vector(sums, items, load.force);
    add_vector(sums, items + 3, load.torque + cross(s.pose()[at(l)].x, load.force));
  }
  comm_.sum(std::span(all));
  std::vector<Row> rows;
  for (std::size_t b = 0; b < sums_.size(); ++b) {
    auto const sums = body(b);
    rows.push_back({vector_of(sums, items), vector_of(sums, items + 3), vector_of(sums, impulse),
                    vector_of(sums, angular_impulse), sums[energy].value()});
  }
  return rows;
}

std::string BodyLoads::table(Clock const& clock) {
  std::vector<Row> const all = rows();
  std::string text;
  if (comm_.rank() != 0) return text;
  for (std::size_t b = 0; b < all.size(); ++b) {
    text += fmt::format("{},{:.17g},{}", clock.step, clock.time, quoted(solid_.mesh().bodies[b].name));
    for (Vec3 const& v : {all[b].force, all[b].torque, all[b].impulse, all[b].angular_impulse})
      text += fmt::format(",{:.17g},{:.17g},{:.17g}", v.x, v.y, v.z);
    text += fmt::format(",{:.17g}\n", all[b].energy);
  }
  return text;
}

void BodyLoads::join(Plan& plan) {
  plan.effect("coupling.body_loads", [this] { return (sums_.size() + saved_.size()) * sizeof(Sums); });
  // After the kick: half-step velocities are those of the exchange with the fluid.
  plan.at(Stage::drift, [this](Clock const& c) { add(c.dt); });
  plan.table({"body_loads.csv",
              "step,time,body,force_x,force_y,force_z,torque_x,torque_y,torque_z,impulse_x,impulse_y,impulse_z,"
              "angular_impulse_x,angular_impulse_y,angular_impulse_z,energy\n",
              [this](Clock const& clock) { return table(clock); }});
  Plan::Keep keep;
  keep.save = [this] { saved_ = sums_; };
  keep.restore = [this] { sums_ = saved_; };
  keep.write = [this](parallel::ArchiveWriter& file) { write(file); };
  keep.read = [this](parallel::ArchiveReader& file) { read(file); };
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

void BodyLoads::write(parallel::ArchiveWriter& file) const {
  // The accumulators themselves, so that a restart adds to the same sums.
  std::vector<parallel::ExactSum> all;
  for (Sums const& sums : sums_) all.insert(all.end(), sums.begin(), sums.end());
  comm_.sum(std::span(all));
  std::vector<std::int64_t> limbs;
  auto const rows = static_cast<std::int64_t>(all.size());
  std::vector<parallel::Range> mine;
  if (comm_.rank() == 0 && rows > 0) {
    mine.push_back({0, rows});
    for (parallel::ExactSum& sum : all) limbs.insert(limbs.end(), sum.raw().begin(), sum.raw().end());
  }
  file.rows_int("coupling/body_loads", rows, parallel::ExactSum::limbs, mine, limbs);
}

void BodyLoads::read(parallel::ArchiveReader& file) {
  for (Sums& sums : sums_) sums = {};
  auto const rows = static_cast<std::int64_t>(sums_.size() * items);
  std::vector<parallel::Range> mine;
  if (comm_.rank() == 0 && rows > 0) mine.push_back({0, rows});
  std::vector<std::int64_t> const limbs = file.rows_int("coupling/body_loads", parallel::ExactSum::limbs, mine);
  auto from = limbs.begin();
  if (comm_.rank() != 0) return;
  for (Sums& sums : sums_)
    for (parallel::ExactSum& sum : sums) {
      std::copy_n(from, parallel::ExactSum::limbs, sum.raw().begin());
      from += parallel::ExactSum::limbs;
    }
}

}  // namespace brisance::coupling
