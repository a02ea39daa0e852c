// Multi-rate steps: nested impulses on levels of links and volumes.  Source: theory/solid.md section 12(a).
#include <bit>

#include "core/solid/solid.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
std::size_t at(GlobalId i) { return static_cast<std::size_t>(i); }

}  // namespace

std::size_t Rates::bytes() const {
  std::size_t sum = levels.link.size() + levels.first.size() + levels.volume.size() + levels.particle.size() +
                    (link_share.size() + volume_share.size() + pressure.size()) * sizeof(double);
  for (Rung const& r : rungs)
    sum += r.links.bytes() + (r.place.size() + r.link_share.size() + r.volume_share.size()) * sizeof(double) +
           (r.touched.size() + r.kicked.size()) * sizeof(Index);
  return sum;
}

void Solid::assign_rates(int most) {
  link_limits_ = link_limits();
  auto const everywhere = [&](std::vector<double> const& of_owned) {
    std::vector<Real> all(at(mesh_.size()), 1e300);
    for (Index l = 0; l < owned_; ++l) all[at(id(l))] = of_owned[at(l)];
    comm_.min(std::span(all));
    return all;
  };
  rates_ = std::make_unique<Rates>();
  Rates& r = *rates_;
  r.levels = assign_levels(mesh_, {everywhere(link_limits_), everywhere(volume_limits()), cfl_}, most);
  int const top = r.levels.top;
  r.pressure.assign(at(count_) + 1, 0);
  for (Index l = 0; l < count_; ++l) r.volume_share.push_back(Rates::power(r.levels.volume[at(id(l))], top));
  for (std::size_t l : mesh_link_) r.link_share.push_back(Rates::power(r.levels.link[l], top));
  r.link_share.resize(links_.padded_count(), 0);
  r.drifting.resize(static_cast<std::size_t>(top) + 1);
  for (Index l = 0; l < owned_; ++l) r.drifting[r.levels.particle[at(id(l))]].push_back(l);
  r.rungs.resize(static_cast<std::size_t>(top));
  r.link_updates = static_cast<std::int64_t>(links_.count());
  for (int m = 0; m < top; ++m) {
    fill_rung(m);
    r.link_updates += static_cast<std::int64_t>(r.rungs[static_cast<std::size_t>(m)].links.count()) << (top - 1 - m);
  }
}

void Solid::fill_rung(int level) {
  Levels const& levels = rates_->levels;
  Rung& rung = rates_->rungs[static_cast<std::size_t>(level)];
  std::vector<char> touched(at(count_) + 1, 0);
  for (std::size_t k = 0; k < links_.count(); ++k) {
    std::size_t const of_mesh = mesh_link_[k];
    if (levels.first[of_mesh] > level) continue;
    int const own = levels.link[of_mesh];
    rung.place.push_back(k);
    if (links_.end_j(k) == count_ && links_.end_i(k) < owned_) rung.clamps.push_back(rung.links.count());
    rung.links.add(links_.end_i(k), links_.end_j(k), links_.rest(k));
    rung.link_share.push_back(own <= level ? Rates::power(own, level) : 0);
    touched[at(links_.end_i(k))] = touched[at(links_.end_j(k))] = 1;
  }
  rung.link_share.resize(rung.links.padded_count(), 0);
  std::vector<Halo::Ghost> moving;
  for (Index l = 0; l < count_; ++l) {
    if (l >= owned_ && levels.particle[at(id(l))] <= level) moving.push_back({l, id(l), owner(id(l))});
    if (!touched[at(l)]) continue;
    int const volume = levels.volume[at(id(l))];
    rung.touched.push_back(l);
    rung.volume_share.push_back(volume <= level ? Rates::power(volume, level) : 0);
    if (l >= owned_) continue;
    rung.kicked.push_back(l);
    if (motion_[at(l)].turns == 0) rung.held.push_back(l);
  }
  rung.halo.connect(comm_, moving, local_);
}

void Solid::move(Real dt) {
  if (!rates_) {
    drift(dt);
    exchange_pose();
    return;
  }
  int const top = rates_->levels.top;
  unsigned const steps = 1u << top;
  for (unsigned s = 0; s < steps; ++s) {
    // Particles of level l move at once over the whole of their step, which begins at multiples of 2^l: no force acts
    // on them in between.
    int const begins = s == 0 ? top : std::countr_zero(s);
    for (int l = 0; l <= begins; ++l) {
      Real const share = Rates::power(l, top);
      drift_level(rates_->drifting[static_cast<std::size_t>(l)], share * dt, share, s == 0);
    }
    Halo& halo = begins == top ? halo_ : rates_->rungs[static_cast<std::size_t>(begins)].halo;
    halo.start(comm_, pose_, half_);
    halo.finish(pose_, half_);
    if (s + 1 == steps) break;  // all forces meet at the end of the coarse step
    int const ends = std::countr_zero(s + 1);
    Rung& rung = rates_->rungs[static_cast<std::size_t>(ends)];
    compute_rung(rung);
    kick_rung(rung, Rates::power(ends, top) * dt);
  }
}

void Solid::add_shared_wrench() {
  for (std::size_t p = 0; p < at(count_); ++p) rates_->pressure[p] = rates_->volume_share[p] * pressure_[p];
  links_.add_wrench(pose_, rates_->pressure, rates_->link_share, wrench_);
}

void Solid::compute_rung(Rung const& rung) {
  std::vector<double>& pressure = rates_->pressure;
  for (Index l : rung.touched) {
    opened_[at(l)] = face_opening_[at(l)];
    wrench_[at(l)] = {};
  }
  if (volumetric_) {
    rung.links.add_opened_volume(pose_, opened_);
    for (std::size_t k = 0; k < rung.touched.size(); ++k) {
      std::size_t const p = at(rung.touched[k]);
      pressure[p] = rung.volume_share[k] * (bulk_[p] * opened_[p]);
    }
  }
  rung.links.add_wrench(pose_, pressure, rung.link_share, wrench_);
}

}  // namespace brisance::solid
