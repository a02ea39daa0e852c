#include "core/model/row_sampler.hpp"

#include <gtest/gtest.h>

namespace brisance {
namespace {

TEST(RowSampler, RowsAreLinearBetweenStepsAndDoNotDependOnThem) {
  // Values linear in time give the same file for any steps.
  auto file = [](std::vector<Real> const& times) {
    RowSampler sampler({"a", "b"}, 0.25);
    std::string rows;
    for (Real const t : times) {
      std::array<Real, 2> const values{2 * t, 1 - t};
      if (sampler.started())
        sampler.add(t, values, rows);
      else
        sampler.start(t, values, rows);
    }
    EXPECT_EQ(sampler.highest()[0], 2 * times.back());
    EXPECT_EQ(sampler.lowest()[1], 1 - times.back());
    return sampler.header() + rows;
  };
  std::string const expected = "time,a,b\n0,0,1\n0.25,0.5,0.75\n0.5,1,0.5\n0.75,1.5,0.25\n";
  EXPECT_EQ(file({0, 0.1, 0.3, 0.8}), expected);
  EXPECT_EQ(file({0, 0.75}), expected);
}

TEST(RowSampler, GoesOnWhereACheckpointLeftIt) {
  std::array<Real, 1> const zero{0}, two{2}, four{4};
  RowSampler through({"x"}, 1), other({"x"}, 2), again({"x"}, 1);
  std::string rows, rest;
  through.start(0, zero, rows);
  through.add(1.5, two, rows);
  auto const stored = through.store();
  EXPECT_FALSE(other.restore(stored));
  ASSERT_TRUE(again.restore(stored));
  std::string const file = through.header() + rows + "2,9\n3,9\n4,";
  EXPECT_EQ(again.kept_rows(file), rows);
  EXPECT_EQ(again.kept_rows("time,y\n0,0\n"), "");
  through.add(3, four, rows);
  again.add(3, four, rest);
  EXPECT_EQ(rows, "0,0\n1,1.333333333\n2,2.666666667\n3,4\n");
  EXPECT_EQ(rest, "2,2.666666667\n3,4\n");
}

}  // namespace
}  // namespace brisance
