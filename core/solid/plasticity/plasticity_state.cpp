// What plasticity keeps: rejected pairs, checkpoints, the digest.
#include <algorithm>
#include <memory>

#include "core/solid/plasticity/plasticity.hpp"
#include "core/solid/rows.hpp"

namespace brisance::solid {
namespace {

constexpr std::uint32_t plastic_kind = 0x504c4153;  // "PLAS"

std::array<double, PlasticState::columns> row_of(PlasticState const& s) {
  return {s.strain.c[0], s.strain.c[1], s.strain.c[2], s.strain.c[3], s.strain.c[4],
          s.strain.c[5], s.p,           s.damage,      s.temperature, s.stored};
}

}  // namespace

std::vector<double> Plasticity::pack() const {
  std::vector<double> rows;
  rows.reserve(state_.size() * PlasticState::columns);
  for (PlasticState const& s : state_) {
    auto const r = row_of(s);
    rows.insert(rows.end(), r.begin(), r.end());
  }
  return rows;
}

void Plasticity::unpack(std::span<double const> rows) {
  overstrained_ = -1;
  for (std::size_t p = 0; p < state_.size(); ++p) {
    double const* in = rows.data() + p * PlasticState::columns;
    std::copy_n(in, 6, state_[p].strain.c.begin());
    state_[p].p = in[6], state_[p].damage = in[7], state_[p].temperature = in[8], state_[p].stored = in[9];
  }
}

void Plasticity::keep(Plan& plan) {
  struct Saved {
    std::vector<PlasticState> state;
    std::vector<Symmetric> stress;
  };
  auto saved = std::make_shared<Saved>();
  Plan::Keep keep;
  keep.save = [this, saved] {
    saved->state = state_;
    saved->stress = stress_;
  };
  keep.restore = [this, saved] {
    overstrained_ = -1;
    state_ = saved->state;
    stress_ = saved->stress;
    for (Index p = 0; p < solid_.owned(); ++p) set_threshold(p);
    yielding_.clear();
    dissipated_ = {};
    links_broken_ = 0;
    spread();
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    file.rows("solid/plasticity", solid_.mesh().size(), PlasticState::columns, rows_of(solid_.owned_ids()), pack());
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    unpack(file.rows("solid/plasticity", PlasticState::columns, rows_of(solid_.owned_ids())));
    spread();  // the driving stress follows in start
  };
  keep.digest = [this](parallel::Digest& digest) {
    for (std::size_t p = 0; p < state_.size(); ++p)
      digest.add(plastic_kind, solid_.id(static_cast<Index>(p)), row_of(state_[p]));
  };
  plan.keep(std::move(keep));
}

}  // namespace brisance::solid
