#include "drivers/scene.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/errors.hpp"

namespace brisance::drivers {
namespace {

std::string written(std::string const& name, std::string const& text) {
  std::string const path = ::testing::TempDir() + name;
  std::ofstream(path) << text;
  return path;
}

std::string const gas = "end_time = \"1 ms\"\n[fluid]\nhigh = [1]\ncells = [16]\n";

TEST(Scene, ResolvedIsTheSameSceneAgain) {
  auto comm = parallel::serial();
  std::string const path = written("scene_resolved.toml", gas + "ambient = { density = \"1.2 kg/m3\" }\neuler = {}\n");
  LoadedScene const first = load_scene(path, {"fluid.euler.order=7", "title=a = b"}, *comm);
  EXPECT_EQ(first.scene.fluid->euler->order, 7);
  EXPECT_EQ(first.scene.title, "a = b");
  std::string const text = first.resolved();
  EXPECT_NE(text.find("# --set fluid.euler.order=7\n"), std::string::npos);
  LoadedScene const second = load_scene(written("scene_again.toml", text), {}, *comm);
  EXPECT_EQ(write_keys(second.scene), write_keys(first.scene));
}

TEST(Scene, SectionsThatNeedEachOther) {
  auto comm = parallel::serial();
  auto const complaint = [&](std::string const& text) -> std::string {
    try {
      load_scene(written("scene_sections.toml", text), {}, *comm);
    } catch (Error const& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(complaint("end_time = 1").find("neither [fluid] nor [solid]"), std::string::npos);
  EXPECT_NE(complaint(gas + "[coupling]\n").find("[solid] is missing"), std::string::npos);
}

TEST(Scene, MissingFileIsASceneError) {
  auto comm = parallel::serial();
  EXPECT_THROW(load_scene("no/such.toml", {}, *comm), Error);
  EXPECT_THROW(load_scene(::testing::TempDir(), {}, *comm), Error);
}

}  // namespace
}  // namespace brisance::drivers
