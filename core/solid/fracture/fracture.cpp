#include "core/solid/fracture/fracture.hpp"

#include <algorithm>
#include <cmath>

#include "core/solid/fracture/law_figures.hpp"
#include "core/solid/fracture/link_motion.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Wants wants_of(Criterion const& criterion) {
  return std::visit([](auto const& law) { return law.wants(); }, criterion);
}

}  // namespace

Fracture::Fracture(FractureConfig const& config, Solid& solid, parallel::Comm& comm)
    : solid_(solid), comm_(comm), groups_(assign_laws(config, solid)) {
  remarks_ = law_figures(config, solid_.mesh());
  solid_.allow_damage();
  Mesh const& mesh = solid_.mesh();
  for (std::size_t k = 0; k < solid_.links(); ++k)
    sections_.push_back(section_of(mesh, mesh.links[solid_.mesh_link(k)]));
  bool const volumetric =
      std::any_of(mesh.materials.begin(), mesh.materials.end(), [](Material const& m) { return m.lame() != 0; });
  for (LawGroup const& group : groups_)
    ghost_pressure_ = ghost_pressure_ || (volumetric && wants_of(group.criterion).pressure);
}

LinkState Fracture::state_of(std::size_t k, Wants const& wants) const {
  GapBlock const& gap = solid_.gaps()[k / lanes];
  std::size_t const lane = k % lanes;
  Index const i = solid_.link_store().end_i(k), j = solid_.end_j(k);
  bool const wall = j == solid_.count();
  Real const whole = 1 / solid_.intact(k);  // the gap was measured on what is left of the link
  LinkState s = link_state(sections_[k], whole * gap.opened[lane], gap.squared[lane], whole * gap.flexure[lane],
                           pressure_[at(i)], wall ? 0 : pressure_[at(j)]);
  if (wants.stretch) s.stretch = stretch(solid_, k);
  if (wants.rate) s.rate = gap_speed(solid_, k) / sections_[k].length;
  if (wants.fibre) s.fibre = fibre_stress(solid_, k);
  return s;
}

template <class Law>
void Fracture::judge_group(LawGroup& group, Law const& law) {
  Wants const wants = law.wants();
  auto const gaps = solid_.gaps();
  for (std::size_t n = 0; n < group.links.size(); ++n) {
    std::size_t const k = group.links[n];
    GapBlock const& gap = gaps[k / lanes];
    Watch const& w = group.watch[n];
    Real const intact = solid_.intact(k);
    Real const pressure = max(std::abs(pressure_[at(w.i)]), std::abs(pressure_[at(w.j)]));
    if (intact == 0 ||
        (intact == 1 && is_safe(w.k, w.k_over_area, gap.squared[k % lanes], gap.flexure[k % lanes], pressure, w.safe)))
      continue;
    LinkState const s = state_of(k, wants);
    Real const scatter = group.scatter.empty() ? 1 : group.scatter[n];
    Real left = intact;
    if constexpr (Law::softens) {
      CohesiveHistory const before = group.history[n];
      left = min(intact, law.intact(s, scatter, group.history[n]));
      history_changed_ = history_changed_ || !(before == group.history[n]);
    } else if (law.fails(s, scatter)) {
      left = 0;
    }
    if (left != intact) changes_.push_back({k, left});
  }
}

void Fracture::start() {
  auto now = std::make_shared<Fragments>(*fragments_);
  now->find(solid_, comm_);
  fragments_ = std::move(now);
}

bool Fracture::judge(Real time) {
  pressure_.assign(solid_.pressure().begin(), solid_.pressure().end());
  // Links between the first and the second layer of ghosts are judged here too, with the bits of their owners.
  if (ghost_pressure_) solid_.exchange_rows(pressure_, 1);
  changes_.clear();
  for (LawGroup& group : groups_) std::visit([&](auto const& law) { judge_group(group, law); }, group.criterion);

  Index const owned = solid_.owned();
  LinkStore const& links = solid_.link_store();
  touched_.clear(), touched_link_.clear();
  for (Change const& change : changes_) {
    Index const i = links.end_i(change.link), j = solid_.end_j(change.link);
    if (i < owned) touched_link_.push_back(change.link);
    for (Index const p : {i, j})
      if (p < owned) touched_.push_back(p);
  }
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  add_energy(dissipated_, 1);
  for (Change const& change : changes_) {
    solid_.weaken(change.link, change.intact);
    if (change.intact == 0 && links.end_i(change.link) < owned) ++links_broken_;
  }
  // Other effects may break links too: fragments follow the links, whoever broke them.
  std::uint64_t news = (changes_.empty() ? 0u : 1u) | (solid_.broken() == broken_seen_ ? 0u : 2u);
  broken_seen_ = solid_.broken();
  comm_.bit_or(std::span(&news, 1));
  if ((news & 2u) != 0) {
    auto now = std::make_shared<Fragments>(*fragments_);
    now->update(solid_, comm_, time);
    fragments_ = std::move(now);
  }
  return to_book_ = (news & 1u) != 0;
}

void Fracture::add_energy(parallel::ExactSum& to, Real sign) const {
  for (Index const p : touched_) to.add(sign * solid_.volumetric_energy(p));
  for (std::size_t const k : touched_link_) to.add(sign * solid_.link_energy(k));
}

void Fracture::book() {
  if (to_book_) add_energy(dissipated_, -1);
  to_book_ = false;
}

void Fracture::join(Plan& plan) {
  plan.effect("solid.fracture", [this] {
    std::size_t bytes = fragments_->bytes() + solid_.gaps().size_bytes() + sections_.size() * sizeof(Section) +
                        pressure_.size() * sizeof(double);
    for (LawGroup const& g : groups_)
      bytes += g.links.size() * (sizeof(std::size_t) + sizeof(Watch)) + g.scatter.size() * sizeof(Real) +
               g.history.size() * sizeof(CohesiveHistory);
    return bytes;
  });
  for (std::string const& remark : remarks_) plan.remark(remark);
  plan.at(Stage::fracture, [this, &plan](Clock const& c) {
    if (judge(c.time + c.dt)) plan.ask_for_forces();
  });
  plan.at(Stage::forces, [this](Clock const&) { book(); });
  plan.account([this](Ledger& ledger) {
    ledger.add(Entry::dissipated, dissipated_);
    ledger.add(Entry::links_broken, static_cast<Real>(links_broken_));
    dissipated_ = {};
    links_broken_ = 0;
  });
  plan.table({"fragments.csv", census_header(), [this](Clock const& c) {
                std::string rows;
                for (FragmentFigures const& fragment : take_census(solid_, *fragments_, comm_))
                  rows += census_row(fragment, solid_.mesh(), c.step, c.time);
                return rows;
              }});
  plan.particle_field("fragment", [this](std::span<double> to) {
    for (std::size_t p = 0; p < to.size(); ++p) to[p] = static_cast<double>(fragments_->label()[p]);
  });
  plan.particle_field("damage", [this](std::span<double> to) { damage_of_particles(to); });
  keep(plan);
}

void Fracture::damage_of_particles(std::span<double> to) const {
  // Of the face area that was linked.
  std::vector<Real> linked(to.size(), 0);
  std::fill(to.begin(), to.end(), 0.0);
  for (std::size_t k = 0; k < solid_.links(); ++k)
    for (Index const end : {solid_.link_store().end_i(k), solid_.end_j(k)}) {
      if (at(end) >= to.size()) continue;
      linked[at(end)] += sections_[k].area;
      to[at(end)] += (1 - solid_.intact(k)) * sections_[k].area;
    }
  for (std::size_t p = 0; p < to.size(); ++p)
    if (linked[p] > 0) to[p] /= linked[p];
}

}  // namespace brisance::solid
