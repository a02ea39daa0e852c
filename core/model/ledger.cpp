#include "core/model/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {
constexpr std::size_t at(Entry e) { return static_cast<std::size_t>(e); }
}  // namespace

void Ledger::add(Entry x_entry, Vec3 const& value) {
  for (int d = 0; d < 3; ++d) sums_[at(x_entry) + static_cast<std::size_t>(d)].add(value[d]);
}

void Ledger::receive(Ledger const& part) {
  for (std::size_t e = at(Entry::solid_stored) + 1; e < entry_count; ++e) sums_[e].add(part.sums_[e]);
}

void Ledger::audit(parallel::Comm& comm) {
  comm.sum(std::span(sums_));
  for (std::size_t e = 0; e < entry_count; ++e) {
    Real const value = sums_[e].value();
    sums_[e] = {};
    if (e <= at(Entry::solid_stored))
      totals_[e] = value;
    else
      crossed_[e] += value;
  }
  if (!started_) {
    reference_ = totals_;
    crossed_ = {};
    started_ = true;
    return;
  }
  auto const change = [&](Entry e) { return totals_[at(e)] - reference_[at(e)]; };
  auto const crossed = [&](Entry e) { return crossed_[at(e)]; };
  auto const relative = [](Real defect, Real scale) { return scale > 0 ? std::abs(defect) / scale : std::abs(defect); };

  result_.mass = max(result_.mass, relative(change(Entry::mass) - crossed(Entry::in_mass),
                                            max(std::abs(totals_[at(Entry::mass)]), reference_[at(Entry::mass)])));
  Real const momentum_scale = totals_[at(Entry::momentum_size)] + crossed(Entry::pressure_impulse);
  for (int d = 0; d < 3; ++d) {
    auto const e = at(Entry::momentum_x) + static_cast<std::size_t>(d);
    auto const in = at(Entry::in_momentum_x) + static_cast<std::size_t>(d);
    result_.momentum[d] = max(result_.momentum[d], relative(totals_[e] - reference_[e] - crossed_[in], momentum_scale));
  }
  Real const energy_scale = max(max(std::abs(totals_[at(Entry::energy)]), std::abs(reference_[at(Entry::energy)])),
                                crossed(Entry::exchanged_energy));
  Real const energy = change(Entry::energy) - crossed(Entry::in_energy) + crossed(Entry::dissipated);
  // What starts from rest has hardly any energy in its first steps: the largest defect is held against the largest
  // scale.
  largest_defect_ = max(largest_defect_, std::abs(energy));
  largest_scale_ = max(largest_scale_, energy_scale);
  result_.energy = relative(largest_defect_, largest_scale_);
  result_.energy_final = energy_scale > 0 ? energy / energy_scale : energy;
  Real const exchange = change(Entry::fluid_energy) - crossed(Entry::fluid_in_energy) + crossed(Entry::wall_work);
  result_.exchange_energy = max(result_.exchange_energy, relative(exchange, energy_scale));
}

DefectScales Ledger::scales() const {
  auto const or_one = [](Real scale) { return scale > 0 ? scale : 1; };
  return {or_one(max(std::abs(totals_[at(Entry::mass)]), reference_[at(Entry::mass)])),
          or_one(totals_[at(Entry::momentum_size)] + crossed_[at(Entry::pressure_impulse)]), or_one(largest_scale_)};
}

std::array<Real, Ledger::stored_size> Ledger::store() const {
  std::array<Real, stored_size> out{};
  std::copy(reference_.begin(), reference_.end(), out.begin());
  std::copy(totals_.begin(), totals_.end(), out.begin() + entry_count);
  std::copy(crossed_.begin(), crossed_.end(), out.begin() + 2 * entry_count);
  std::array<Real, 10> const rest{
      started_ ? 1.0 : 0.0,    result_.mass,   result_.momentum.x,   result_.momentum.y, result_.momentum.z,
      result_.exchange_energy, result_.energy, result_.energy_final, largest_defect_,    largest_scale_};
  std::copy(rest.begin(), rest.end(), out.begin() + 3 * entry_count);
  return out;
}

void Ledger::restore(std::array<Real, stored_size> const& in) {
  std::copy_n(in.begin(), entry_count, reference_.begin());
  std::copy_n(in.begin() + entry_count, entry_count, totals_.begin());
  std::copy_n(in.begin() + 2 * entry_count, entry_count, crossed_.begin());
  auto const* rest = in.data() + 3 * entry_count;
  started_ = rest[0] != 0;
  result_ = {rest[1], {rest[2], rest[3], rest[4]}, rest[5], rest[6], rest[7]};
  largest_defect_ = rest[8];
  largest_scale_ = rest[9];
  sums_ = {};
}

}  // namespace brisance
