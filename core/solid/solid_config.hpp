// What a scene says about its solid: materials, bodies, how they are cut into particles and held.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/location.hpp"
#include "core/base/vec3.hpp"
#include "core/solid/bonds.hpp"
#include "core/solid/contact/contact_config.hpp"
#include "core/solid/damping/damping_config.hpp"
#include "core/solid/fracture/fracture_config.hpp"
#include "core/solid/loads/load_config.hpp"
#include "core/solid/meshes/mesh_file_config.hpp"
#include "core/solid/plasticity/plasticity_config.hpp"
#include "core/solid/supports/support_config.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// Isotropic elastic material.  Units: kg/m3, Pa, 1.
struct MaterialConfig {
  Real density = 0, young_modulus = 0, poisson_ratio = 0;
  Location at;
  std::optional<PlasticityConfig> plasticity{};
  static void keys(Keys<MaterialConfig>& k);
};

/// Elastic links between the particles of a body; absent = free rigid particles.
struct LinksConfig {
  Real torsion_ratio = 1;            ///< kappa of theory/solid.md section 8
  std::string volumetric = "basic";  ///< or "consistent", theory/solid.md section 9
  static void keys(Keys<LinksConfig>& k);
};

/// Multi-rate steps: parts of the solid take 1, 2, 4 ... steps in one.
struct MultirateConfig {
  int levels = 3;  ///< at most so many different steps
  Location at;
  static void keys(Keys<MultirateConfig>& k);
};

/// Time integration of the particles.
struct MotionConfig {
  Real cfl = 0.9;                   ///< fraction of the stable step
  std::string step = "guaranteed";  ///< which stable step: the bound of each particle, or "sharp"
  std::optional<MultirateConfig> multirate;
  Location at;
  static void keys(Keys<MotionConfig>& k);
};

/// One body: a shape, its dimensions, and the tessellation that cuts it into convex particles.
/// In 2D bodies are prisms over 0 <= z <= 1 m; in 1D slabs over 0 <= y, z <= 1 m.
struct BodyConfig {
  std::string name = "body", material, shape = "box";  // material: may come from the groups of a mesh file
  std::optional<std::string> tessellation;             // cartesian; of a mesh file: elements, voronoi or tetrahedra
  std::optional<MeshFileConfig> mesh;                  // shape "mesh"
  std::optional<Vec3> low, high;                       // box, prism (z only)
  std::optional<Vec3> centre;                          // all others: centre of the shape
  Vec3 axis{0, 0, 1};                                  // cylinder, tube, plate (its normal)
  std::optional<Real> radius;                          // cylinder, sphere
  std::optional<Real> inner_radius, outer_radius;      // tube, shell
  std::optional<Real> length;                          // cylinder, tube: along the axis; plate: first side
  std::optional<Real> width, thickness;                // plate: second side, along the normal
  Real phase = 0;                                      // polar: angle of the first corner, rad
  std::vector<Real> corners;                           // prism: x0, y0, x1, y1, ... counter-clockwise, m
  std::array<Index, 3> cells{1, 1, 1};                 // cartesian: along the sides; polar: radial, around, axial
  std::vector<Real> layers_x, layers_y, layers_z;      // cartesian box: relative thicknesses instead of equal ones
  int particles = 100;                                 // voronoi: how many
  std::int64_t seed = 1;                               // voronoi: of the generators
  int lloyd = 20;                                      // voronoi: sweeps towards centroidal cells
  Vec3 velocity{}, spin{};                             // m/s; rad/s about the mass centre of the body
  std::vector<InitialVelocityConfig> initial_velocity;
  std::vector<HoldConfig> hold, symmetry;       // particles with their centre, boundary faces lying, in a box
  std::vector<DrivenConfig> clamp, prescribed;  // boundary faces, particles
  std::vector<std::string> clamp_groups, symmetry_groups;  // physical surfaces of a mesh file
  std::vector<std::string> periodic;                       // axes
  Location at;
  static void keys(Keys<BodyConfig>& k);
};

struct SolidConfig {
  std::map<std::string, MaterialConfig> material;
  std::vector<BodyConfig> body;
  std::vector<BondConfig> bond;
  std::optional<LinksConfig> links;
  MotionConfig motion;
  std::optional<Vec3> gravity;  ///< m/s2
  std::optional<FractureConfig> fracture;
  bool breaks() const;  ///< may links break?
  std::optional<DampingConfig> damping;
  std::vector<PressureConfig> pressure;
  std::vector<TractionConfig> traction;
  std::vector<BlastConfig> blast;
  std::vector<PointForceConfig> point_force;
  std::vector<MomentTensorConfig> moment_tensor;
  std::vector<AbsorbingConfig> absorbing;
  std::optional<ContactConfig> contact;
  bool sleep = true;  ///< parts that nothing has reached yet are skipped; the bits are the same
  Location at;
  static void keys(Keys<SolidConfig>& k);
};

}  // namespace brisance::solid
