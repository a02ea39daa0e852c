// What fracture keeps: histories of softening links and the times at which fragments came off.
#include <algorithm>
#include <memory>
#include <utility>

#include "core/solid/fracture/fracture.hpp"
#include "core/solid/rows.hpp"

namespace brisance::solid {
namespace {

constexpr std::uint32_t cohesive_kind = 0x434f4845;  // "COHE"
constexpr int history_columns = 4;

}  // namespace

/// Rows of the links whose first end is owned, in the order of Solid::owned_link_ids; zero for links of other laws.
std::vector<double> Fracture::pack_history() const {
  std::vector<double> rows;
  std::vector<CohesiveHistory> of(solid_.links());
  for (LawGroup const& group : groups_)
    for (std::size_t n = 0; n < group.history.size(); ++n) of[group.links[n]] = group.history[n];
  for (std::size_t k = 0; k < of.size(); ++k)
    if (solid_.link_store().end_i(k) < solid_.owned())
      rows.insert(rows.end(), {of[k].largest, of[k].onset, of[k].end, of[k].peak});
  return rows;
}

void Fracture::unpack_history(std::span<double const> rows) {
  for (LawGroup& group : groups_)
    for (std::size_t n = 0; n < group.history.size(); ++n) {
      double const* row = rows.data() + history_columns * group.links[n];
      group.history[n] = {row[0], row[1], row[2], row[3]};
    }
}

void Fracture::keep(Plan& plan) {
  struct Saved {
    std::vector<std::vector<CohesiveHistory>> history;
    std::shared_ptr<Fragments const> fragments;
    std::size_t broken_seen = 0;
  };
  auto const saved = std::make_shared<Saved>();
  bool const soft = std::any_of(groups_.begin(), groups_.end(),
                                [](LawGroup const& g) { return std::holds_alternative<Cohesive>(g.criterion); });
  Plan::Keep keep;
  keep.save = [this, saved] {
    if (std::exchange(history_changed_, false)) {
      saved->history.resize(groups_.size());
      for (std::size_t g = 0; g < groups_.size(); ++g) saved->history[g] = groups_[g].history;
    }
    saved->fragments = fragments_;
    saved->broken_seen = broken_seen_;
  };
  keep.restore = [this, saved] {
    for (std::size_t g = 0; g < groups_.size(); ++g) groups_[g].history = saved->history[g];
    fragments_ = saved->fragments;
    broken_seen_ = saved->broken_seen;
    dissipated_ = {};  // an account was taken where the pair began
    links_broken_ = 0;
    to_book_ = false;
  };
  keep.write = [this, soft](parallel::ArchiveWriter& file) {
    file.rows("solid/fracture/separated", solid_.mesh().size(), 1, rows_of(solid_.owned_ids()),
              fragments_->separated());
    if (soft)
      file.rows("solid/fracture/cohesive", static_cast<std::int64_t>(solid_.mesh().links.size()), history_columns,
                rows_of(solid_.owned_link_ids()), pack_history());
  };
  keep.read = [this, soft](parallel::ArchiveReader& file) {
    auto read = std::make_shared<Fragments>();
    read->set_separated(file.rows("solid/fracture/separated", 1, rows_of(solid_.owned_ids())));
    fragments_ = std::move(read);
    broken_seen_ = solid_.broken();
    if (!soft) return;
    std::vector<GlobalId> links;
    for (std::size_t k = 0; k < solid_.links(); ++k) links.push_back(static_cast<GlobalId>(solid_.mesh_link(k)));
    history_changed_ = true;
    unpack_history(file.rows("solid/fracture/cohesive", history_columns, rows_of(links)));
  };
  keep.digest = [this](parallel::Digest& digest) {
    for (LawGroup const& group : groups_)
      for (std::size_t n = 0; n < group.history.size(); ++n) {
        CohesiveHistory const& h = group.history[n];
        if (h.end == 0 || solid_.link_store().end_i(group.links[n]) >= solid_.owned()) continue;
        std::array<double, history_columns> const bits{h.largest, h.onset, h.end, h.peak};
        digest.add(cohesive_kind, static_cast<GlobalId>(solid_.mesh_link(group.links[n])), bits);
      }
  };
  plan.keep(std::move(keep));
}

}  // namespace brisance::solid
