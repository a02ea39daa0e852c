// brisance run and brisance restart: the loop around the pairs of steps.
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>

#include <spdlog/spdlog.h>

#include "core/solid/loads/blast_report.hpp"
#include "drivers/checkpoints.hpp"
#include "drivers/commands.hpp"
#include "drivers/history.hpp"
#include "drivers/log.hpp"
#include "drivers/mesh_files.hpp"
#include "drivers/output.hpp"
#include "drivers/summary.hpp"
#include "fluid/charges.hpp"
#include "parallel/archive.hpp"
#include "parallel/error.hpp"

namespace brisance::drivers {

namespace {

constexpr int exit_stopped = 75;
volatile std::sig_atomic_t stop_signal = 0;
extern "C" void note_signal(int signal) { stop_signal = signal; }

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Job {
  LoadedScene loaded;
  std::string directory;
  StopOptions stop;
  std::vector<std::string> checkpoints;  ///< candidates to resume from, newest first; empty: from the start
  bool same_scene = false;               ///< the scene is the one the directory keeps
};

void make_directories(parallel::Comm& comm, std::string const& directory) {
  std::string trouble;
  if (comm.rank() == 0) {
    std::error_code error;
    std::filesystem::create_directories(directory + "/checkpoints", error);
    if (error) trouble = directory + ": cannot be created: " + error.message();
  }
  parallel::Bytes bytes(trouble.size());
  std::memcpy(bytes.data(), trouble.data(), trouble.size());
  comm.broadcast(bytes, 0);
  if (!bytes.empty())
    throw Error(Failure::system, std::string(reinterpret_cast<char const*>(bytes.data()), bytes.size()));
}

/// Reads the newest good checkpoint; a damaged one is named and the one before it is taken.
void resume(World& world, std::vector<std::string> const& candidates) {
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    try {
      read_checkpoint(world, candidates[i]);
      spdlog::info("resumed from {} (step {}, t = {:.6g} s)", candidates[i], world.simulation->clock().step,
                   world.simulation->clock().time);
      return;
    } catch (Error const& error) {
      if (error.kind() != Failure::system || i + 1 == candidates.size()) throw;
      spdlog::warn("{}; trying the checkpoint before it", error.what());
    }
  }
}

/// Mass and energy of every charge, which are two figures, and whether the grid resolves it.
void log_charges(World& world, Scene const& scene) {
  if (!scene.fluid || scene.fluid->charge.empty()) return;
  for (fluid::ChargeReport const& report : fluid::measure_charges(*world.flow, *scene.fluid, fluid_volumes(world))) {
    spdlog::info("{}", fluid::describe(report, world.dimension));
    if (std::string const text = fluid::warning(report); !text.empty()) spdlog::warn("{}", text);
  }
}

int execute(Job const& job, parallel::Comm& comm) {
  double const begin = seconds_now();
  Scene const& scene = job.loaded.scene;
  auto const world = assemble(scene, comm);
  Simulation& simulation = *world->simulation;
  make_directories(comm, job.directory);
  log_to_file(job.directory + "/run.log");
  bool const fresh = job.checkpoints.empty();
  if (!job.same_scene) {
    parallel::write_text_atomically(comm, job.directory + "/scene.toml", job.loaded.text);
    LoadedScene kept = job.loaded;
    keep_mesh_files(kept.scene, job.directory, comm);
    parallel::write_text_atomically(comm, job.directory + "/scene.resolved.toml", kept.resolved());
  }
  if (fresh) forget_checkpoints(comm, job.directory);

  if (fresh) {
    start(*world, scene);
    log_charges(*world, scene);
    if (scene.solid)
      for (std::string const& line : solid::describe_blasts(*scene.solid, *world->mesh)) spdlog::info("{}", line);
  } else {
    resume(*world, job.checkpoints);
    start_effects(*world);
  }
  for (SampledFiles* files : world->sampled_files)
    for (std::string const& remark : files->open(job.directory, simulation.clock())) spdlog::warn("{}", remark);
  Output output(*world, scene, job.directory);
  comm.barrier();
  if (fresh)
    output.write();
  else
    output.resume(simulation.clock().time);
  History history(*world, job.directory, scene.output.history_interval);
  RunState run;
  run.scene = job.loaded.path;
  run.setup_s = seconds_now() - begin;
  update_extrema(*world, run);
  if (world->flow)
    spdlog::info("{} cells in {} blocks, {} ranks", world->flow->grid().cell_count(), world->flow->grid().block_count(),
                 comm.size());
  if (world->mesh) spdlog::info("{} particles, {} links", world->mesh->size(), world->mesh->links.size());
  for (std::string const& text : world->plan.remarks()) spdlog::info("{}", text);

  stop_signal = 0;
  for (int const s : {SIGTERM, SIGINT, SIGUSR1}) std::signal(s, note_signal);
  double checkpoint_number = scene.output.checkpoint_interval
                                 ? std::floor(simulation.clock().time / *scene.output.checkpoint_interval * (1 + 1e-12))
                                 : 0;
  double last_report = seconds_now();
  int warnings = 0;
  bool stopped = false;
  auto const reached = [&] {
    return simulation.finished() || (job.stop.until && simulation.clock().time >= *job.stop.until) ||
           (job.stop.steps && simulation.clock().step >= *job.stop.steps);
  };
  while (!reached()) {
    std::int64_t const retries = simulation.statistics().retries;
    simulation.pair();
    for (SampledFiles* files : world->sampled_files) files->accept(simulation.clock());
    if (simulation.statistics().retries > retries && warnings++ < 20)
      spdlog::warn("step {}: a pair of steps was redone with dt = {:.3g} s: {}", simulation.clock().step,
                   simulation.clock().dt, simulation.statistics().last_rejection);
    update_extrema(*world, run);
    history.row();
    if (simulation.at_output_time()) output.write();
    std::uint64_t wish = stop_signal != 0 || (job.stop.walltime && seconds_now() - begin > *job.stop.walltime);
    comm.bit_or(std::span(&wish, 1));
    stopped = wish != 0 && !reached();
    bool checkpoint_due = false;
    if (scene.output.checkpoint_interval) {
      double const number = std::floor(simulation.clock().time / *scene.output.checkpoint_interval * (1 + 1e-12));
      checkpoint_due = number > checkpoint_number;
      checkpoint_number = number;
    }
    if (checkpoint_due && !stopped && !reached()) {
      write_checkpoint(*world, job.directory);
      run.wall_s = seconds_now() - begin;
      write_summary(*world, run, job.directory);
    }
    if (seconds_now() - last_report > 10) {
      last_report = seconds_now();
      int const sub_steps = simulation.clock().sub_steps;
      spdlog::info("step {}  t = {:.6g} s  dt = {:.3g} s ({}){}  energy defect {:.2g}", simulation.clock().step,
                   simulation.clock().time, simulation.clock().dt, simulation.limited_by(),
                   sub_steps > 1 ? "  " + std::to_string(sub_steps) + " steps of the solid in each" : "",
                   simulation.ledger().conservation().energy_final);
    }
    if (stopped) break;
  }
  if (!stopped && simulation.finished()) output.write();
  write_checkpoint(*world, job.directory);
  run.exit = stopped ? "stopped" : "done";
  run.wall_s = seconds_now() - begin;
  write_summary(*world, run, job.directory);
  Conservation const& c = simulation.ledger().conservation();
  spdlog::info(
      "{}: {} steps, t = {:.6g} s, {:.1f} s of wall time; defects: mass {:.1e}, momentum {:.1e}, exchange energy "
      "{:.1e}, energy {:.1e}; digest {}",
      run.exit, simulation.clock().step, simulation.clock().time, run.wall_s, c.mass,
      max(c.momentum.x, max(c.momentum.y, c.momentum.z)), c.exchange_energy, c.energy, simulation.digest().hex());
  for (auto const& tell : world->plan.findings())
    if (std::string const line = tell(); !line.empty()) spdlog::warn("{}", line);
  if (stopped) spdlog::info("resume with: brisance restart {}", job.directory);
  return stopped ? exit_stopped : 0;
}

}  // namespace

int run_scene(RunOptions const& options, parallel::Comm& comm) {
  start_log(comm, options.quiet);
  Job job{load_scene(options.scene, options.overrides, comm), options.out, options.stop, {}, false};
  if (options.restart) {
    job.checkpoints =
        *options.restart == "auto" ? list_checkpoints(comm, options.out) : std::vector<std::string>{*options.restart};
  }
  return execute(job, comm);
}

int restart_run(RestartOptions const& options, parallel::Comm& comm) {
  start_log(comm, options.quiet);
  Job job{load_scene(options.directory + "/scene.resolved.toml", {}, comm), options.directory, options.stop,
          list_checkpoints(comm, options.directory), true};
  require(!job.checkpoints.empty(), Failure::system,
          options.directory + ": there is no checkpoint to continue from; start the scene with \"brisance run\"");
  return execute(job, comm);
}

}  // namespace brisance::drivers
