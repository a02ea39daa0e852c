#include "core/solid/loads/surface_loads.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/solid/loads/free_step.hpp"

namespace brisance::solid {
namespace {

std::string numbered(char const* kind, std::size_t i) { return std::string(kind) + "[" + std::to_string(i) + "]"; }

}  // namespace

SurfaceLoads::SurfaceLoads(SolidConfig const& config, Solid& solid) : config_(config), solid_(solid) {
  find_faces();
  set_tractions(0);
}

void SurfaceLoads::find_faces() {
  Mesh const& mesh = solid_.mesh();
  std::vector<std::vector<FaceRef>> wanted;  // of each load, in the order of the scene
  for (std::size_t i = 0; i < config_.pressure.size(); ++i) {
    PressureConfig const& p = config_.pressure[i];
    std::string const name = numbered("solid.pressure", i);
    loads_.push_back({History(p, name, p.at), true, {}});
    wanted.push_back(select_faces(p, mesh, name, p.at));
  }
  for (std::size_t i = 0; i < config_.traction.size(); ++i) {
    TractionConfig const& t = config_.traction[i];
    std::string const name = numbered("solid.traction", i);
    for (int d = mesh.dimension; d < 3; ++d)
      require(t.traction[d] == 0, t.at, name + ".traction leaves the plane of the solid; make that component 0");
    loads_.push_back({History(t, name, t.at), t.follow, {}});
    wanted.push_back(select_faces(t, mesh, name, t.at));
  }
  for (std::size_t i = 0; i < config_.blast.size(); ++i)
    wanted.push_back(select_faces(config_.blast[i], mesh, numbered("solid.blast", i), config_.blast[i].at));

  std::vector<FaceRef> all;
  for (auto const& faces : wanted) all.insert(all.end(), faces.begin(), faces.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<FaceLoad> loads;
  std::vector<FaceRef> here;
  for (FaceRef const& f : all) {
    longest_step_ = min(longest_step_, free_step(mesh, f.particle));
    loads.push_back({f.particle, f.face, {}});
    if (solid_.local(f.particle) >= 0) here.push_back(f);
  }
  solid_.load_faces(loads);
  auto const place = [&](FaceRef const& f) {
    return static_cast<std::size_t>(std::lower_bound(here.begin(), here.end(), f) - here.begin());
  };
  for (std::size_t l = 0; l < wanted.size(); ++l)
    for (FaceRef const& f : wanted[l]) {
      Vec3 const normal = mesh.face(f.particle, f.face).normal;
      if (l >= loads_.size()) {  // every rank looks at every face: all meet the same scene error
        std::size_t const i = l - loads_.size();
        BlastConfig const& blast = config_.blast[i];
        Vec3 const centroid = mesh.particle(f.particle).centre + mesh.face(f.particle, f.face).centroid;
        BlastWave const wave = blast_wave(blast, mesh.dimension, centroid, normal, numbered("solid.blast", i));
        if (solid_.local(f.particle) >= 0) blasts_.push_back({place(f), wave});
      } else if (solid_.local(f.particle) >= 0) {
        std::size_t const t = l - config_.pressure.size();
        loads_[l].parts.push_back({place(f), l < config_.pressure.size() ? -config_.pressure[l].pressure * normal
                                                                         : config_.traction[t].traction});
      }
    }
  count_ = here.size();
  account_of_faces_.follow(solid_, 0, count_);
}

void SurfaceLoads::set_tractions(Real time) {
  time_ = time;
  auto const faces = solid_.face_tractions().faces();
  for (std::size_t k = 0; k < count_; ++k) faces[k].traction = {};
  for (Load const& load : loads_) {
    Real const factor = load.history.at(time);
    for (Part const& part : load.parts) {
      FaceTractions::Face& f = faces[part.face];
      Vec3 const t = factor * part.traction;
      f.traction += load.follow ? t : rotate(conjugate(solid_.pose()[static_cast<std::size_t>(f.particle)].q), t);
    }
  }
  for (BlastPart const& part : blasts_) {
    FaceTractions::Face& f = faces[part.face];
    f.traction -= part.wave.pressure(time) * f.normal;
  }
  solid_.tractions_changed();
}

void SurfaceLoads::join(Plan& plan) {
  auto const bytes = [this] {
    std::size_t parts = blasts_.size() * sizeof(BlastPart) + account_of_faces_.bytes();
    for (Load const& load : loads_) parts += load.parts.size() * sizeof(Part);
    return parts;
  };
  // Their common tasks and memory go to the last of them.
  auto const nothing = [] { return std::size_t{0}; };
  if (!config_.pressure.empty()) plan.effect("solid.pressure", nothing);
  if (!config_.traction.empty()) plan.effect("solid.traction", nothing);
  if (!config_.blast.empty()) plan.effect("solid.blast", nothing);
  plan.effects().back().bytes = bytes;
  plan.at(Stage::set_off, [this](Clock const&) { account_of_faces_.before_first_kick(); });
  plan.at(Stage::kick, [this](Clock const&) { account_of_faces_.after_first_kick(); });
  plan.at(Stage::drift, [this](Clock const& c) {
    account_of_faces_.before_change();
    set_tractions(c.time + c.dt);
  });
  plan.at(Stage::kick_again, [this](Clock const& c) { account_of_faces_.after_second_kick(c.dt, account_); });
  if (longest_step_ < 1e300) plan.limit("solid.loads", [this](Clock const&) { return longest_step_; });
  plan.account([this](Ledger& ledger) { account_.book(ledger); });
  Plan::Keep keep;
  keep.save = [this] { saved_time_ = time_; };
  keep.restore = [this] {
    set_tractions(saved_time_);
    account_of_faces_.start();
    account_.clear();
  };
  keep.write = [](parallel::ArchiveWriter&) {};
  keep.read = [this](parallel::ArchiveReader& file) { set_tractions(file.real("time")); };
  keep.digest = [](parallel::Digest&) {};
  plan.keep(std::move(keep));
}

void SurfaceLoads::start() {
  solid_.compute_strains();
  account_of_faces_.start();
}

}  // namespace brisance::solid
