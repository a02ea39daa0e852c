#include "core/model/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "parallel/error.hpp"

namespace brisance {
namespace {

constexpr Real smallest_retry_factor = 0x1p-20;

}  // namespace

// The coupled step (theory/coupling.md 1.8, 5). Stages without tasks are empty loops.
void Simulation::step() {
  run_flow(Stage::source, Part::sources);
  set_off();
  run(Stage::predict);
  switch (control_.coupling) {
    case TimeCoupling::lag:
      step_lag();
      break;
    case TimeCoupling::semi:
      step_semi();
      break;
    case TimeCoupling::explicit_load:
      step_explicit();
      break;
  }
  run(Stage::flow_update);
  run(Stage::mix);
  run_flow(Stage::fill, Part::mixing);
  run_flow(Stage::source_again, Part::sources);
  run_flow(Stage::open, Part::fracture);
  clock_.time += clock_.dt;
  clock_.step += 1;
}

void Simulation::step_lag() {
  run(Stage::boundary);
  move_flow();
  run(Stage::load_solid);
  move_solid();
}

void Simulation::step_semi() {
  run(Stage::boundary);
  move_flow();  // once: its pressures do not depend on the boundary at the end of the step
  run(Stage::load_solid);
  while (plan_.take_asked_boundary()) {
    run(Stage::boundary);
    run(Stage::load_solid);
  }
  move_solid();
}

void Simulation::step_explicit() {
  move_flow();
  run(Stage::load_solid);
  move_solid();
  run(Stage::boundary);
}

void Simulation::move_flow() {
  run_flow(Stage::diffuse, Part::diffusion);
  run(Stage::sweeps);  // each names its part
  run_flow(Stage::diffuse_again, Part::diffusion);
}

void Simulation::set_off() {
  Clock const whole = clock_;
  clock_.dt = whole.dt / whole.sub_steps;
  run(Stage::set_off);
  clock_ = whole;
}

void Simulation::move_solid() {
  Clock const whole = clock_;
  clock_.dt = whole.dt / whole.sub_steps;
  for (clock_.sub_step = 0; clock_.sub_step < whole.sub_steps; ++clock_.sub_step) {
    clock_.time = whole.time + clock_.sub_step * clock_.dt;
    if (clock_.sub_step > 0) run(Stage::set_off);
    run(Stage::kick);
    run(Stage::drift);
    run(Stage::forces);
    run(Stage::contact);
    run(Stage::kick_again);
    charge(Part::motion, Domain::solid);
    if (plan_.tasks(Stage::fracture).empty()) continue;
    run(Stage::fracture);
    if (plan_.take_asked_forces()) {  // both kicks that meet at a break see the links of their own side of it
      run(Stage::forces);
      run(Stage::contact);
    }
    charge(Part::fracture, Domain::solid);
  }
  clock_ = whole;
}

void Simulation::run(Stage stage) {
  using Timer = std::chrono::steady_clock;
  for (Plan::Task const& task : plan_.tasks(stage)) {
    auto const start = Timer::now();
    task.run(clock_);
    plan_.effects()[task.effect].wall_s += std::chrono::duration<Real>(Timer::now() - start).count();
    if (task.part && plan_.stages()) charge(task.part(clock_), Domain::flow);
  }
}

void Simulation::charge(Part part, Domain domain) {
  if (StageLedger* const stages = plan_.stages()) stages->charge(part, domain, ledger_);
}

void Simulation::run_flow(Stage stage, Part part) {
  run(stage);
  if (!plan_.tasks(stage).empty()) charge(part, Domain::flow);
}

Real Simulation::choose_step(std::string& limited_by, bool& at_output) {
  std::vector<Real> seconds;
  bool const sub_cycled = control_.most_sub_steps > 1;
  for (Plan::Limit const& limit : plan_.limits())
    seconds.push_back(sub_cycled && limit.sight ? limit.sight() / control_.steps_per_pair : limit.seconds(clock_));
  comm_.min(std::span(seconds));
  solid_limit_ = std::numeric_limits<Real>::max();
  for (std::size_t i = 0; i < seconds.size(); ++i)
    if (plan_.limits()[i].of_solid()) {
      solid_limit_ = min(solid_limit_, seconds[i]);
      seconds[i] *= control_.most_sub_steps;
    }
  // Limits that can be met by sub-cycling are told what the others ask for.
  Real others = std::numeric_limits<Real>::max();
  for (std::size_t i = 0; i < seconds.size(); ++i)
    if (!plan_.limits()[i].relax) others = min(others, seconds[i]);
  for (std::size_t i = 0; i < seconds.size(); ++i)
    if (plan_.limits()[i].relax) seconds[i] = plan_.limits()[i].relax(seconds[i], others);
  Real dt = std::numeric_limits<Real>::max();
  for (std::size_t i = 0; i < seconds.size(); ++i)
    if (seconds[i] < dt) dt = seconds[i], limited_by = plan_.limits()[i].name;
  for (Plan::Limit const& limit : plan_.limits()) {
    if (!sub_cycled || !limit.sight) continue;
    Real own = limit.sub_step(dt * control_.steps_per_pair);
    comm_.min(std::span(&own, 1));
    solid_limit_ = min(solid_limit_, own);
    if (own * control_.most_sub_steps < dt) dt = own * control_.most_sub_steps, limited_by = limit.name;
  }
  dt *= retry_factor_;
  if (retry_factor_ < 1) limited_by = "retry";
  // End time and output times are hit exactly; a pair is shortened, never one half of it.
  Real target = control_.end_time;
  bool output_first = false;
  if (control_.output_interval > 0) {
    Real const next = static_cast<Real>(outputs_done_ + 1) * control_.output_interval;
    if (next < target * (1 - 1e-12)) target = next, output_first = true;
  }
  Real const room = target - clock_.time;
  at_output = false;
  if (dt * control_.steps_per_pair >= room * (1 - 1e-12)) {
    dt = room / control_.steps_per_pair;
    limited_by = output_first ? "output_time" : "end_time";
    at_output = true;
  }
  return dt;
}

int Simulation::sub_steps(Real dt) const {
  Real const wanted = std::ceil(dt / solid_limit_ * (1 - 1e-12));
  return static_cast<int>(clamp(wanted, control_.least_sub_steps, control_.most_sub_steps));
}

bool Simulation::healthy(std::string& message) {
  bool good = true;
  for (auto const& judge : plan_.judges()) {
    Verdict const h = judge(clock_);
    if (!h.good && good) good = false, message = h.message;
  }
  std::uint64_t bad = good ? 0 : 1;
  comm_.bit_or(std::span(&bad, 1));
  if (bad == 0) return true;
  parallel::Bytes mine(message.size());
  std::memcpy(mine.data(), message.data(), message.size());
  for (parallel::Bytes const& text : comm_.all_gather(mine))
    if (!text.empty()) {
      message.assign(reinterpret_cast<char const*>(text.data()), text.size());
      break;
    }
  return false;
}

void Simulation::pair() {
  for (Plan::Keep const& k : plan_.kept()) k.save();
  Clock const start = clock_;
  if (plan_.stages()) plan_.stages()->begin(ledger_);
  auto const ledger_start = ledger_;
  std::string limited_by;
  bool at_output = false;
  Real dt = choose_step(limited_by, at_output);
  for (int halvings = 0;; ++halvings) {
    std::string message;
    clock_.dt = dt;
    clock_.sub_steps = sub_steps(dt);
    bool good = true;
    for (int s = 0; s < control_.steps_per_pair && good; ++s) {
      step();
      good = healthy(message);
    }
    if (good) {
      if (at_output) {  // land on the time itself, not on a sum of roundings
        bool const interval = limited_by == "output_time";
        if (interval) ++outputs_done_;
        clock_.time = interval ? static_cast<Real>(outputs_done_) * control_.output_interval : control_.end_time;
      }
      at_output_ = at_output;
      limited_by_ = limited_by;
      statistics_.dt_min = statistics_.dt_max == 0 ? clock_.dt : min(statistics_.dt_min, clock_.dt);
      statistics_.dt_max = max(statistics_.dt_max, clock_.dt);
      statistics_.limited_by[limited_by] += control_.steps_per_pair;
      statistics_.sub_steps_min =
          statistics_.sub_steps_max == 0 ? clock_.sub_steps : std::min(statistics_.sub_steps_min, clock_.sub_steps);
      statistics_.sub_steps_max = std::max(statistics_.sub_steps_max, clock_.sub_steps);
      statistics_.solid_steps += control_.steps_per_pair * clock_.sub_steps;
      retry_factor_ = min(1, 2 * retry_factor_);
      audit();
      return;
    }
    ++statistics_.retries;
    statistics_.last_rejection = message;
    // Pairs that each pass after some halvings, ever smaller ones, lead nowhere either.
    require(halvings < 10 && retry_factor_ > smallest_retry_factor, Failure::numerical,
            message + " (step " + std::to_string(clock_.step) + ", t = " + std::to_string(clock_.time) + " s, after " +
                std::to_string(std::lround(-std::log2(retry_factor_))) +
                " halvings of dt; lower the Courant number or refine the grid)");
    for (Plan::Keep const& k : plan_.kept()) k.restore();
    clock_ = start;
    ledger_ = ledger_start;
    if (plan_.stages()) plan_.stages()->restore();
    retry_factor_ *= 0.5;
    dt *= 0.5;
    limited_by = "retry";
    at_output = false;
  }
}

void Simulation::audit() {
  for (auto const& account : plan_.accounts()) account(ledger_);
  ledger_.audit(comm_);
  if (plan_.stages()) plan_.stages()->audit(comm_);
}

parallel::Digest Simulation::digest() {
  parallel::Digest digest;
  for (Plan::Keep const& k : plan_.kept()) k.digest(digest);
  comm_.sum(digest);
  std::array<double, 2> const time{clock_.time, static_cast<double>(clock_.step)};
  digest.add(0, 0, time);
  return digest;
}

void Simulation::write(parallel::ArchiveWriter& file) {
  file.attribute("time", clock_.time);
  file.attribute("step", clock_.step);
  file.attribute("retry_factor", retry_factor_);
  file.attribute("outputs_done", outputs_done_);
  file.attribute("dt_min", statistics_.dt_min);
  file.attribute("dt_max", statistics_.dt_max);
  file.attribute("retries", statistics_.retries);
  file.attribute("solid_steps", statistics_.solid_steps);
  file.attribute("sub_steps_min", std::int64_t{statistics_.sub_steps_min});
  file.attribute("sub_steps_max", std::int64_t{statistics_.sub_steps_max});
  std::string limits;
  for (auto const& [limit, steps] : statistics_.limited_by) limits += limit + "=" + std::to_string(steps) + ";";
  file.attribute("limited_by", limits);
  auto const account = ledger_.store();
  parallel::Range const all{0, comm_.rank() == 0 ? static_cast<std::int64_t>(account.size()) : 0};
  file.rows("ledger", static_cast<std::int64_t>(account.size()), 1, std::span(&all, 1),
            std::span(account).first(static_cast<std::size_t>(all.count)));
  if (StageLedger const* const stages = this->stages()) {
    parallel::Range const rows{0, comm_.rank() == 0 ? static_cast<std::int64_t>(part_count) : 0};
    auto const mine = std::span(&rows, rows.count > 0 ? 1 : 0);
    auto limbs = stages->store_limbs();
    auto sizes = stages->store_sizes();
    if (rows.count == 0) limbs.clear(), sizes.clear();
    file.rows_int("stage_sums", part_count, StageLedger::limbs_per_row, mine, limbs);
    file.rows("stage_sizes", part_count, StageLedger::sizes_per_row, mine, sizes);
  }
  for (Plan::Keep const& k : plan_.kept()) k.write(file);
}

void Simulation::read(parallel::ArchiveReader& file) {
  clock_.time = file.real("time");
  clock_.step = file.integer("step");
  retry_factor_ = file.real("retry_factor");
  outputs_done_ = file.integer("outputs_done");
  statistics_ = {};
  statistics_.dt_min = file.real("dt_min");
  statistics_.dt_max = file.real("dt_max");
  statistics_.retries = file.integer("retries");
  statistics_.solid_steps = file.integer("solid_steps");
  statistics_.sub_steps_min = static_cast<int>(file.integer("sub_steps_min"));
  statistics_.sub_steps_max = static_cast<int>(file.integer("sub_steps_max"));
  std::string const limits = file.text("limited_by");
  for (std::size_t at = 0; at < limits.size();) {
    std::size_t const equal = limits.find('=', at), stop = limits.find(';', equal);
    statistics_.limited_by[limits.substr(at, equal - at)] = std::stoll(limits.substr(equal + 1, stop - equal - 1));
    at = stop + 1;
  }
  parallel::Range const all{0, static_cast<std::int64_t>(Ledger::stored_size)};
  std::vector<double> const rows = file.rows("ledger", 1, std::span(&all, 1));
  std::array<Real, Ledger::stored_size> account{};
  std::copy(rows.begin(), rows.end(), account.begin());
  ledger_.restore(account);
  // A checkpoint of a run that did not ask for them has none: they count from here on then.
  if (StageLedger* const stages = plan_.stages(); stages && file.has("stage_sums")) {
    parallel::Range const rows{0, static_cast<std::int64_t>(part_count)};
    auto const limbs = file.rows_int("stage_sums", StageLedger::limbs_per_row, std::span(&rows, 1));
    stages->read(limbs, file.rows("stage_sizes", StageLedger::sizes_per_row, std::span(&rows, 1)));
  }
  for (Plan::Keep const& k : plan_.kept()) k.read(file);
}

}  // namespace brisance
