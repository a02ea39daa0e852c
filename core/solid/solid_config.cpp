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
  k("cfl", &MotionConfig::cfl, "1", "fraction of the guaranteed stable step").above(0).at_most(1);
}

void HoldConfig::keys(Keys<HoldConfig>& k) {
  k("low", &HoldConfig::low, "m", "lower corner of the box").required();
  k("high", &HoldConfig::high, "m", "upper corner of the box").required();
}

void PrescribedConfig::keys(Keys<PrescribedConfig>& k) {
  k("low", &PrescribedConfig::low, "m", "lower corner of the box").required();
  k("high", &PrescribedConfig::high, "m", "upper corner of the box").required();
  k("velocity", &PrescribedConfig::velocity, "m/s", "constant velocity of the particles in the box").required();
}

void BodyConfig::keys(Keys<BodyConfig>& k) {
  k("name", &BodyConfig::name, "", "name in messages and results");
  k("material", &BodyConfig::material, "", "one of solid.material").required();
  k("shape", &BodyConfig::shape, "", "geometric shape")
      .one_of({"box", "plate", "prism", "cylinder", "tube", "sphere", "shell"});
  k("tessellation", &BodyConfig::tessellation, "", "how the shape is cut into convex particles")
      .one_of({"cartesian", "polar", "voronoi"});
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
  k("corners", &BodyConfig::corners, "m", "prism: x, y of its corners, counter-clockwise, one convex particle");
  k("cells", &BodyConfig::cells, "", "cartesian: particles along each side; polar: radial, around, axial").at_least(1);
  k("particles", &BodyConfig::particles, "", "voronoi: number of particles").at_least(1);
  k("seed", &BodyConfig::seed, "", "voronoi: seed of the generators");
  k("lloyd", &BodyConfig::lloyd, "", "voronoi: sweeps that move generators to the centres of their cells").at_least(0);
  k("velocity", &BodyConfig::velocity, "m/s", "initial velocity");
  k("spin", &BodyConfig::spin, "rad/s", "initial angular velocity about the centre of mass");
  k("hold", &BodyConfig::hold, "", "boxes: particles with their centre inside are fixed");
  k("clamp", &BodyConfig::clamp, "", "boxes: boundary faces that lie inside are tied to a rigid wall by half links");
  k("prescribed", &BodyConfig::prescribed, "", "boxes: particles with their centre inside move as prescribed");
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
}

}  // namespace brisance::solid
