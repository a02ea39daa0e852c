#include "core/model/stage_ledger.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace brisance {

namespace {
template <class Enum>
constexpr std::size_t at(Enum e) {
  return static_cast<std::size_t>(e);
}
}  // namespace

char const* name(Part part) {
  constexpr std::array<char const*, part_count> names{"sources", "diffusion", "sweep_x", "sweep_y",
                                                      "sweep_z", "transfers", "wall",    "mixing",
                                                      "motion",  "contact",   "fracture"};
  return names[at(part)];
}

void add(Amounts& to, Amounts const& from) {
  for (std::size_t q = 0; q < to.size(); ++q) to[q].add(from[q]);
}

void subtract(Amounts& from, Amounts const& what) {
  for (std::size_t q = 0; q < from.size(); ++q) from[q].subtract(what[q]);
}

void StageLedger::watch(Domain domain, Account account) { accounts_[at(domain)].push_back(std::move(account)); }

StageLedger::Count StageLedger::count(Domain domain, Ledger& main) {
  Ledger now;
  for (Account const& account : accounts_[at(domain)]) account(now);
  main.receive(now);
  Count count;
  for (std::size_t q = 0; q < 5; ++q) {
    count.held[q] = now.added(static_cast<Entry>(at(Entry::mass) + q));
    count.received[q] = now.added(static_cast<Entry>(at(Entry::in_mass) + q));
  }
  count.received[4].subtract(now.added(Entry::dissipated));
  return count;
}

void StageLedger::begin(Ledger& main) {
  if (!known_)
    for (Domain const domain : {Domain::flow, Domain::solid}) held_[at(domain)] = count(domain, main).held;
  known_ = true;
  at_begin_ = held_;
}

void StageLedger::charge(Part part, Domain domain, Ledger& main) {
  Count const now = count(domain, main);
  Amounts& sums = recent_[at(part)];
  add(sums, now.held);
  subtract(sums, held_[at(domain)]);
  subtract(sums, now.received);
  held_[at(domain)] = now.held;
  charged_[at(part)] = true;
  if (domain == Domain::flow)
    for (auto const& look : looks_) look(part);
}

void StageLedger::shift(Part from, Part to, Amounts const& amounts) {
  subtract(recent_[at(from)], amounts);
  add(recent_[at(to)], amounts);
  charged_[at(to)] = true;
}

void StageLedger::audit(parallel::Comm& comm) {
  std::vector<parallel::ExactSum> sums;
  for (Amounts const& amounts : recent_) sums.insert(sums.end(), amounts.begin(), amounts.end());
  comm.sum(std::span(sums));
  for (std::size_t p = 0; p < part_count; ++p)
    for (std::size_t q = 0; q < 5; ++q) {
      total_[p][q].add(sums[5 * p + q]);
      largest_[p][q] = max(largest_[p][q], std::abs(total_[p][q].value()));
    }
  recent_ = {};
}

void StageLedger::restore() {
  recent_ = {};
  held_ = at_begin_;
}

std::array<Real, 5> StageLedger::defect(Part part) const {
  std::array<Real, 5> values{};
  for (std::size_t q = 0; q < 5; ++q) values[q] = total_[at(part)][q].value();
  return values;
}

std::vector<std::int64_t> StageLedger::store_limbs() const {
  std::vector<std::int64_t> limbs;
  for (Amounts const& amounts : total_)
    for (parallel::ExactSum sum : amounts) limbs.insert(limbs.end(), sum.raw().begin(), sum.raw().end());
  return limbs;
}

std::vector<Real> StageLedger::store_sizes() const {
  std::vector<Real> sizes;
  for (std::size_t p = 0; p < part_count; ++p) {
    sizes.insert(sizes.end(), largest_[p].begin(), largest_[p].end());
    sizes.push_back(charged_[p] ? 1 : 0);
  }
  return sizes;
}

void StageLedger::read(std::vector<std::int64_t> const& limbs, std::vector<Real> const& sizes) {
  auto from = limbs.begin();
  for (std::size_t p = 0; p < part_count; ++p) {
    for (parallel::ExactSum& sum : total_[p]) {
      std::copy_n(from, parallel::ExactSum::limbs, sum.raw().begin());
      from += parallel::ExactSum::limbs;
    }
    auto const row = sizes.begin() + static_cast<std::ptrdiff_t>(p) * sizes_per_row;
    std::copy_n(row, 5, largest_[p].begin());
    charged_[p] = row[5] != 0;
  }
  recent_ = {};
  known_ = false;
}

std::string open_accounts(StageLedger const& stages, DefectScales const& scales) {
  constexpr Real round_off = 1e-12;
  std::string text;
  auto const judge = [&](Part part, Real defect, char const* of) {
    if (!(defect <= round_off)) {  // not a number either
      std::ostringstream size;
      size << std::setprecision(2) << defect;
      text += std::string(text.empty() ? "" : ", ") + name(part) + " (" + size.str() + " " + of + ")";
    }
  };
  for (std::size_t p = 0; p < part_count; ++p) {
    Part const part = static_cast<Part>(p);
    if (!stages.charged(part)) continue;
    std::array<Real, 5> const& most = stages.largest(part);
    judge(part, most[0] / scales.mass, "of the mass");
    judge(part, max(most[1], max(most[2], most[3])) / scales.momentum, "of the momentum");
    if (part != Part::motion && part != Part::contact) judge(part, most[4] / scales.energy, "of the energy");
  }
  return text.empty() ? text : "the account does not close in every part of the step: " + text;
}

}  // namespace brisance
