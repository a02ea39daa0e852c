#include "core/solid/plasticity/plasticity.hpp"

#include <algorithm>
#include <cstdio>

#include "core/base/errors.hpp"
#include "core/base/place.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
constexpr std::size_t row = 7;  // strain 6, damage
/// The law is linear in the plastic strain: at this size its volume is off by some per cent, and at a principal value
/// of -1 a particle has no thickness left.
constexpr Real large_strain = 0.3, largest_strain = 0.9;

/// The equivalent of von Mises: e_xx of a bar that is pulled, 1.
Real size(Symmetric const& strain) { return equivalent(strain) / 1.5; }

}  // namespace

Plasticity::Plasticity(SolidConfig const& config, Solid& solid, parallel::Comm& comm) : solid_(solid), comm_(comm) {
  for (Material const& m : solid.mesh().materials) {
    MaterialConfig const& of = config.material.at(m.name);
    law_of_material_.push_back(of.plasticity ? static_cast<Index>(laws_.size()) : -1);
    if (!of.plasticity) continue;
    require(config.links.has_value(), of.plasticity->at,
            "plasticity acts through links, and the scene has none: add links = {} to [solid].");
    laws_.emplace_back(*of.plasticity, m.density, m.shear());
    fails_ = fails_ || laws_.back().fails();
  }
  solid_.allow_plasticity();
  if (fails_) solid_.allow_damage();
  auto const owned = at(solid.owned());
  state_.resize(owned);
  for (Index p = 0; p < solid.owned(); ++p)
    if (PlasticLaw const* law = law_of(p)) state_[at(p)].temperature = law->initial_temperature();
  stress_.resize(owned);
  trial_.resize(owned);
  rows_.assign(at(solid.count()) * row, 0);
  threshold_.assign(owned, -1);
}

PlasticLaw const* Plasticity::law_of(Index particle) const {
  Index const law = law_of_material_[at(solid_.mesh().particle(solid_.id(particle)).material)];
  return law < 0 ? nullptr : &laws_[at(law)];
}

Symmetric Plasticity::stress(Index particle) const {
  return (1 / solid_.plastic().volume(particle)) * deviator(stress_[at(particle)]);
}

void Plasticity::set_threshold(Index particle) {
  PlasticLaw const* law = law_of(particle);
  if (law) threshold_[at(particle)] = std::pow(law->threshold(state_[at(particle)]), 2) / 1.5;
}

void Plasticity::start() {
  for (Index p = 0; p < solid_.owned(); ++p) set_threshold(p);
  spread();
  solid_.compute_forces();
  solid_.driving_stress(stress_);
}

void Plasticity::spread() {
  for (std::size_t p = 0; p < state_.size(); ++p) {
    std::copy_n(state_[p].strain.c.begin(), 6, rows_.begin() + static_cast<std::ptrdiff_t>(row * p));
    rows_[row * p + 6] = state_[p].damage;
  }
  solid_.exchange_rows(rows_, row);
  for (Index p = 0; p < solid_.count(); ++p) {
    Symmetric strain;
    std::copy_n(rows_.begin() + static_cast<std::ptrdiff_t>(row * at(p)), 6, strain.c.begin());
    solid_.plastic().set_strain(p, strain);
  }
  solid_.plastic().follow();
}

void Plasticity::flow(Real dt) {
  solid_.compute_strains();
  solid_.driving_stress(trial_);
  for (Index p = 0; p < solid_.owned(); ++p) {
    if (threshold_[at(p)] < 0) continue;
    PlasticLaw const* law = law_of(p);
    PlasticState& state = state_[at(p)];
    Real const volume = solid_.plastic().volume(p);
    Symmetric const stress = (1 / volume) * deviator(trial_[at(p)]);
    Symmetric const driving = law->relative(stress, state);
    bool const yields = contract(driving, driving) > threshold_[at(p)];
    PlasticFlow const flow = yields ? law->flow(stress, state, dt) : PlasticFlow{};
    if (flow.dp > 0) {
      state.strain = state.strain + flow.strain;
      state.p += flow.dp;
      yielding_.push_back({p, flow});
      if (size(state.strain) > largest_strain) overstrained_ = p;
    }
    if (!law->fails() || (flow.dp == 0 && !(law->damaged_at_rest() && state.p > 0))) continue;
    Real const shear = solid_.mesh().material(solid_.id(p)).shear();
    Real const size = equivalent(stress - (2 * shear) * flow.strain);
    Real const mean = trace(trial_[at(p)]) / (3 * volume) + solid_.pressure()[at(p)];
    if (size > 0) law->damage(state, flow.dp, mean / size, dt);
  }
  spread();
}

void Plasticity::settle() {
  solid_.driving_stress(trial_, true);
  for (Yielding const& y : yielding_) {
    Real const volume = solid_.plastic().volume(y.particle);
    Symmetric const mean = 0.5 * (stress_[at(y.particle)] + trial_[at(y.particle)]);
    Real const work = contract(mean, y.flow.strain) / volume;
    dissipated_.add(volume * law_of(y.particle)->settle(state_[at(y.particle)], y.flow, work));
    set_threshold(y.particle);
  }
  yielding_.clear();
  std::swap(stress_, trial_);
}

bool Plasticity::fail() {
  // Damage of ghosts is that of their owners: every rank that has a link comes to the same decision.
  LinkStore const& links = solid_.link_store();
  auto const spent = [&](Index p) { return p < solid_.count() && rows_[row * at(p) + 6] >= 1; };
  std::vector<std::size_t> breaking, counted;
  std::vector<Index> touched;
  for (std::size_t k = 0; k < links.count(); ++k) {
    Index const i = links.end_i(k), j = solid_.end_j(k);
    if (solid_.intact(k) == 0 || !(spent(i) || spent(j))) continue;
    breaking.push_back(k);
    if (i < solid_.owned()) counted.push_back(k);
    for (Index const end : {i, j})
      if (end < solid_.owned()) touched.push_back(end);
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  auto const add_energy = [&](Real sign) {
    for (Index const p : touched) dissipated_.add(sign * solid_.volumetric_energy(p));
    for (std::size_t const k : counted) dissipated_.add(sign * solid_.link_energy(k));
  };
  add_energy(1);
  for (std::size_t const k : breaking) solid_.weaken(k, 0);
  if (!breaking.empty()) solid_.compute_strains();
  add_energy(-1);
  links_broken_ += static_cast<std::int64_t>(counted.size());
  return !breaking.empty();
}

Verdict Plasticity::judge() const {
  if (overstrained_ < 0) return {};
  return {false, "solid.plasticity: the plastic strain of particle " + std::to_string(solid_.id(overstrained_)) +
                     " at " + place_text(solid_.pose()[at(overstrained_)].x) + " has passed " +
                     std::to_string(largest_strain).substr(0, 3) +
                     ", where the law, linear in the strain, turns particles inside out. Give the material a failure "
                     "strain (plasticity.failure), a stronger hardening, or a slower impact."};
}

std::string Plasticity::find_large_strain() const {
  std::array<double, 1> most{0}, id{-1};
  GlobalId mine = -1;
  for (std::size_t p = 0; p < state_.size(); ++p)
    if (Real const s = size(state_[p].strain); s > most[0]) most[0] = s, mine = solid_.id(static_cast<Index>(p));
  Real const here = most[0];
  comm_.max(most);
  if (here == most[0]) id[0] = static_cast<double>(mine);
  comm_.max(id);
  if (most[0] < large_strain || comm_.rank() != 0) return "";
  char text[240];
  std::snprintf(text, sizeof text,
                "solid.plasticity: plastic strains reach %.2g (particle %.0f); the law is linear in them and good for "
                "less than %.1f: take the shape there as a sketch",
                most[0], id[0], large_strain);
  return text;
}

void Plasticity::join(Plan& plan) {
  plan.effect("solid.plasticity", [this] {
    return solid_.plastic().bytes() + state_.size() * (sizeof(PlasticState) + 2 * sizeof(Symmetric)) +
           rows_.size() * sizeof(double);
  });
  plan.at(Stage::drift, [this](Clock const& c) { flow(c.dt); });
  plan.at(Stage::forces, [this](Clock const&) { settle(); });
  plan.health([this](Clock const&) { return judge(); });
  plan.finding([this] { return find_large_strain(); });
  if (fails_)
    plan.at(Stage::fracture, [this, &plan](Clock const&) {
      std::uint64_t broke = fail() ? 1 : 0;
      comm_.bit_or(std::span(&broke, 1));
      if (broke != 0) plan.ask_for_forces();
    });
  plan.account([this](Ledger& ledger) {
    parallel::ExactSum stored;
    for (std::size_t p = 0; p < state_.size(); ++p)
      stored.add(solid_.plastic().volume(static_cast<Index>(p)) * state_[p].stored);
    ledger.add(Entry::energy, stored);
    ledger.add(Entry::solid_stored, stored);
    ledger.add(Entry::dissipated, dissipated_);
    ledger.add(Entry::links_broken, static_cast<Real>(links_broken_));
    dissipated_ = {};
    links_broken_ = 0;
  });
  plan.particle_field("plastic_strain", [this](std::span<double> to) {
    for (std::size_t p = 0; p < to.size(); ++p) to[p] = state_[p].p;
  });
  plan.particle_field("temperature", [this](std::span<double> to) {
    for (std::size_t p = 0; p < to.size(); ++p) to[p] = state_[p].temperature;
  });
  keep(plan);
}

}  // namespace brisance::solid
