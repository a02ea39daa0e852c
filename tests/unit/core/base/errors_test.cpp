#include "core/base/errors.hpp"

#include <gtest/gtest.h>

namespace brisance {
namespace {

TEST(EditDistance, CountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("order", "order"), 0);
  EXPECT_EQ(edit_distance("ordre", "order"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(Nearest, TakesTheFirstOfEquals) {
  EXPECT_EQ(nearest("densiti", {"pressure", "density", "velocity"}), "density");
  EXPECT_EQ(nearest("x", {"a", "b"}), "a");
  EXPECT_EQ(nearest("x", {}), "");
}

TEST(SceneError, NamesThePlace) {
  try {
    scene_error({"blast.toml", 6, 9}, "no");
    FAIL();
  } catch (Error const& error) {
    EXPECT_STREQ(error.what(), "blast.toml:6:9: no");
    EXPECT_EQ(error.exit_code(), 2);
  }
}

}  // namespace
}  // namespace brisance
