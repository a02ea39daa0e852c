#include "drivers/times.hpp"

#include <gtest/gtest.h>

#include "parallel/error.hpp"

namespace brisance::drivers {
namespace {

TEST(Walltime, AsPeopleAndBatchSystemsWriteIt) {
  EXPECT_EQ(parse_walltime("--walltime", "1h50m"), 6600);
  EXPECT_EQ(parse_walltime("--walltime", "1 h 50 min"), 6600);
  EXPECT_EQ(parse_walltime("--walltime", "1d 2h"), 93600);
  EXPECT_EQ(parse_walltime("--walltime", "45m"), 2700);
  EXPECT_EQ(parse_walltime("--walltime", "1.5h"), 5400);
  EXPECT_EQ(parse_walltime("--walltime", "90 s"), 90);
  EXPECT_EQ(parse_walltime("--walltime", "90"), 90);
  EXPECT_EQ(parse_walltime("--walltime", "1:50:00"), 6600);
  EXPECT_EQ(parse_walltime("--walltime", "50:30"), 3030);
}

TEST(Walltime, RefusesTheRest) {
  for (char const* text : {"", "soon", "1x", "1h50", "1:2:3:4", "1:", "-5s", "h"})
    EXPECT_THROW(parse_walltime("--walltime", text), Error) << text;
}

TEST(Time, HasUnits) {
  EXPECT_EQ(parse_time("--until", "0.4 ms"), 4e-4);
  EXPECT_EQ(parse_time("--until", "2e-3"), 2e-3);
  try {
    parse_time("--until", "1 kg");
    FAIL();
  } catch (Error const& error) {
    EXPECT_STREQ(error.what(), "--until \"1 kg\": 'kg' has the wrong dimension; expected a time such as \"1 ms\"");
  }
  EXPECT_THROW(parse_time("--until", "-1 ms"), Error);
}

}  // namespace
}  // namespace brisance::drivers
