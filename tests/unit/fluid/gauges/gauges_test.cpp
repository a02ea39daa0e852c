#include "fluid/gauges/gauges.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/model/simulation.hpp"
#include "fluid/euler.hpp"
#include "fluid/initial_state.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

/// A disk of hot gas in blocks of many owners.
FlowConfig blast() {
  FlowConfig config = testing::unit_box(2, 40);
  config.block = 10;
  RegionConfig ball;
  ball.shape = "ball";
  ball.centre = Vec3{0.3, 0.4, 0};
  ball.radius = 0.15;
  ball.density = 5;
  ball.pressure = 20;
  config.region = {ball};
  return config;
}

GaugeConfig gauge(std::string const& name, Vec3 position) {
  GaugeConfig g;
  g.name = name;
  g.position = position;
  g.interval = 0.002;
  return g;
}

enum class Halved { by_limit, by_rejection };

/// The files after 20 pairs of steps, of which the fifth has half the step of the others.
std::string files(parallel::Comm& comm, Halved halved) {
  FlowConfig const config = blast();
  auto const flow = testing::make_flow(config, comm);
  fill(*flow, config);
  Euler euler(*config.euler, *flow);
  Gauges gauges({gauge("corner", {0.5, 0.5, 0}), gauge("face", {0.26, 0.75, 0})}, config, *flow, {});
  Plan plan;
  euler.join(plan);
  gauges.join(plan);
  Real const dt = 1e-3;
  plan.limit("test", [&](Clock const& c) { return c.step == 8 && halved == Halved::by_limit ? dt / 2 : dt; });
  // Bad after the second step of the pair, so that both have been noted.
  plan.health([&](Clock const& c) {
    return Verdict{!(halved == Halved::by_rejection && c.step == 10 && c.dt == dt), "test"};
  });
  Simulation simulation(plan, comm, {1, 2, 0});
  simulation.audit();
  std::string const directory = ::testing::TempDir() + "brisance_gauges." + std::to_string(getppid());
  if (comm.rank() == 0) std::filesystem::create_directories(directory);
  comm.barrier();
  gauges.open(directory, simulation.clock());
  for (int pair = 0; pair < 20; ++pair) {
    simulation.pair();
    gauges.accept(simulation.clock());
  }
  gauges.flush();
  EXPECT_EQ(simulation.statistics().retries, halved == Halved::by_rejection ? 1 : 0);
  comm.barrier();
  std::ostringstream text;
  for (char const* name : {"corner", "face"}) text << std::ifstream(directory + "/gauges/" + name + ".csv").rdbuf();
  comm.barrier();
  if (comm.rank() == 0) std::filesystem::remove_all(directory);
  comm.barrier();
  return text.str();
}

TEST(Gauges, ForgetTheStepsOfARejectedPair) {
  std::string const limited = files(testing::comm(), Halved::by_limit);
  EXPECT_EQ(files(testing::comm(), Halved::by_rejection), limited);
  // 39 dt in all: a header and 20 rows each.
  EXPECT_EQ(std::count(limited.begin(), limited.end(), '\n'), 42);
}

}  // namespace
}  // namespace brisance::fluid
