#include "fluid/boundary_ledger.hpp"

#include <cmath>
#include <vector>

namespace brisance::fluid {

void BoundaryLedger::add(int direction, int side, Real dt, Real area, State const& flux) {
  Real const inwards = side == 0 ? dt * area : -(dt * area);
  auto& sums = through_[static_cast<std::size_t>(2 * direction + side)];
  for (std::size_t q = 0; q < 5; ++q) {
    sums[q].add(inwards * flux[q]);
    recent_.gained[q].add(inwards * flux[q]);
  }
  Real const impulse = std::abs(inwards * flux[1 + static_cast<std::size_t>(direction)]);
  impulse_.add(impulse);
  recent_.impulse.add(impulse);
  recent_.energy_size.add(std::abs(inwards * flux[4]));
}

BoundaryLedger::Totals BoundaryLedger::totals(parallel::Comm& comm) const {
  std::vector<parallel::ExactSum> sums;
  for (auto const& side : through_) sums.insert(sums.end(), side.begin(), side.end());
  sums.resize(35);
  for (std::size_t q = 0; q < 5; ++q)
    for (auto const& side : through_) sums[30 + q].add(side[q]);
  sums.push_back(impulse_);
  sums.push_back(products_);
  comm.sum(std::span(sums));
  Totals result;
  for (std::size_t s = 0; s < 6; ++s)
    for (std::size_t q = 0; q < 5; ++q) result.through[s][q] = sums[5 * s + q].value();
  for (std::size_t q = 0; q < 5; ++q) result.gained[q] = sums[30 + q].value();
  result.impulse = sums[35].value();
  result.products = sums[36].value();
  return result;
}

}  // namespace brisance::fluid
