#include "drivers/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "core/base/errors.hpp"
#include "drivers/commands.hpp"
#include "drivers/guard.hpp"
#include "drivers/log.hpp"
#include "drivers/times.hpp"

namespace brisance::drivers {
namespace {

/// A check of CLI11: empty when the text is a whole number from 1 on.
std::string at_least_one(std::string const& text) {
  bool const digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return digits && text.find_first_not_of('0') != std::string::npos ? "" : text + " is not a whole number from 1 on";
}

/// StopOptions as they are typed.
struct StopText {
  std::string until, walltime;
  std::int64_t steps = 0;

  void add_to(CLI::App& command) {
    command.add_option("--until", until, "end at this simulated time, counted from the start of the scene: \"1 ms\"");
    command.add_option("--steps", steps, "end after this many steps, counted from the start of the scene")
        ->check(at_least_one);
    command.add_option("--walltime", walltime, "stop with a checkpoint after this real time: 1h50m (exit code 75)");
  }

  StopOptions read() const {
    StopOptions stop;
    if (!until.empty()) stop.until = parse_time("--until", until);
    if (!walltime.empty()) stop.walltime = parse_walltime("--walltime", walltime);
    if (steps > 0) stop.steps = steps;
    return stop;
  }
};

/// --set may be repeated; each takes exactly one assignment.
void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "set a key of the scene: key.path=VALUE; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

/// All subcommands. `chosen` becomes the call to the one that was given.
class CommandLine {
 public:
  explicit CommandLine(parallel::Comm& comm) : comm_(comm) {
    app_.set_version_flag("--version", "brisance " BRISANCE_VERSION);
    app_.require_subcommand(1);
    app_.footer(
        "Exit codes: 0 done, 1 internal error, 2 usage or scene error (nothing written), 3 numerical failure, 4 system "
        "failure, 75 stopped with a checkpoint: resume with \"brisance restart DIR\".");
    add_run();
    add_restart();
    add_check();
    add_bench();
    add_params();
  }

  int run(int argc, char const* const* argv) {
    try {
      app_.parse(argc, argv);
    } catch (CLI::ParseError const& error) {
      return help_or_usage(error, argc, argv);
    }
    return chosen_();
  }

 private:
  void add_run() {
    CLI::App& command = *app_.add_subcommand("run", "run a scene");
    command.add_option("SCENE", run_.scene, "the scene, a TOML file")->required();
    command.add_option("--out", run_.out, "output directory [results/NAME OF THE SCENE]");
    add_overrides(command, run_.overrides);
    command.add_option("--restart", run_.restart,
                       "auto: continue in the output directory if it has a checkpoint; or a file");
    stop_.add_to(command);
    command.add_flag("--quiet", run_.quiet, "say warnings and errors only");
    command.callback([this] {
      chosen_ = [this] {
        if (run_.out.empty())
          run_.out = (std::filesystem::path("results") / std::filesystem::path(run_.scene).stem()).string();
        run_.stop = stop_.read();
        start_log(comm_, run_.quiet);
        return run_scene(run_, comm_);
      };
    });
  }

  void add_restart() {
    CLI::App& command =
        *app_.add_subcommand("restart", "continue a run from its newest good checkpoint, on any number of ranks");
    command.add_option("DIR", restart_.directory, "output directory of the run")->required();
    stop_.add_to(command);
    command.add_flag("--quiet", restart_.quiet, "say warnings and errors only");
    command.callback([this] {
      chosen_ = [this] {
        restart_.stop = stop_.read();
        start_log(comm_, restart_.quiet);
        return restart_run(restart_, comm_);
      };
    });
  }

  void add_check() {
    CLI::App& command =
        *app_.add_subcommand("check", "the dry run: validate a scene and say what it would do and cost");
    command.add_option("SCENE", check_.scene, "the scene, a TOML file")->required();
    add_overrides(command, check_.overrides);
    command.add_option("--ranks", check_.ranks, "number of ranks to plan for")
        ->check(at_least_one, "")
        ->capture_default_str();
    command.add_flag("--json", check_.json, "print JSON");
    command.callback([this] { chosen_ = [this] { return check_scene(check_, comm_); }; });
  }

  void add_bench() {
    CLI::App& command =
        *app_.add_subcommand("bench", "measure what this machine does: bandwidth, kernels, whole steps");
    command.add_option("NAME", bench_.names, "rows whose name begins so, such as fluid.3d [all]");
    command.add_option("--json", bench_.json, "write the rows to this file too");
    command.callback([this] { chosen_ = [this] { return run_bench(bench_, comm_); }; });
  }

  void add_params() {
    CLI::App& command =
        *app_.add_subcommand("params", "the reference of the scene: every key, type, unit, default, meaning");
    command.add_option("KEY", params_.path, "key path, such as fluid.euler [all]");
    command.callback([this] { chosen_ = [this] { return print_params(params_, comm_); }; });
  }

  /// Help and version are 0, every wrong usage is 2.
  int help_or_usage(CLI::ParseError const& error, int argc, char const* const* argv) {
    bool const help = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (comm_.rank() == 0 && help) app_.exit(error);
    if (help) return 0;
    if (comm_.rank() == 0) {
      std::string const text = std::string(error.what()) + suggestion(argc, argv);
      std::fprintf(stderr, "brisance: %s\nRun \"brisance --help\" or \"brisance COMMAND --help\".\n", text.c_str());
    }
    return static_cast<int>(Failure::scene);
  }

  /// The subcommand that was meant, when the one given does not exist.
  std::string suggestion(int argc, char const* const* argv) {
    if (argc < 2 || argv[1][0] == '-') return "";
    std::vector<std::string> known;
    for (CLI::App const* command : app_.get_subcommands(nullptr)) known.push_back(command->get_name());
    if (std::count(known.begin(), known.end(), argv[1]) > 0) return "";
    return std::string("; there is no subcommand ") + argv[1] + ", the nearest is " + nearest(argv[1], known);
  }

  parallel::Comm& comm_;
  CLI::App app_{"Explosions and structures: compressible gas, breaking solids and their coupling.", "brisance"};
  std::function<int()> chosen_;
  StopText stop_;
  RunOptions run_;
  RestartOptions restart_;
  CheckOptions check_;
  BenchOptions bench_;
  ParamsOptions params_;
};

}  // namespace

int command_line(int argc, char const* const* argv, parallel::Comm& comm) {
  start_log(comm, false);
  CommandLine line(comm);
  return guarded(comm, [&] { return line.run(argc, argv); });
}

}  // namespace brisance::drivers
