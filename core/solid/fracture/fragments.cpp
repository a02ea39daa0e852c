#include "core/solid/fracture/fragments.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Sets joined pairwise.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index root(Index a) {
    while (parent_[at(a)] != a) a = parent_[at(a)] = parent_[at(parent_[at(a)])];
    return a;
  }
  void join(Index a, Index b) {
    a = root(a), b = root(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace

void Fragments::find(Solid& solid, parallel::Comm& comm) {
  Index const n = solid.count();
  UnionFind sets(at(n));
  LinkStore const& links = solid.link_store();
  for (std::size_t k = 0; k < links.count(); ++k)
    if (Index const j = solid.end_j(k); j < n && solid.intact(k) > 0) sets.join(links.end_i(k), j);
  std::vector<GlobalId> smallest(at(n));  // of the set of a root
  for (Index p = 0; p < n; ++p) smallest[at(p)] = solid.id(p);
  for (Index p = 0; p < n; ++p) {
    GlobalId& of_set = smallest[at(sets.root(p))];
    of_set = std::min(of_set, solid.id(p));
  }
  // Ghosts carry the smallest id their owner knows of; it spreads by one rank a round. Ids are exact as doubles.
  std::vector<double> known(at(n));
  for (std::uint64_t changed = 1; changed != 0;) {
    for (Index p = 0; p < n; ++p) known[at(p)] = static_cast<double>(smallest[at(sets.root(p))]);
    solid.exchange_rows(known, 1);
    changed = 0;
    for (Index g = solid.owned(); g < n; ++g) {
      GlobalId& of_set = smallest[at(sets.root(g))];
      auto const told = static_cast<GlobalId>(known[at(g)]);
      if (told < of_set) of_set = told, changed = 1;
    }
    comm.bit_or(std::span(&changed, 1));
  }
  label_.resize(at(n));
  for (Index p = 0; p < n; ++p) label_[at(p)] = smallest[at(sets.root(p))];
  shared_.assign(label_.begin() + solid.owned(), label_.end());
  std::sort(shared_.begin(), shared_.end());
  shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
  separated_.resize(at(solid.owned()), never);
  count_particles(solid, comm);
}

void Fragments::count_particles(Solid const& solid, parallel::Comm& comm) {
  std::map<GlobalId, std::int64_t> here;
  for (Index p = 0; p < solid.owned(); ++p) ++here[label_[at(p)]];
  // Fragments that reach further are counted by the owner of the particle that names them.
  struct Count {
    GlobalId label;
    std::int64_t particles;
  };
  auto const send = [&](std::map<int, parallel::Message>& to, int rank, Count const& count) {
    parallel::Message& m = to[rank];
    m.rank = rank;
    parallel::put(m.data, count);
  };
  auto const deliver = [&](std::map<int, parallel::Message>& to) {
    std::vector<parallel::Message> outgoing;
    for (auto& [rank, message] : to) outgoing.push_back(std::move(message));
    return comm.deliver(std::move(outgoing));
  };
  std::map<int, parallel::Message> questions, answers;
  for (GlobalId const label : shared_)
    if (auto const found = here.find(label); found != here.end())
      send(questions, solid.owner(label), {label, found->second});
  std::map<GlobalId, std::int64_t> total;
  auto const asked = deliver(questions);
  for (parallel::Message const& message : asked)
    for (std::span<std::byte const> in(message.data); !in.empty();) {
      auto const count = parallel::take<Count>(in);
      total[count.label] += count.particles;
    }
  for (parallel::Message const& message : asked)
    for (std::span<std::byte const> in(message.data); !in.empty();) {
      auto const count = parallel::take<Count>(in);
      send(answers, message.rank, {count.label, total[count.label]});
    }
  for (parallel::Message const& message : deliver(answers))
    for (std::span<std::byte const> in(message.data); !in.empty();) {
      auto const count = parallel::take<Count>(in);
      here[count.label] = count.particles;
    }
  size_.resize(at(solid.owned()));
  for (Index p = 0; p < solid.owned(); ++p) size_[at(p)] = here[label_[at(p)]];
}

void Fragments::update(Solid& solid, parallel::Comm& comm, Real time) {
  std::vector<std::int64_t> const before = size_;
  find(solid, comm);
  // Fragments only ever lose particles: one that has lost none is the one it was.
  for (std::size_t p = 0; p < before.size(); ++p)
    if (size_[p] < before[p]) separated_[p] = time;
}

}  // namespace brisance::solid
