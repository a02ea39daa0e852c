#include "core/model/plan.hpp"

namespace brisance {

void Plan::effect(std::string name, std::function<std::size_t()> bytes) {
  effects_.push_back({std::move(name), 0, std::move(bytes)});
}

void Plan::at(Stage stage, std::function<void(Clock const&)> run, std::function<Part(Clock const&)> part) {
  tasks_[static_cast<std::size_t>(stage)].push_back({effects_.size() - 1, std::move(run), std::move(part)});
}

void Plan::account(std::function<void(Ledger&)> add) {
  if (stages_) stages_->watch(effects_.back().name.starts_with("solid.") ? Domain::solid : Domain::flow, add);
  accounts_.push_back(std::move(add));
}

char const* name(Stage stage) {
  switch (stage) {
    case Stage::source:
      return "source";
    case Stage::set_off:
      return "set_off";
    case Stage::predict:
      return "predict";
    case Stage::boundary:
      return "boundary";
    case Stage::diffuse:
      return "diffuse";
    case Stage::sweeps:
      return "sweeps";
    case Stage::diffuse_again:
      return "diffuse_again";
    case Stage::cut_cells:
      return "cut_cells";
    case Stage::load_solid:
      return "load_solid";
    case Stage::kick:
      return "kick";
    case Stage::drift:
      return "drift";
    case Stage::flow_update:
      return "flow_update";
    case Stage::mix:
      return "mix";
    case Stage::fill:
      return "fill";
    case Stage::source_again:
      return "source_again";
    case Stage::forces:
      return "forces";
    case Stage::contact:
      return "contact";
    case Stage::kick_again:
      return "kick_again";
    case Stage::fracture:
      return "fracture";
    case Stage::open:
      return "open";
    case Stage::count:
      break;
  }
  return "?";
}

}  // namespace brisance
