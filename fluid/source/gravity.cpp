#include "fluid/source/gravity.hpp"

#include <cmath>

namespace brisance::fluid {

void Gravity::join(Plan& plan) {
  plan.effect("fluid.gravity", [] { return std::size_t{0}; });
  for (Stage const half : {Stage::source, Stage::source_again})
    plan.at(half, [this](Clock const& clock) { advance(0.5 * clock.dt); });
  plan.account([this](Ledger& ledger) { account(ledger); });
  Plan::Keep keep;  // the cells are the flow's
  keep.save = [] {};
  keep.restore = [this] { forget(); };
  keep.write = [](parallel::ArchiveWriter&) {};
  keep.read = [](parallel::ArchiveReader&) {};
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

void Gravity::advance(Real tau) {
  Real const half_square = 0.5 * norm2(g_) * tau * tau, whole = flow_.grid().cell_volume();
  for (Block& block : flow_.blocks()) {
    auto const [nx, ny, nz] = block.size();
    CellIndex const first = block.first();
    bool const cut = volume_.cuts(block.id());
    Real mass = 0, work = 0;  // plane by plane: short sums lose fewer digits than one long one
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j) {
        std::ptrdiff_t const at = block.at(0, j, k);
        Real const* const density = block.component(0) + at;
        Real *const mx = block.component(1) + at, *const my = block.component(2) + at,
                    *const mz = block.component(3) + at;
        Real* const energy = block.component(4) + at;
        Real row_mass = 0, row_work = 0;
        for (Index i = 0; i < nx; ++i) {
          Real const volume = cut ? volume_({first[0] + i, first[1] + j, first[2] + k}) : whole;
          Real const given = tau * (mx[i] * g_.x + my[i] * g_.y + mz[i] * g_.z) + half_square * density[i];
          mx[i] += tau * g_.x * density[i];
          my[i] += tau * g_.y * density[i];
          mz[i] += tau * g_.z * density[i];
          energy[i] += given;
          row_mass += volume * density[i];
          row_work += volume * given;
        }
        mass += row_mass;
        work += row_work;
      }
    for (std::size_t d = 0; d < 3; ++d) impulse_[d].add(tau * mass * g_[static_cast<int>(d)]);
    impulse_size_.add(tau * mass * norm(g_));
    work_.add(work);
    work_size_.add(std::abs(work));
  }
}

void Gravity::account(Ledger& ledger) {
  for (std::size_t d = 0; d < 3; ++d)
    ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), impulse_[d]);
  ledger.add(Entry::pressure_impulse, impulse_size_);
  ledger.add(Entry::in_energy, work_);
  ledger.add(Entry::fluid_in_energy, work_);
  ledger.add(Entry::exchanged_energy, work_size_);
  forget();
}

void Gravity::forget() {
  impulse_ = {};
  impulse_size_ = work_ = work_size_ = {};
}

}  // namespace brisance::fluid
