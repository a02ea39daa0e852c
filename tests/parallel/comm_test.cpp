#include "parallel/comm.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "parallel/error.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::parallel {
namespace {

using testing::comm;
using Limits = std::numeric_limits<double>;

/// Both forms pass the same tests: the serial one runs on every rank by itself.
class EveryComm : public ::testing::TestWithParam<bool> {
 protected:
  EveryComm() : own_(serial()) {}
  Comm& it() { return GetParam() ? *own_ : comm(); }

 private:
  std::unique_ptr<Comm> own_;
};
INSTANTIATE_TEST_SUITE_P(Forms, EveryComm, ::testing::Bool(),
                         [](auto const& param) { return param.param ? "Serial" : "World"; });

Bytes bytes_of(std::vector<int> const& values) {
  Bytes data;
  for (int const v : values) put(data, v);
  return data;
}

std::vector<int> ints_of(Bytes const& data) {
  std::vector<int> values;
  for (std::span<std::byte const> in = data; !in.empty();) values.push_back(take<int>(in));
  return values;
}

TEST_P(EveryComm, ReducesElementWise) {
  double const r = it().rank(), n = it().size();
  double low[2] = {r, -r}, high[2] = {r, -r};
  it().min(low);
  it().max(high);
  EXPECT_EQ(low[0], 0.0);
  EXPECT_EQ(low[1], 1 - n);
  EXPECT_EQ(high[0], n - 1);
  std::int64_t counts[2] = {it().rank() + 1, std::int64_t{1} << 60};
  it().sum(std::span(counts, 1));
  EXPECT_EQ(counts[0], it().size() * (it().size() + 1) / 2);
  std::uint64_t flags = std::uint64_t{1} << it().rank();
  it().bit_or(std::span(&flags, 1));
  EXPECT_EQ(flags, (std::uint64_t{1} << it().size()) - 1);
}

TEST_P(EveryComm, ExtremesHaveOneAnswerForZerosNaNAndInfinity) {
  bool const last = it().rank() == it().size() - 1;
  double x[4] = {last ? -0.0 : 0.0, last ? Limits::quiet_NaN() : 1.0, last ? -Limits::infinity() : -1.0, -1e-310};
  it().min(x);
  EXPECT_TRUE(std::signbit(x[0]));
  EXPECT_TRUE(std::isnan(x[1]));
  EXPECT_EQ(x[2], -Limits::infinity());
  EXPECT_EQ(x[3], -1e-310);
  double y[3] = {last ? -0.0 : 0.0, last ? Limits::quiet_NaN() : 1.0, -5.0 - it().rank()};
  it().max(y);
  EXPECT_EQ(std::signbit(y[0]), it().size() == 1);
  EXPECT_TRUE(std::isnan(y[1]));
  EXPECT_EQ(y[2], -5.0);
}

TEST_P(EveryComm, ExactSumsHaveTheBitsOfOneRank) {
  std::mt19937_64 random(4);
  ExactSum alone[2], shared[2];
  for (int k = 0; k != 3000; ++k) {
    double const x =
        std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 1900) - 1000) * (k % 2 ? 1 : -1);
    alone[k % 2].add(x);
    if (static_cast<int>(random() % 97) % it().size() == it().rank()) shared[k % 2].add(x);
  }
  // Ranks hold disjoint shares only because every rank draws the same numbers.
  it().sum(shared);
  for (int k = 0; k != 2; ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(shared[k].value()), std::bit_cast<std::uint64_t>(alone[k].value()));
}

TEST_P(EveryComm, ExactSumsCancelAcrossRanksAndCarryPoison) {
  ExactSum sum[2];
  sum[0].add(it().rank() == 0 ? 1e300 : 0.0);
  sum[0].add(1.0);
  sum[0].add(it().rank() == it().size() - 1 ? -1e300 : 0.0);
  sum[1].add(it().rank() == it().size() - 1 ? Limits::quiet_NaN() : 1.0);
  it().sum(sum);
  EXPECT_EQ(sum[0].value(), it().size());
  EXPECT_TRUE(std::isnan(sum[1].value()));
}

TEST_P(EveryComm, DigestsAddModulo2To128) {
  Digest alone, shared;
  for (int id = 0; id != 500; ++id) {
    double const x = std::sqrt(id);
    alone.add(1, id, std::span(&x, 1));
    if (id * 7 % it().size() == it().rank()) shared.add(1, id, std::span(&x, 1));
  }
  it().sum(shared);
  EXPECT_EQ(shared, alone);
}

TEST_P(EveryComm, BroadcastsAndGathersAnySize) {
  int const last = it().size() - 1;
  Bytes data = it().rank() == last ? bytes_of({1, 2, 3}) : bytes_of({9});
  it().broadcast(data, last);
  EXPECT_EQ(ints_of(data), (std::vector<int>{1, 2, 3}));
  Bytes nothing;
  it().broadcast(nothing, 0);
  EXPECT_TRUE(nothing.empty());

  std::vector<int> const mine(static_cast<std::size_t>(it().rank()), it().rank());  // rank 0 sends nothing
  auto const at_root = it().gather(bytes_of(mine), last);
  auto const everywhere = it().all_gather(bytes_of(mine));
  EXPECT_EQ(at_root.size(), it().rank() == last ? static_cast<std::size_t>(it().size()) : 0u);
  for (std::size_t r = 0; r != at_root.size(); ++r)
    EXPECT_EQ(ints_of(at_root[r]), std::vector<int>(r, static_cast<int>(r)));
  ASSERT_EQ(everywhere.size(), static_cast<std::size_t>(it().size()));
  for (std::size_t r = 0; r != everywhere.size(); ++r)
    EXPECT_EQ(ints_of(everywhere[r]), std::vector<int>(r, static_cast<int>(r)));
}

TEST_P(EveryComm, DeliversSparseMessagesSortedBySource) {
  // Each rank writes to a few, oneself included, several times and out of order; the receiver knows the rule, MPI does
  // not.
  int const n = it().size();
  auto const count = [n](int from, int to) { return (3 * from + to) % 4 % (n + 1); };
  std::vector<Message> outgoing;
  for (int to = n - 1; to >= 0; --to)
    for (int k = 0; k != count(it().rank(), to); ++k)
      outgoing.push_back({to, bytes_of(std::vector<int>(static_cast<std::size_t>(100 * k), 10 * it().rank() + k))});
  for (int round = 0; round != 3; ++round) {
    auto const received = it().deliver(outgoing);
    std::size_t at = 0;
    for (int from = 0; from != n; ++from)
      for (int k = 0; k != count(from, it().rank()); ++k, ++at) {
        ASSERT_LT(at, received.size());
        EXPECT_EQ(received[at].rank, from);
        EXPECT_EQ(ints_of(received[at].data), std::vector<int>(static_cast<std::size_t>(100 * k), 10 * from + k));
      }
    EXPECT_EQ(at, received.size());
  }
  EXPECT_TRUE(it().deliver({}).empty());
  EXPECT_THROW(it().deliver({Message{n, {}}}), Error);
}

TEST_P(EveryComm, ExchangesHalosAroundARing) {
  int const n = it().size(), me = it().rank(), left = (me + n - 1) % n, right = (me + 1) % n;
  std::vector<double> const mine(5000, me + 0.5);  // beyond the eager limit: truly waits for its receiver
  std::vector<double> from_left(mine.size()), from_right(mine.size());
  Comm::Send const to_right[] = {{right, std::as_bytes(std::span(mine))}};
  Comm::Send const to_left[] = {{left, std::as_bytes(std::span(mine).first(10))}};
  Comm::Receive const at_left[] = {{left, std::as_writable_bytes(std::span(from_left))}};
  Comm::Receive const at_right[] = {{right, std::as_writable_bytes(std::span(from_right).first(10))}};
  auto first = it().start(to_right, at_left, 1);
  auto second = it().start(to_left, at_right, 2);  // two exchanges on their way, finished in the other order
  second->finish();
  first->finish();
  EXPECT_EQ(from_left, std::vector<double>(mine.size(), left + 0.5));
  EXPECT_EQ(from_right[9], right + 0.5);
  EXPECT_EQ(from_right[10], 0.0);
}

TEST_P(EveryComm, AnExchangeWithNobodyIsAllowed) {
  auto pending = it().start({}, {}, 3);
  pending->finish();
  it().barrier();
}

TEST(World, HasOneRankPerProcessAndTheSerialFormOne) {
  EXPECT_GE(comm().size(), 1);
  EXPECT_LT(comm().rank(), comm().size());
  EXPECT_NE(comm().native(), nullptr);
  EXPECT_EQ(serial()->size(), 1);
  EXPECT_EQ(serial()->native(), nullptr);
}

}  // namespace
}  // namespace brisance::parallel
