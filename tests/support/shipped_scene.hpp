// The scenes of jobs/scenes, for tests that check their figures.
#pragma once
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/coupled_case.hpp"

namespace brisance::testing {

/// The text of jobs/scenes/NAME.toml. Files that it names by relative paths are not found from a test.
inline std::string shipped_scene(std::string const& name) {
  std::string const path = BRISANCE_SOURCE_DIR "/jobs/scenes/" + name + ".toml";
  std::ifstream file(path);
  EXPECT_TRUE(file.good()) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace brisance::testing
