// Plastic strain in the link network: what it adds to forces and energies, and the stress that drives it.
#pragma once
#include <span>
#include <vector>

#include "core/solid/links/link_store.hpp"
#include "core/solid/mesh.hpp"
#include "core/solid/plasticity/offset_law.hpp"
#include "core/solid/plasticity/symmetric.hpp"

namespace brisance::solid {

/// The plastic strains of the particles of a rank (reference frame, traceless) and the offsets they give the links.
/// Sweeps go over blocks in which some link has an offset; the elastic passes know nothing of it.
/// Source: theory/solid.md section 16 (a).
class PlasticStrain {
 public:
  /// `ids`: global id of every local particle; `mesh_link`: place of every local link in Mesh::links.
  PlasticStrain(Mesh const& mesh, LinkStore const& links, std::span<GlobalId const> ids,
                std::span<std::size_t const> mesh_link);

  std::span<Symmetric const> strain() const { return std::span(strain_).first(particles_); }  ///< of local particles
  /// `follow` afterwards.
  void set_strain(Index particle, Symmetric const& strain) {
    auto const p = static_cast<std::size_t>(particle);
    if (strain_[p] == strain) return;
    strain_[p] = strain;
    changed_[p] = some_changed_ = 1;
  }
  /// Offsets of links and openings of particles for the present strains.
  void follow();
  /// Takes note that the share `lost` of the face of a link is free on both sides; `follow` afterwards.
  void free_share(std::size_t link, Real lost);

  /// Volumes that plastic strain opens at free faces, m3: S d n.e n.
  void add_opened_volume(std::span<double> opened) const;
  /// `gaps`: of all links or empty; what plastic strain opens is taken out of them, so that criteria see stress.
  void add_wrench(std::span<Pose const> pose, std::span<Wrench> wrench, std::span<GapBlock> gaps = {}) const;
  LinkWrench<double> wrench(std::size_t link, LinkEnds<double> const& at) const;
  /// What is added to the elastic energy of a link and of a particle, J.
  Real link_energy(std::size_t link, LinkEnds<double> const& at) const;
  Real slab_energy(Index particle) const;

  /// V sigma_d = -dE/de of the first `count` particles, J, before it is made a deviator. `pressure`: lambda epsilon,
  /// Pa. Tractions on free faces add theirs: see add_traction.
  /// `same_poses`: those of the last call; the sweep over links is then left out when nothing else has changed either.
  void driving_stress(std::span<Pose const> pose, std::span<double const> pressure, std::span<Symmetric> to,
                      bool same_poses);
  Real volume(Index particle) const { return slab_[static_cast<std::size_t>(particle)].volume; }
  std::size_t bytes() const;

 private:
  void find_ends(std::span<GlobalId const> ids);
  void sum_links(std::span<Pose const> pose);
  struct alignas(32) OffsetBlock {
    std::array<std::array<double, lanes>, 8> field{};  // normal, reach_i, reach_j, offset
    bool strained = false;                             // some offset of the block is not zero
  };
  /// A tensor with room for two additions of four numbers.
  struct alignas(64) Tensor {
    std::array<double, 8> c{};
  };
  /// In 2D and 1D the sides of the slab are rigid walls: half links that never open.
  struct Slab {
    Real volume, shear;
  };
  static LinkOffset<Lanes> read(OffsetBlock const& b);
  LinkOffset<double> offset_of(std::size_t link) const;
  void gather_free_faces(std::size_t particle);

  Mesh const& mesh_;
  LinkStore const& links_;
  std::vector<GlobalId> ids_;
  std::vector<std::size_t> mesh_link_;
  std::size_t particles_;
  std::vector<Symmetric> strain_;
  std::vector<char> changed_;        // since the last follow
  std::vector<Index> strained_end_;  // of each link, the particle with the strain of its second end; -1: none
  std::vector<char> mirrored_;       // of each link: its second end is the mirror image of the first
  /// Images shifted by a period: the entry of the poses and the particle it is an image of.
  struct Image {
    Index entry, of;
  };
  std::vector<Image> images_;
  char some_changed_ = 0;
  std::vector<Symmetric> free_faces_;  // sum of S d n n over free faces and free shares of links, m3
  std::vector<Real> lost_;             // of the links; empty while all are whole
  std::vector<Slab> slab_;
  std::vector<OffsetBlock> blocks_;
  std::vector<Tensor> link_sum_;  // of the links of each particle, in the driving stress
  bool links_changed_ = true;     // since the last sum
};

}  // namespace brisance::solid
