// Balanced owners for the vertices of a weighted graph (METIS k-way); the same answer on every rank.
#pragma once
#include <cstdint>
#include <vector>

namespace brisance::parallel {

/// Undirected graph in compressed rows; each edge appears at both ends with equal weight.
struct Graph {
  int constraints = 1;              ///< weights per vertex, balanced apart
  std::vector<std::int64_t> first;  ///< size vertices + 1
  std::vector<std::int64_t> neighbour;
  std::vector<std::int64_t> edge_weight;
  std::vector<std::int64_t> vertex_weight;  ///< vertices x constraints
  std::size_t vertices() const { return first.size() - 1; }
};
struct Partition {
  std::vector<int> owner;         ///< per vertex
  std::vector<double> imbalance;  ///< per constraint: largest part over mean part
  std::int64_t edge_cut = 0;
};

/// Fixed seed: every rank computes the same owners without a message. `must_own_first` > 0: every part is given at
/// least one of the first `must_own_first` vertices (the fluid blocks), by a deterministic repair when METIS leaves a
/// part without any.
Partition partition(Graph const& graph, int parts, std::int64_t must_own_first);

}  // namespace brisance::parallel
