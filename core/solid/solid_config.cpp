#include "core/solid/solid_config.hpp"

#include <algorithm>

#include "core/base/keys.hpp"

namespace brisance::solid {

void MaterialConfig::keys(Keys<MaterialConfig>& k) {
  k("density", &MaterialConfig::density, "kg/m3", "mass density").required().above(0);
  k("young_modulus", &MaterialConfig::young_modulus, "Pa", "Young's modulus").required().above(0);
  k("poisson_ratio", &MaterialConfig::poisson_ratio, "1", "Poisson's ratio").above(-1).below(0.5);
  k("plasticity", &MaterialConfig::plasticity, "", "plastic flow of von Mises; absent: elastic");
}

void LinksConfig::keys(Keys<LinksConfig>& k) {
  k("torsion_ratio", &LinksConfig::torsion_ratio, "1",
    "torsion constant over polar moment of a rod one particle wide: 1 circle, 0.843462 square")
      .above(0)
      .at_most(1);
  k("volumetric", &LinksConfig::volumetric, "",
    "consistent: volumetric strains exact on all Voronoi meshes, a step 2.6 times as dear; recommended there for "
    "poisson_ratio >= 0.4. basic: exact on Cartesian cells, G 0.1 % high at 0.3 and 0.5 % at 0.45 on centroidal "
    "Voronoi "
    "cells, several % on irregular ones")
      .one_of({"basic", "consistent"});
}

void MotionConfig::keys(Keys<MotionConfig>& k) {
  k("cfl", &MotionConfig::cfl, "1", "fraction of the stable step").above(0).at_most(1);
  k("step", &MotionConfig::step, "",
    "stable step: guaranteed = bound of every particle; sharp = 0.95 of the limit of the whole solid, estimated once "
    "by 30 Lanczos products")
      .one_of({"guaranteed", "sharp"});
  k("multirate", &MotionConfig::multirate, "",
    "stiff parts of the solid take several steps while the others take one; absent = one step for all");
}

void MultirateConfig::keys(Keys<MultirateConfig>& k) {
  k("levels", &MultirateConfig::levels, "", "at most so many different steps, each twice the next")
      .at_least(2)
      .at_most(8);
}

void BodyConfig::keys(Keys<BodyConfig>& k) {
  k("name", &BodyConfig::name, "", "name in messages and results");
  k("material", &BodyConfig::material, "",
    "one of solid.material; may be left out for a mesh whose physical volumes bear the names of materials");
  k("shape", &BodyConfig::shape, "", "geometric shape")
      .one_of({"box", "plate", "prism", "cylinder", "tube", "sphere", "shell", "mesh"});
  k("tessellation", &BodyConfig::tessellation, "",
    "how the shape is cut into convex particles; not given: cartesian, or for a mesh: the elements of a .msh, voronoi "
    "in "
    "a convex surface, tetrahedra in another")
      .one_of({"cartesian", "polar", "voronoi", "elements", "tetrahedra"});
  k("mesh", &BodyConfig::mesh, "", "mesh: the file and how to take it");
  k("low", &BodyConfig::low, "m", "box, prism: lower corner");
  k("high", &BodyConfig::high, "m", "box, prism: upper corner");
  k("centre", &BodyConfig::centre, "m", "plate, cylinder, tube, sphere, shell: centre");
  k("axis", &BodyConfig::axis, "1", "cylinder, tube: axis; plate: normal");
  k("radius", &BodyConfig::radius, "m", "cylinder, sphere: radius").above(0);
  k("inner_radius", &BodyConfig::inner_radius, "m", "tube, shell: inner radius").above(0);
  k("outer_radius", &BodyConfig::outer_radius, "m", "tube, shell: outer radius").above(0);
  k("length", &BodyConfig::length, "m", "cylinder, tube: length along the axis; plate: first side").above(0);
  k("width", &BodyConfig::width, "m", "plate: second side").above(0);
  k("thickness", &BodyConfig::thickness, "m", "plate: thickness along its normal").above(0);
  k("phase", &BodyConfig::phase, "rad", "polar: angle of the first corner about the axis");
  k("corners", &BodyConfig::corners, "m",
    "prism: x, y of its corners, counter-clockwise; cartesian: one convex particle");
  k("cells", &BodyConfig::cells, "", "cartesian: particles along each side; polar: radial, around, axial").at_least(1);
  k("layers_x", &BodyConfig::layers_x, "",
    "cartesian box: relative thicknesses of the layers of particles along x, instead of equal ones");
  k("layers_y", &BodyConfig::layers_y, "", "the same along y");
  k("layers_z", &BodyConfig::layers_z, "", "the same along z");
  k("particles", &BodyConfig::particles, "", "voronoi: number of particles").at_least(1);
  k("seed", &BodyConfig::seed, "", "voronoi: seed of the generators");
  k("lloyd", &BodyConfig::lloyd, "", "voronoi: sweeps that move generators to the centres of their cells").at_least(0);
  k("velocity", &BodyConfig::velocity, "m/s", "initial velocity");
  k("spin", &BodyConfig::spin, "rad/s", "initial angular velocity about the centre of mass");
  k("initial_velocity", &BodyConfig::initial_velocity, "", "velocities of parts of the body, or linear in space");
  k("hold", &BodyConfig::hold, "", "boxes: particles with their centre inside are fixed");
  k("clamp", &BodyConfig::clamp, "",
    "boxes: boundary faces that lie inside are tied to a rigid wall, at rest or moving, by half links");
  k("clamp_groups", &BodyConfig::clamp_groups, "",
    "physical surfaces of mesh files (2D: curves) whose faces are tied to a rigid wall at rest");
  k("symmetry_groups", &BodyConfig::symmetry_groups, "", "physical surfaces that lie in a plane of symmetry");
  k("symmetry", &BodyConfig::symmetry, "",
    "boxes: boundary faces that lie inside slide on their own plane, beyond which the body goes on as its mirror "
    "image");
  k("periodic", &BodyConfig::periodic, "",
    "box of cartesian cells: directions in which its ends are linked to each other")
      .one_of({"x", "y", "z"});
  k("prescribed", &BodyConfig::prescribed, "",
    "boxes: particles with their centre inside move as one rigid body, as prescribed");
}

bool SolidConfig::breaks() const {
  return fracture || std::any_of(material.begin(), material.end(), [](auto const& named) {
           return named.second.plasticity && named.second.plasticity->failure;
         });
}

void SolidConfig::keys(Keys<SolidConfig>& k) {
  k("material", &SolidConfig::material, "", "materials by name");
  k("body", &SolidConfig::body, "", "bodies; they may touch, not overlap");
  k("bond", &SolidConfig::bond, "", "bodies that touch and are glued together");
  k("links", &SolidConfig::links, "", "elastic links between the particles of a body");
  k("motion", &SolidConfig::motion, "", "time integration of the particles");
  k("gravity", &SolidConfig::gravity, "m/s2", "acceleration of gravity");
  k("fracture", &SolidConfig::fracture, "", "links weaken and break by the criteria of its laws");
  k("damping", &SolidConfig::damping, "", "damping of the particles, such as for a state at rest under dead loads");
  k("pressure", &SolidConfig::pressure, "", "pressures on boundary faces");
  k("traction", &SolidConfig::traction, "", "forces per area on boundary faces");
  k("blast", &SolidConfig::blast, "", "air blasts of charges of TNT on boundary faces, by published tables: no fluid");
  k("point_force", &SolidConfig::point_force, "", "forces at points");
  k("moment_tensor", &SolidConfig::moment_tensor, "", "seismic sources");
  k("absorbing", &SolidConfig::absorbing, "", "boundary faces that let plane waves out");
  k("contact", &SolidConfig::contact, "", "contact between bodies and between fragments");
  k("sleep", &SolidConfig::sleep, "", "parts at rest that nothing has reached yet are skipped: the same bits, faster");
}

}  // namespace brisance::solid
