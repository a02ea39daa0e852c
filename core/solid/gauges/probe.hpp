// What one gauge reads of the solid: values at one particle or face, or sums over links and held particles.
#pragma once
#include "core/solid/gauges/gauge_config.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// Chosen once in the reference state, alike on every rank; read after every step by the ranks that own something of
/// it.
class Probe {
 public:
  /// Errors: scene errors when there is nothing to watch.
  Probe(SolidGaugeConfig const& gauge, Solid const& solid);

  /// Is it a sum over ranks (force and moment)? Else one rank has all values.
  bool is_sum() const { return particle_ < 0; }
  /// Ranks that contribute, ascending.
  std::vector<int> const& ranks() const { return ranks_; }
  /// Where it reads, in the reference state, m: centre of the particle or of the face, mean place of the links.
  Vec3 const& place() const { return place_; }

  /// All columns. Expects: this rank is the one of ranks().
  std::vector<Real> values(Solid const& solid) const;
  /// Adds the share of this rank to force (3) and moment (3).
  void add(Solid const& solid, std::span<parallel::ExactSum, 6> sums) const;
  /// The columns of force and moment in this dimension.
  std::vector<Real> columns(std::span<parallel::ExactSum const, 6> sums, int dimension) const;

 private:
  void choose_particle(Mesh const& mesh);
  void choose_face(Mesh const& mesh);
  void choose_supports(Mesh const& mesh);
  void choose_section(Mesh const& mesh);
  bool counts(Mesh const& mesh, GlobalId particle, Vec3 const& place) const;

  SolidGaugeConfig gauge_;
  Index body_ = -1;
  GlobalId particle_ = -1;
  int face_ = -1;
  Vec3 place_{}, about_{};
  std::vector<GlobalId> held_;
  struct Cut {
    std::size_t link;  // of the mesh
    bool forward;      // particle i is behind the plane
  };
  std::vector<Cut> cuts_;
  std::vector<int> ranks_;
};

}  // namespace brisance::solid
