#include "parallel/partition.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <random>

#include "parallel/digest.hpp"
#include "parallel/error.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::parallel {
namespace {

using testing::comm;

struct Edge {
  std::int64_t a, b, weight;
};

Graph graph_of(std::size_t vertices, std::vector<Edge> const& edges, int constraints,
               std::vector<std::int64_t> weights) {
  std::vector<std::vector<std::array<std::int64_t, 2>>> rows(vertices);
  for (Edge const& e : edges) {
    rows[static_cast<std::size_t>(e.a)].push_back({e.b, e.weight});
    rows[static_cast<std::size_t>(e.b)].push_back({e.a, e.weight});
  }
  Graph graph;
  graph.constraints = constraints;
  graph.vertex_weight = std::move(weights);
  graph.first = {0};
  for (auto const& row : rows) {
    for (auto const& [to, weight] : row) {
      graph.neighbour.push_back(to);
      graph.edge_weight.push_back(weight);
    }
    graph.first.push_back(static_cast<std::int64_t>(graph.neighbour.size()));
  }
  return graph;
}

std::vector<Edge> box_edges(std::int64_t nx, std::int64_t ny, std::int64_t nz, std::int64_t weight,
                            std::int64_t offset = 0) {
  std::vector<Edge> edges;
  for (std::int64_t z = 0; z != nz; ++z)
    for (std::int64_t y = 0; y != ny; ++y)
      for (std::int64_t x = 0; x != nx; ++x) {
        std::int64_t const v = offset + x + nx * (y + ny * z);
        if (x + 1 != nx) edges.push_back({v, v + 1, weight});
        if (y + 1 != ny) edges.push_back({v, v + nx, weight});
        if (z + 1 != nz) edges.push_back({v, v + nx * ny, weight});
      }
  return edges;
}

/// Blocks of a box, and a ball of particles tied to a few of them.
Graph blocks_and_particles() {
  std::vector<Edge> edges = box_edges(6, 6, 6, 48 * 48 * 6 * 40);
  auto const particles = box_edges(8, 8, 8, 120, 216);
  edges.insert(edges.end(), particles.begin(), particles.end());
  for (std::int64_t k = 0; k != 64; ++k) edges.push_back({216 + k, 100 + k % 3, 480});
  std::vector<std::int64_t> weights;
  for (std::int64_t k = 0; k != 216; ++k) weights.insert(weights.end(), {48 * 48 * 48 + (k % 7) * 20000, 0});
  for (std::int64_t k = 0; k != 512; ++k) weights.insert(weights.end(), {0, 6 + 5 * (k % 3)});
  return graph_of(216 + 512, edges, 2, weights);
}

void expect_sound(Graph const& graph, Partition const& p, int parts, std::int64_t blocks) {
  ASSERT_EQ(p.owner.size(), graph.vertices());
  std::vector<std::int64_t> owned(static_cast<std::size_t>(parts));
  std::vector<double> load(static_cast<std::size_t>(parts * graph.constraints)),
      total(static_cast<std::size_t>(graph.constraints));
  std::int64_t cut = 0;
  for (std::size_t v = 0; v != p.owner.size(); ++v) {
    ASSERT_GE(p.owner[v], 0);
    ASSERT_LT(p.owner[v], parts);
    if (static_cast<std::int64_t>(v) < blocks) ++owned[static_cast<std::size_t>(p.owner[v])];
    for (int c = 0; c != graph.constraints; ++c) {
      auto const w = static_cast<double>(
          graph.vertex_weight[v * static_cast<std::size_t>(graph.constraints) + static_cast<std::size_t>(c)]);
      load[static_cast<std::size_t>(p.owner[v] * graph.constraints + c)] += w;
      total[static_cast<std::size_t>(c)] += w;
    }
    for (auto e = graph.first[v]; e != graph.first[v + 1]; ++e) {
      auto const other = static_cast<std::size_t>(graph.neighbour[static_cast<std::size_t>(e)]);
      if (other > v && p.owner[other] != p.owner[v]) cut += graph.edge_weight[static_cast<std::size_t>(e)];
    }
  }
  EXPECT_EQ(p.edge_cut, cut);
  if (blocks > 0) {
    EXPECT_GE(*std::min_element(owned.begin(), owned.end()), 1);
  }
  for (int c = 0; c != graph.constraints; ++c) {
    double largest = 0;
    for (int q = 0; q != parts; ++q)
      largest = std::max(largest, load[static_cast<std::size_t>(q * graph.constraints + c)]);
    double const mean = total[static_cast<std::size_t>(c)] / parts;
    EXPECT_NEAR(p.imbalance[static_cast<std::size_t>(c)], mean > 0 ? largest / mean : 1.0, 1e-12);
  }
}

TEST(Partition, BalancesBlocksAndParticlesApart) {
  Graph const graph = blocks_and_particles();
  for (int const parts : {1, 2, 3, 4, 7, 16}) {
    Partition const p = partition(graph, parts, 216);
    expect_sound(graph, p, parts, 216);
    // A part of 16 has 13 blocks of unequal weight: one block too many is 1.08.
    EXPECT_LE(p.imbalance[0], 1.08) << parts;
    EXPECT_LE(p.imbalance[1], 1.08) << parts;
  }
}

TEST(Partition, CutsABoxAsABoxShouldBeCut) {
  Graph const graph = graph_of(1000, box_edges(10, 10, 10, 1), 1, std::vector<std::int64_t>(1000, 1));
  Partition const two = partition(graph, 2, 1000), four = partition(graph, 4, 1000);
  EXPECT_LE(two.edge_cut, 120);   // a plane cuts 100
  EXPECT_LE(four.edge_cut, 240);  // two planes cut 200
}

TEST(Partition, SmallNumbersOfBlocksComeOutAsEvenAsTheyCan) {
  for (int nx = 2; nx != 8; ++nx)
    for (int ny = 1; ny != 6; ++ny)
      for (int const parts : {2, 3, 4}) {
        std::int64_t const n = nx * ny;
        if (n < parts) continue;
        Graph const graph = graph_of(static_cast<std::size_t>(n), box_edges(nx, ny, 1, 64 * 12), 1,
                                     std::vector<std::int64_t>(static_cast<std::size_t>(n), 4096));
        Partition const p = partition(graph, parts, n);
        expect_sound(graph, p, parts, n);
        double const best = static_cast<double>((n + parts - 1) / parts) * parts / static_cast<double>(n);
        EXPECT_LE(p.imbalance[0], std::max(best, 1.03) + 1e-12) << nx << "x" << ny << " on " << parts;
      }
}

TEST(Partition, EveryPartOwnsABlockEvenWhenParticlesOutweighThem) {
  // Five blocks in a row, all particles tied to the first: nothing but the rule gives the other parts a block.
  std::vector<Edge> edges = box_edges(5, 1, 1, 1000000);
  std::vector<std::int64_t> weights(5, 1);
  for (std::int64_t k = 0; k != 400; ++k) {
    edges.push_back({0, 5 + k, 1});
    if (k > 0) edges.push_back({4 + k, 5 + k, 5});
    weights.push_back(50);
  }
  Graph const graph = graph_of(405, edges, 1, weights);
  for (int const parts : {2, 3, 4, 5}) expect_sound(graph, partition(graph, parts, 5), parts, 5);
}

TEST(Partition, OneBlockPerPartIsPossible) {
  Graph const graph = graph_of(4, box_edges(2, 2, 1, 10), 1, {5, 5, 5, 5});
  Partition const p = partition(graph, 4, 4);
  EXPECT_DOUBLE_EQ(p.imbalance[0], 1.0);
  EXPECT_EQ(p.edge_cut, 40);
}

TEST(Partition, MorePartsThanBlocksIsASceneError) {
  Graph const graph = graph_of(3, box_edges(3, 1, 1, 1), 1, {1, 1, 1});
  try {
    partition(graph, 4, 3);
    FAIL();
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::scene);
  }
}

TEST(Partition, TakesWeightsBeyondTheIntegersOfMetis) {
  std::int64_t const huge = std::int64_t{1} << 45;
  std::vector<std::int64_t> weights;
  for (std::int64_t k = 0; k != 512; ++k) weights.insert(weights.end(), {huge + k, k % 64 == 0 ? huge / 1000 : 1});
  Graph const graph = graph_of(512, box_edges(8, 8, 8, huge), 2, weights);
  Partition const p = partition(graph, 4, 512);
  expect_sound(graph, p, 4, 512);
  EXPECT_LE(p.imbalance[0], 1.05);
  EXPECT_LE(p.imbalance[1], 1.05);
}

TEST(Partition, GraphsWithoutEdgesWeightsOrVerticesAreFine) {
  Graph const loose = graph_of(40, {}, 1, std::vector<std::int64_t>(40, 3));
  expect_sound(loose, partition(loose, 3, 40), 3, 40);
  Graph const weightless = graph_of(20, box_edges(20, 1, 1, 0), 2, std::vector<std::int64_t>(40, 0));
  expect_sound(weightless, partition(weightless, 3, 20), 3, 20);
  Graph const empty = graph_of(0, {}, 1, {});
  EXPECT_TRUE(partition(empty, 3, 0).owner.empty());
}

TEST(Partition, EveryRankAndEveryCallGivesTheSameOwners) {
  Graph const graph = blocks_and_particles();
  Partition const p = partition(graph, 5, 216);
  std::srand(static_cast<unsigned>(comm().rank()));  // METIS draws from a shared generator; its seed must win
  EXPECT_EQ(partition(graph, 5, 216).owner, p.owner);
  Bytes mine;
  for (int const owner : p.owner) put(mine, owner);
  for (Bytes const& other : comm().all_gather(mine)) EXPECT_EQ(other, mine);
}

TEST(Partition, LeavesTheSignalHandlersAlone) {
  struct sigaction ours {
  }, after{};
  ours.sa_sigaction = [](int, siginfo_t*, void*) {};
  ours.sa_flags = SA_SIGINFO;
  struct sigaction before {};
  sigaction(SIGTERM, &ours, &before);
  partition(blocks_and_particles(), 3, 216);
  sigaction(SIGTERM, &before, &after);
  EXPECT_EQ(after.sa_sigaction, ours.sa_sigaction);
  EXPECT_TRUE(after.sa_flags & SA_SIGINFO);
}

}  // namespace
}  // namespace brisance::parallel
