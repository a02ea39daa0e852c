#include "core/solid/contact/contact.hpp"

#include <algorithm>

#include "parallel/archive.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Of a row of accelerations: free and its turn, by contacts and its turn.
constexpr std::size_t width = 12;
constexpr std::uint32_t contact_kind = 0x434f4e54;  // "CONT"

/// One number for a pair of particles, as rows of a checkpoint and entities of the digest need it.
GlobalId number_of(std::pair<GlobalId, GlobalId> const& pair, GlobalId particles) {
  return pair.first * particles + pair.second;
}

}  // namespace

Contact::Contact(SolidConfig const& config, Solid& solid, parallel::Comm& comm)
    : config_(*config.contact),
      damping_(damping_for(config_.restitution)),
      link_cfl_(config.motion.cfl),
      gravity_(config.gravity),
      solid_(solid),
      list_(solid, comm, config_.self) {}

void Contact::join(Plan& plan) {
  plan.effect("solid.contact", [this] { return list_.bytes() + overlaps_.size() * sizeof(Overlap); });
  plan.at(Stage::contact, [this](Clock const& clock) { apply(clock); });
  if (plan.stages()) charge_stages(plan);
  plan.limit_ahead(
      "solid.contact", [this](Clock const&) { return time_step(); }, [this] { return sight(); },
      [this](Real horizon) { return sub_step(horizon); });
  plan.account([this](Ledger& ledger) { account(ledger); });
  Plan::Keep keep;
  struct Saved {
    std::map<PairId, PairMemory> memory;
    parallel::ExactSum dissipated;
  };
  auto saved = std::make_shared<Saved>();
  keep.save = [this, saved] {
    saved->memory.clear();
    for (std::size_t const k : live_)
      if (overlaps_[k].active) saved->memory.emplace(listed_[k], overlaps_[k].memory);
    saved->dissipated = dissipated_;
    if (charged_) charged_->save();
  };
  keep.restore = [this, saved] {
    kept_ = saved->memory;
    dissipated_ = saved->dissipated;
    step_ = {-1, 0};
    start();
    if (charged_) charged_->restore();
  };
  keep.write = [this](parallel::ArchiveWriter& file) { write(file); };
  keep.read = [this](parallel::ArchiveReader& file) { read(file); };
  keep.digest = [this](parallel::Digest& digest) { this->digest(digest); };
  plan.keep(std::move(keep));
}

void Contact::charge_stages(Plan& plan) {
  charged_ = std::make_unique<ContactAccount>(*plan.stages(), solid_);
  plan.at(Stage::set_off, [this](Clock const&) {
    charged_->begin_step(held_energy());
    charged_->before_kick();
  });
  plan.at(Stage::kick, [this](Clock const& c) { charged_->after_kick(c.dt); });
  plan.at(Stage::contact, [this](Clock const&) { charged_->before_kick(); });
  plan.at(Stage::kick_again, [this](Clock const& c) {
    charged_->after_kick(c.dt);
    charged_->end_step(held_energy(), dissipated_);
  });
}

parallel::ExactSum Contact::held_energy() const {
  parallel::ExactSum energy;
  for (std::size_t const k : live_)
    if (overlaps_[k].active && mine(k)) energy.add(overlaps_[k].energy);
  return energy;
}

void Contact::start() {
  overlaps_.clear(), listed_.clear(), live_.clear();
  list_.invalidate();
  refresh();
  measure();
}

Contact::PairId Contact::id_of(std::size_t pair) const {
  ContactPair const& p = list_.pairs()[pair];
  return {list_.actors()[at(p.a)].id, list_.actors()[at(p.b)].id};
}

bool Contact::mine(std::size_t pair) const { return list_.actors()[at(list_.pairs()[pair].a)].local >= 0; }

/// A list that is complete for the present poses, and the poses. Was it built anew?
bool Contact::refresh() {
  bool const anew = list_.update();
  if (anew) carry_over();
  list_.exchange();
  return anew;
}

/// What the pairs remember moves to the new list.
void Contact::carry_over() {
  std::vector<Overlap> fresh(list_.pairs().size());
  std::vector<PairId> ids;
  for (std::size_t k = 0, old = 0; k < fresh.size(); ++k) {
    PairId const id = id_of(k);
    ids.push_back(id);
    while (old < listed_.size() && listed_[old] < id) ++old;
    Overlap& o = fresh[k];
    if (old < listed_.size() && listed_[old] == id)
      o = overlaps_[old];
    else if (auto const kept = kept_.find(id); kept != kept_.end())
      o.memory = kept->second, o.active = true;
    o.law = law_of(list_.pairs()[k]);
  }
  kept_.clear();
  overlaps_ = std::move(fresh);
  listed_ = std::move(ids);
  live_.clear();
  for (std::size_t k = 0; k < overlaps_.size(); ++k)
    if (overlaps_[k].active || overlaps_[k].was_active) live_.push_back(k);
}

/// Angular acceleration under a torque, fixed frame.
Vec3 Contact::turned_by(ContactActor const& actor, Quaternion const& q, Vec3 const& torque) const {
  Vec3 const body = rotate(conjugate(q), torque);
  return (1 / actor.density) * rotate(q, actor.shape->inverse_inertia * body);
}

/// What the contacts of an actor would do to it with their plain pressures, and what all else does.
void Contact::gather_accelerations() {
  auto const& actors = list_.actors();
  rows_.assign(width * actors.size(), 0);
  auto const put = [&](Index actor, std::size_t column, Vec3 const& v) {
    for (int d = 0; d < solid_.mesh().dimension; ++d) rows_[width * at(actor) + column + at(d)] += v[d];
  };
  auto const put_turn = [&](Index actor, std::size_t column, Vec3 const& v) {
    int const dimension = solid_.mesh().dimension;
    for (int d = dimension == 3 ? 0 : dimension == 2 ? 2 : 3; d < 3; ++d)
      rows_[width * at(actor) + column + at(d)] += v[d];
  };
  auto const movable = [&](Index actor) { return actors[at(actor)].local >= 0 && !actors[at(actor)].held; };
  std::vector<char> pressed(actors.size(), 0);
  for (std::size_t const k : live_) {
    Overlap const& o = overlaps_[k];
    if (!o.active) continue;
    ContactPair const& p = list_.pairs()[k];
    pressed[at(p.a)] = pressed[at(p.b)] = 1;
    Real const pressure = o.law.pressure(o.common.volume);
    Vec3 const shift = list_.pose(p.b).x - list_.pose(p.a).x;
    auto const push = [&](Index actor, Vec3 const& area, Vec3 const& moment) {
      if (!movable(actor)) return;
      put(actor, 6, (-pressure * actors[at(actor)].inverse_mass()) * area);
      put_turn(actor, 9, turned_by(actors[at(actor)], list_.pose(actor).q, -pressure * moment));
    };
    push(p.a, o.common.area, o.common.moment);
    push(p.b, -o.common.area, cross(shift, o.common.area) - o.common.moment);
  }
  for (Index k = 0; k < static_cast<Index>(actors.size()); ++k) {
    if (!pressed[at(k)] || !movable(k)) continue;
    std::size_t const l = at(actors[at(k)].local);
    Wrench const &in = solid_.internal()[l], &load = solid_.load()[l];
    put(k, 0, actors[at(k)].inverse_mass() * (in.force + load.force) + gravity_.value_or(Vec3{}));
    put_turn(k, 3, turned_by(actors[at(k)], list_.pose(k).q, in.torque + load.torque));
  }
  list_.exchange_rows(rows_, width);
}

PairEnd Contact::end_of(Index actor, Vec3 const& area, Vec3 const& moment) const {
  auto const column = [&](std::size_t c) {
    double const* r = &rows_[width * at(actor) + c];
    return Vec3{r[0], r[1], r[2]};
  };
  PairEnd end{
      list_.pose(actor).q, list_.half(actor).v, list_.half(actor).omega, column(0), column(3), column(6), column(9), 0};
  if (ContactActor const& of = list_.actors()[at(actor)]; !of.held)
    end.compliance = of.inverse_mass() * norm2(area) + dot(moment, turned_by(of, end.q, moment));
  return end;
}

void Contact::apply(Clock const& clock) {
  std::pair<std::int64_t, int> const now{clock.step, clock.sub_step};
  bool const again = step_ == now;  // links broke in this step: forces anew at the same positions
  step_ = now;
  if (!again) begin_step();
  refresh();
  find_overlaps(Axes::choose);
  gather_accelerations();
  std::span<Wrench> const wrench = solid_.internal();
  if (charged_) charged_->begin_forces();
  for (std::size_t const k : live_) {
    Overlap& o = overlaps_[k];
    ContactPair const& p = list_.pairs()[k];
    o.energy = 0;
    DepthAxis const axis = o.memory.axis;
    o.memory = {};
    Vec3 const shift = list_.pose(p.b).x - list_.pose(p.a).x;
    PairEnd const a = end_of(p.a, o.common.area, o.common.moment);
    PairEnd const b = end_of(p.b, o.common.area, cross(shift, o.common.area) - o.common.moment);
    if (o.active) {
      PairForce const f = contact_force(o.law, o.common, shift, a, b, clock.dt, o.was_active ? &o.before : nullptr);
      o.memory = f.memory;
      o.memory.axis = axis;
      o.energy = f.energy + o.barrier.energy;
      auto const add = [&](Index actor, Vec3 const& force, Vec3 const& torque) {
        Index const local = list_.actors()[at(actor)].local;
        if (local < 0) return;
        wrench[at(local)].force += force;
        wrench[at(local)].torque += torque;
        if (charged_) charged_->add(local, force, torque);
      };
      add(p.a, f.force + o.barrier.force, f.torque_a + o.barrier.torque_a);
      add(p.b, -f.force - o.barrier.force, f.torque_b + o.barrier.torque_b);
    }
    if (mine(k)) book(o, a, b, clock.dt, again);
  }
}

void Contact::begin_step() {
  for (std::size_t const k : live_)
    overlaps_[k].before = overlaps_[k].memory, overlaps_[k].was_active = overlaps_[k].active;
}

/// What left the mechanical account since the start of the step.
void Contact::book(Overlap& o, PairEnd const& a, PairEnd const& b, Real dt, bool again) {
  if (again) {
    // A face that opened under pressure goes on pressing: that energy did not leave with its link.
    dissipated_.add(o.first_energy - o.energy);
  } else {
    // Work of damping and friction over the drift, by the trapezoid of the two kicks that the drift lies between;
    // what the spring of friction took is not lost.
    auto const power = [&](PairMemory const& m) {
      return dot(m.force, a.v - b.v) + dot(m.torque_a, a.omega) + dot(m.torque_b, b.omega);
    };
    PairMemory const before = o.was_active ? o.before : PairMemory{};
    dissipated_.add(-0.5 * dt * (power(before) + power(o.memory)) - (o.memory.stored() - before.stored()));
  }
  o.first_energy = o.energy;
}

void Contact::account(Ledger& ledger) {
  parallel::ExactSum const energy = held_energy();
  ledger.add(Entry::energy, energy);
  ledger.add(Entry::solid_elastic, energy);
  ledger.add(Entry::dissipated, dissipated_);
  dissipated_ = {};
}

std::int64_t Contact::overlapping_pairs() const {
  std::int64_t count = 0;
  for (std::size_t const k : live_) count += overlaps_[k].active && mine(k);
  return count;
}

void Contact::digest(parallel::Digest& to) const {
  for (std::size_t const k : live_)
    if (overlaps_[k].active && mine(k)) {
      auto const row = overlaps_[k].memory.pack();
      to.add(contact_kind, number_of(listed_[k], solid_.mesh().size()), row);
    }
}

void Contact::write(parallel::ArchiveWriter& file) const {
  std::vector<GlobalId> ids;
  std::vector<double> rows;
  for (std::size_t const k : live_) {
    if (!overlaps_[k].active || !mine(k)) continue;
    ids.push_back(number_of(listed_[k], solid_.mesh().size()));
    auto const row = overlaps_[k].memory.pack();
    rows.insert(rows.end(), row.begin(), row.end());
  }
  file.sparse("solid/contact", PairMemory::size, ids, rows);
  if (charged_) charged_->write(file);
}

void Contact::read(parallel::ArchiveReader& file) {
  auto const stored = file.sparse("solid/contact", PairMemory::size);
  kept_.clear();
  for (std::size_t r = 0; r < stored.ids.size(); ++r) {
    PairId const id{stored.ids[r] / solid_.mesh().size(), stored.ids[r] % solid_.mesh().size()};
    kept_.emplace(id, PairMemory::unpack(stored.data.data() + r * PairMemory::size));
  }
  if (charged_) charged_->read(file);
}

}  // namespace brisance::solid
