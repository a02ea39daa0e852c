#include "drivers/scene.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/base/errors.hpp"
#include "core/solid/particle_fields.hpp"
#include "fluid/cell_fields.hpp"

namespace brisance::drivers {
namespace {

/// The text of a file, or why it cannot be read.
struct FileText {
  bool ok = false;
  std::string text;
};

FileText read_file(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  bool const ok = file.is_open() && !file.bad();
  return {ok, ok ? text.str() : std::strerror(errno)};
}

std::string read_on_root(std::string const& path, parallel::Comm& comm) {
  parallel::Bytes bytes;
  if (comm.rank() == 0) {
    FileText const file = read_file(path);
    parallel::put(bytes, file.ok);
    auto const text = std::as_bytes(std::span(file.text));
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  comm.broadcast(bytes, 0);
  std::span<std::byte const> in(bytes);
  bool const ok = parallel::take<bool>(in);
  std::string text(in.size(), '\0');
  std::memcpy(text.data(), in.data(), in.size());
  require(ok, Failure::scene, path + ": the scene cannot be read: " + text);
  return text;
}

/// Sections that need each other.
void check_sections(Scene const& scene) {
  require(scene.fluid || scene.solid, scene.at, "the scene has neither [fluid] nor [solid]; add at least one of them");
  require(
      !scene.coupling || (scene.fluid && scene.solid), scene.at,
      std::string("[coupling] needs both [fluid] and [solid]; [") + (scene.fluid ? "solid" : "fluid") + "] is missing");
  require(scene.output.gauge.empty() || scene.fluid, scene.output.at,
          "output.gauge: gauges stand in the gas, and the scene has no [fluid]");
  require(scene.output.solid_gauge.empty() || scene.solid, scene.output.at,
          "output.solid_gauge: these gauges watch the solid, and the scene has no [solid]");
}

}  // namespace

void OutputConfig::keys(Keys<OutputConfig>& k) {
  k("interval", &OutputConfig::interval, "s",
    "time between two outputs of the fields, the solid and the fragments; not given: at the start and the end only")
      .above(0);
  k("checkpoint_interval", &OutputConfig::checkpoint_interval, "s",
    "time between two checkpoints; not given: only when the run stops")
      .above(0);
  k("history_interval", &OutputConfig::history_interval, "s",
    "time between two rows of history.csv; not given: a row per step")
      .above(0);
  k("fields", &OutputConfig::fields, "",
    "fields of the fluid to write; schlieren: exp(-10 |grad rho| / max), 1 in uniform gas; vorticity: 2D its z "
    "component")
      .words = fluid::cell_field_names();
  k("solid_fields", &OutputConfig::solid_fields, "",
    "fields of the solid to write, beside those that its effects add (fragment, damage, plastic strain): of the "
    "particles' centres and their rotation vector, and the mean stress of each particle (the loads of a fluid on its "
    "faces do not count); tension is positive")
      .words = solid::particle_field_names();
  k("ledger", &OutputConfig::ledger, "",
    "stage: the defects of mass, momentum and energy are charged to the part of the step that made them, in stages.csv "
    "and summary.json; costs a sum over all cells and particles after each part")
      .one_of({"total", "stage"});
  k("gauge", &OutputConfig::gauge, "", "points where the gas is watched; each writes gauges/NAME.csv");
  k("solid_gauge", &OutputConfig::solid_gauge, "",
    "particles, surface points, supports and sections of the solid that are watched; each writes gauges/NAME.csv");
}

void Scene::keys(Keys<Scene>& k) {
  k("title", &Scene::title, "", "a line for people");
  k("end_time", &Scene::end_time, "s", "time at which the run ends").required().above(0);
  k("output", &Scene::output, "", "what is written, and when");
  k("fluid", &Scene::fluid, "", "a compressible gas on blocks of Cartesian cells");
  k("solid", &Scene::solid, "", "deformable solids of rigid polyhedral particles and elastic links");
  k("coupling", &Scene::coupling, "", "what fluid and solid do to each other");
}

std::string LoadedScene::resolved() const {
  std::string text = "# " + path + " with every value, in SI units. Written by brisance; it can be run as it is.\n";
  for (std::string const& assignment : overrides) {
    text += "# --set ";
    for (char const c : assignment) text += c == '\n' ? ' ' : c;
    text += "\n";
  }
  return text + "\n" + write_keys(scene);
}

LoadedScene load_scene(std::string const& path, std::vector<std::string> const& overrides, parallel::Comm& comm) {
  LoadedScene loaded;
  loaded.path = path;
  loaded.text = read_on_root(path, comm);
  loaded.overrides = overrides;
  Tree tree = parse_toml(loaded.text, path);
  for (std::string const& assignment : overrides) apply_override(tree, assignment);
  loaded.scene = read_keys<Scene>(tree);
  check_sections(loaded.scene);
  return loaded;
}

}  // namespace brisance::drivers
