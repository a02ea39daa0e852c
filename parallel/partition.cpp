#include "parallel/partition.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <csignal>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

#include "parallel/error.hpp"

namespace brisance::parallel {
namespace {

constexpr idx_t seed = 20230501;
constexpr double wanted_imbalance = 1.03;  // what METIS aims at by default

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

/// METIS replaces the handlers of SIGTERM and SIGABRT while it runs. A request to stop waits until ours are back.
class SignalGuard {
 public:
  SignalGuard() {
    sigset_t held;
    sigemptyset(&held);
    sigaddset(&held, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &held, &mask_);
    sigaction(SIGTERM, nullptr, &terminate_);
    sigaction(SIGABRT, nullptr, &abort_);
  }
  ~SignalGuard() {
    sigaction(SIGTERM, &terminate_, nullptr);
    sigaction(SIGABRT, &abort_, nullptr);
    pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }
  SignalGuard(SignalGuard const&) = delete;
  SignalGuard& operator=(SignalGuard const&) = delete;

 private:
  sigset_t mask_{};
  struct sigaction terminate_ {
  }, abort_{};
};

/// Weights in the integers of METIS. METIS adds them up, so a set whose total is too large is scaled down as a whole; a
/// positive weight stays positive.
std::vector<idx_t> scaled(std::vector<std::int64_t> const& weights, std::size_t stride, std::size_t offset) {
  double total = 0;
  for (std::size_t k = offset; k < weights.size(); k += stride) total += static_cast<double>(weights[k]);
  double const largest_total = static_cast<double>(std::numeric_limits<idx_t>::max() / 4);
  double const scale = total > largest_total ? largest_total / total : 1.0;
  std::vector<idx_t> result;
  for (std::size_t k = offset; k < weights.size(); k += stride) {
    auto const reduced = static_cast<idx_t>(static_cast<double>(weights[k]) * scale);
    result.push_back(weights[k] > 0 ? std::max<idx_t>(reduced, 1) : 0);
  }
  return result;
}

std::vector<idx_t> narrowed(std::vector<std::int64_t> const& values) {
  require(values.size() < at(std::numeric_limits<idx_t>::max()), Failure::system,
          fmt::format("the partition graph has {} entries, more than METIS numbers. Use larger blocks (fluid.block).",
                      values.size()));
  std::vector<idx_t> result;
  result.reserve(values.size());
  for (std::int64_t const v : values) result.push_back(static_cast<idx_t>(v));
  return result;
}

/// Constraints without any weight are left out: they ask for nothing.
std::vector<idx_t> vertex_weights(Graph const& graph, idx_t& constraints) {
  std::vector<std::vector<idx_t>> kept;
  auto const stride = at(graph.constraints);
  for (std::size_t c = 0; c != stride; ++c) {
    std::vector<idx_t> weights = scaled(graph.vertex_weight, stride, c);
    if (std::any_of(weights.begin(), weights.end(), [](idx_t w) { return w != 0; })) kept.push_back(std::move(weights));
  }
  if (kept.empty()) kept.emplace_back(graph.vertices(), 1);
  constraints = static_cast<idx_t>(kept.size());
  std::vector<idx_t> joined;
  joined.reserve(graph.vertices() * kept.size());
  for (std::size_t v = 0; v != graph.vertices(); ++v)
    for (auto const& weights : kept) joined.push_back(weights[v]);
  return joined;
}

std::vector<int> metis(Graph const& graph, int parts) {
  std::vector<idx_t> first = narrowed(graph.first), neighbour = narrowed(graph.neighbour);
  std::vector<idx_t> edges = scaled(graph.edge_weight, 1, 0);
  for (idx_t& weight : edges) weight = std::max<idx_t>(weight, 1);  // METIS takes no edge for free
  idx_t vertices = static_cast<idx_t>(graph.vertices()), constraints = 0, count = parts, cut = 0;
  std::vector<idx_t> weights = vertex_weights(graph, constraints), owner(graph.vertices());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = seed;
  options[METIS_OPTION_NCUTS] = 4;
  SignalGuard const guard;
  int const status = METIS_PartGraphKway(&vertices, &constraints, first.data(), neighbour.data(), weights.data(),
                                         nullptr, edges.data(), &count, nullptr, nullptr, options, &cut, owner.data());
  require(status != METIS_ERROR_MEMORY, Failure::system,
          fmt::format("not enough memory to partition {} vertices. Use more nodes or larger blocks.", vertices));
  require(status == METIS_OK, Failure::internal,
          fmt::format("METIS refused a graph of {} vertices, {} edge ends, {} parts (code {})", vertices,
                      graph.neighbour.size(), parts, status));
  return {owner.begin(), owner.end()};
}

/// Moves single vertices to mend what METIS leaves: parts without a block, and the imbalance of coarse weights.
class Repair {
 public:
  Repair(Graph const& graph, int parts, std::int64_t blocks, std::vector<int>& owner)
      : graph_(graph), parts_(parts), blocks_(blocks), owner_(owner), constraints_(at(graph.constraints)) {
    load_.assign(at(parts) * constraints_, 0);
    blocks_of_.assign(at(parts), 0);
    mean_.assign(constraints_, 0);
    for (std::size_t v = 0; v != owner.size(); ++v) {
      for (std::size_t c = 0; c != constraints_; ++c) mean_[c] += static_cast<double>(weight(v, c)) / parts;
      account(v, owner[v], 1);
    }
  }

  /// Every part gets a block: from the heaviest part that has two, the one whose move cuts least.
  void give_blocks() {
    if (blocks_ <= 0) return;
    for (int poor = 0; poor != parts_; ++poor) {
      if (blocks_of_[at(poor)] != 0) continue;
      int donor = -1;
      for (int p = 0; p != parts_; ++p)
        if (blocks_of_[at(p)] > 1 && (donor < 0 || heaviest(p) > heaviest(donor))) donor = p;
      std::size_t best = 0;
      std::int64_t least = std::numeric_limits<std::int64_t>::max();
      for (std::size_t v = 0; v != at(blocks_); ++v) {
        if (owner_[v] != donor || cut_change(v, poor) >= least) continue;
        best = v;
        least = cut_change(v, poor);
      }
      move(best, poor);
    }
  }

  /// Lightens the heaviest part by one vertex, while that helps. Each move lowers the largest of two loads and raises
  /// the other to less than it was, so the sorted loads fall and the loop ends; the bound is for its cost.
  void balance() {
    for (int moves = 0; moves != 64 + 8 * parts_; ++moves)
      if (!lighten_heaviest()) return;
  }

  std::vector<double> imbalance() const {
    std::vector<double> result(constraints_, 1.0);
    for (std::size_t c = 0; c != constraints_; ++c)
      for (int p = 0; mean_[c] > 0 && p != parts_; ++p) result[c] = std::max(result[c], load(p, c));
    return result;
  }

 private:
  struct Move {
    double load = 0;  // the larger load of the two parts afterwards
    std::int64_t cut = 0;
    std::size_t vertex = 0;
    int to = -1;
  };

  bool lighten_heaviest() {
    int heavy = 0;
    for (int p = 1; p != parts_; ++p)
      if (heaviest(p) > heaviest(heavy)) heavy = p;
    double const before = heaviest(heavy);
    if (before <= wanted_imbalance) return false;
    std::size_t c = 0;
    for (std::size_t k = 1; k != constraints_; ++k)
      if (load(heavy, k) > load(heavy, c)) c = k;
    Move best;
    for (std::size_t v = 0; v != owner_.size(); ++v) {
      bool const last_block = static_cast<std::int64_t>(v) < blocks_ && blocks_of_[at(heavy)] == 1;
      if (owner_[v] != heavy || weight(v, c) == 0 || last_block) continue;
      for (int to = 0; to != parts_; ++to) {
        double const after = std::max(load_with(to, v), load(heavy, c) - share(v, c));
        if (to == heavy || after >= before || (best.to >= 0 && after > best.load)) continue;
        Move const candidate{after, cut_change(v, to), v, to};
        if (best.to < 0 || candidate.load < best.load || candidate.cut < best.cut) best = candidate;
      }
    }
    if (best.to < 0) return false;
    move(best.vertex, best.to);
    return true;
  }

  std::int64_t weight(std::size_t v, std::size_t c) const { return graph_.vertex_weight[v * constraints_ + c]; }
  double share(std::size_t v, std::size_t c) const {
    return mean_[c] > 0 ? static_cast<double>(weight(v, c)) / mean_[c] : 0.0;
  }
  /// Relative to the mean part.
  double load(int p, std::size_t c) const {
    return mean_[c] > 0 ? static_cast<double>(load_[at(p) * constraints_ + c]) / mean_[c] : 0.0;
  }
  double heaviest(int p) const {
    double largest = 0;
    for (std::size_t c = 0; c != constraints_; ++c) largest = std::max(largest, load(p, c));
    return largest;
  }
  double load_with(int p, std::size_t v) const {
    double largest = 0;
    for (std::size_t c = 0; c != constraints_; ++c) largest = std::max(largest, load(p, c) + share(v, c));
    return largest;
  }
  std::int64_t cut_change(std::size_t v, int to) const {
    std::int64_t change = 0;
    for (std::size_t e = at(graph_.first[v]); e != at(graph_.first[v + 1]); ++e) {
      int const other = owner_[at(graph_.neighbour[e])];
      if (other == owner_[v]) change += graph_.edge_weight[e];
      if (other == to) change -= graph_.edge_weight[e];
    }
    return change;
  }
  void account(std::size_t v, int part, int sign) {
    for (std::size_t c = 0; c != constraints_; ++c) load_[at(part) * constraints_ + c] += sign * weight(v, c);
    if (static_cast<std::int64_t>(v) < blocks_) blocks_of_[at(part)] += sign;
  }
  void move(std::size_t v, int to) {
    account(v, owner_[v], -1);
    owner_[v] = to;
    account(v, to, 1);
  }

  Graph const& graph_;
  int parts_;
  std::int64_t blocks_;
  std::vector<int>& owner_;
  std::size_t constraints_;
  std::vector<std::int64_t> load_, blocks_of_;
  std::vector<double> mean_;
};

std::int64_t edge_cut(Graph const& graph, std::vector<int> const& owner) {
  std::int64_t twice = 0;
  for (std::size_t v = 0; v != owner.size(); ++v)
    for (std::size_t e = at(graph.first[v]); e != at(graph.first[v + 1]); ++e)
      if (owner[at(graph.neighbour[e])] != owner[v]) twice += graph.edge_weight[e];
  return twice / 2;
}

}  // namespace

Partition partition(Graph const& graph, int parts, std::int64_t must_own_first) {
  require(must_own_first <= 0 || must_own_first >= parts, Failure::scene,
          fmt::format("{} ranks for {} blocks: every rank needs a block. Use at most {} ranks, or smaller blocks "
                      "(fluid.block).",
                      parts, must_own_first, must_own_first));
  Partition result;
  result.owner.assign(graph.vertices(), 0);
  if (parts > 1 && graph.vertices() > 0) result.owner = metis(graph, parts);
  Repair repair(graph, parts, must_own_first, result.owner);
  repair.give_blocks();
  repair.balance();
  result.imbalance = repair.imbalance();
  result.edge_cut = edge_cut(graph, result.owner);
  return result;
}

}  // namespace brisance::parallel
