// The consistent volumetric term: strains that are exact for affine motions on every orthogonal mesh.
// Source: theory/solid.md section 9.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/solid/links/link_store.hpp"
#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// Constants of a link whose face is off the line of its poles.
struct FaceOffset {
  Vec3 pull;    ///< S/D (P_J - P_I), m
  Vec3 offset;  ///< tau: face centroid less the point of that line on the face, m
};
FaceOffset face_offset(Mesh const& mesh, Link const& link);
/// (sum of S/D d d^T over the links of a particle)^+, 1/m3.
Mat3 gradient_inverse(Mesh const& mesh, GlobalId p);

/// Particle gradients H by weighted least squares move volume S n . (H_I + H_J)/2 tau through each link from J to I;
/// forces are the transpose of it. Three more sweeps over the links and two messages a step; on meshes without offsets
/// (Cartesian) none of it. Links keep their coefficients: they may not be damaged.
class ConsistentStrain {
 public:
  /// Rows of `width` doubles per local particle, from owners to ghosts. `entries` of the constructor: poses, the walls
  /// among them.
  using Exchange = std::function<void(std::span<double> rows, std::size_t width)>;
  ConsistentStrain(Mesh const& mesh, LinkStore const& links, std::span<GlobalId const> ids,
                   std::span<std::size_t const> mesh_link, std::size_t entries, Exchange exchange);
  /// Has any face of the mesh an offset? The same on every rank.
  static bool needed(Mesh const& mesh);

  /// Collective among neighbours. Moves volume between particles, m3; right for owned ones and the first layer.
  void move_volume(std::span<Pose const> pose, std::span<double> opened);
  /// Collective among neighbours. Takes the pressures lambda epsilon (Pa) of owned particles to ghosts; add_wrench is
  /// then that of these pressures.
  void take_pressure(std::span<double> pressure);
  void add_wrench(std::span<Pose const> pose, std::span<Wrench> wrench) const;
  LinkWrench<double> wrench(std::size_t link, LinkEnds<double> const& at) const;

  /// What add_wrench depends on besides poses; saved with rejected steps.
  std::vector<double> const& pull() const { return pull_; }
  void set_pull(std::vector<double> pull) { pull_ = std::move(pull); }
  std::size_t bytes() const;

 private:
  struct alignas(32) Block {
    std::array<std::array<double, lanes>, 6> field{};  // pull, offset
  };
  static constexpr std::size_t row = 12;  // three rows of a matrix, each with a fourth number that stays 0
  void times_inverse(std::vector<double>& rows) const;

  LinkStore const& links_;
  Exchange exchange_;
  std::vector<Block> blocks_;
  std::vector<Mat3> inverse_;            // of local particles
  std::vector<double> gradient_, pull_;  // H and dE/dH times the inverse; walls have rows of zeros
};

}  // namespace brisance::solid
