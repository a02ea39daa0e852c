// A scene: what the user asked for, read strictly, with all defaults filled in. The one place that names every section.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/keys.hpp"
#include "core/solid/gauges/gauge_config.hpp"
#include "core/solid/solid_config.hpp"
#include "coupling/coupling_config.hpp"
#include "fluid/flow_config.hpp"
#include "fluid/gauges/gauge_config.hpp"
#include "parallel/comm.hpp"

namespace brisance::drivers {

/// What is written, and when. Output times shorten steps, so that they are hit exactly.
struct OutputConfig {
  std::optional<double> interval;             // s
  std::optional<double> checkpoint_interval;  // s
  std::optional<double> history_interval;     // s
  std::vector<std::string> fields = {"density", "pressure", "velocity"};
  std::vector<std::string> solid_fields = {"displacement", "velocity", "von_mises"};
  std::string ledger = "total";
  std::vector<fluid::GaugeConfig> gauge;
  std::vector<solid::SolidGaugeConfig> solid_gauge;
  Location at;
  static void keys(Keys<OutputConfig>& k);
};

struct Scene {
  std::string title;
  double end_time = 0;  // s
  OutputConfig output;
  std::optional<fluid::FlowConfig> fluid;
  std::optional<solid::SolidConfig> solid;
  std::optional<coupling::CouplingConfig> coupling;
  Location at;
  static void keys(Keys<Scene>& k);
};

/// A scene with what it was read from.
struct LoadedScene {
  Scene scene;
  std::string path;
  std::string text;                    ///< the file as it was
  std::vector<std::string> overrides;  ///< the --set of the command line, in order
  /// Every value in SI, with the overrides as comments: the content of scene.resolved.toml.
  std::string resolved() const;
};

/// Reads a scene file on rank 0 and gives it to all ranks, so that all see the same scene or the same error.
/// Collective. Errors: Failure::scene with file, line, column and key.
LoadedScene load_scene(std::string const& path, std::vector<std::string> const& overrides, parallel::Comm& comm);

}  // namespace brisance::drivers
