// The subcommands of brisance: what each is asked for, and the function that does it. Each returns an exit code of the
// contract and throws Error otherwise. All are collective.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "parallel/comm.hpp"

namespace brisance::drivers {

/// When to stop before the end of the scene. Times and steps count from the start of the scene, walltime from now.
struct StopOptions {
  std::optional<double> until;        ///< s of simulated time
  std::optional<std::int64_t> steps;  ///< steps
  std::optional<double> walltime;     ///< s of real time; exit code 75 when it ends the run
};

struct RunOptions {
  std::string scene;
  std::string out;  ///< output directory; never empty
  std::vector<std::string> overrides;
  std::optional<std::string> restart;  ///< "auto": the newest good checkpoint of `out`, if any; else a checkpoint file
  StopOptions stop;
  bool quiet = false;
};

struct RestartOptions {
  std::string directory;
  StopOptions stop;
  bool quiet = false;
};

struct CheckOptions {
  std::string scene;
  std::vector<std::string> overrides;
  int ranks = 1;
  bool json = false;
};

struct BenchOptions {
  std::vector<std::string> names;  ///< rows whose name starts with one of these; all when empty
  std::string json;                ///< file to write, or empty
};

struct ParamsOptions {
  std::string path;  ///< key path, or empty for all keys
};

int run_scene(RunOptions const& options, parallel::Comm& comm);
int restart_run(RestartOptions const& options, parallel::Comm& comm);
int check_scene(CheckOptions const& options, parallel::Comm& comm);
int run_bench(BenchOptions const& options, parallel::Comm& comm);
int print_params(ParamsOptions const& options, parallel::Comm& comm);

}  // namespace brisance::drivers
