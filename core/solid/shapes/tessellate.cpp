// From the words of a scene to cells: which tessellation fits which shape, and which dimensions it needs.
#include <numeric>

#include "core/solid/meshes/mesh_body.hpp"
#include "core/solid/shapes/cells.hpp"
#include "core/solid/shapes/domains.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

[[noreturn]] void refuse(BodyConfig const& body, std::string const& what) {
  throw Error(Failure::scene, body.at.text() + ": solid.body \"" + body.name + "\": " + what);
}

template <class T>
void need(BodyConfig const& body, std::optional<T> const& value, char const* key) {
  if (!value) refuse(body, "shape \"" + body.shape + "\" needs the key \"" + key + "\". Add it.");
}

/// The box of a body; in 2D and 1D a slab of unit depth.
void read_box(BodyConfig const& body, int dimension, Vec3& low, Vec3& high) {
  need(body, body.low, "low");
  need(body, body.high, "high");
  low = *body.low, high = *body.high;
  for (int d = dimension; d < 3; ++d) low[d] = 0, high[d] = 1;
  for (int d = 0; d < dimension; ++d)
    if (!(high[d] > low[d])) refuse(body, "its high corner is not above its low one. Exchange or correct them.");
}

Cells tessellate_box(BodyConfig const& body, int dimension) {
  Vec3 low, high;
  read_box(body, dimension, low, high);
  if (body.tessellation == "voronoi")
    return voronoi(axis_box(low, high), body.particles, body.seed, body.lloyd, dimension);
  auto cells = body.cells;
  std::array<std::vector<Real> const*, 3> const layers{&body.layers_x, &body.layers_y, &body.layers_z};
  bool graded = false;
  for (std::size_t d = 0; d < 3; ++d) {
    if (layers[d]->empty()) continue;
    graded = true;
    cells[d] = static_cast<Index>(layers[d]->size());
    for (Real const thickness : *layers[d])
      if (!(thickness > 0))
        refuse(body, std::string("layers_") + "xyz"[d] + " has a thickness that is not above 0. Correct it.");
  }
  for (std::size_t d = static_cast<std::size_t>(dimension); d < 3; ++d)
    if (cells[d] != 1) refuse(body, "more than one layer of cells out of the plane. Give as many cells as dimensions.");
  if (!graded) return cartesian_box(low, high, cells);
  std::array<std::vector<Real>, 3> cuts;
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<Real> const thickness =
        layers[d]->empty() ? std::vector<Real>(static_cast<std::size_t>(cells[d]), 1.0) : *layers[d];
    Real const all = std::accumulate(thickness.begin(), thickness.end(), 0.0);
    Real below = 0;
    int const axis = static_cast<int>(d);
    for (Real const t : thickness) {
      cuts[d].push_back(low[axis] + (high[axis] - low[axis]) * (below / all));
      below += t;
    }
    cuts[d].push_back(high[axis]);
  }
  return graded_box(cuts);
}

Cells tessellate_round(BodyConfig const& body, int dimension) {
  bool const hollow = body.shape == "tube" || body.shape == "shell";
  bool const ball = body.shape == "sphere" || body.shape == "shell";
  need(body, body.centre, "centre");
  Real inner = 0, outer = 0;
  if (hollow) {
    need(body, body.inner_radius, "inner_radius");
    need(body, body.outer_radius, "outer_radius");
    inner = *body.inner_radius, outer = *body.outer_radius;
    if (!(outer > inner)) refuse(body, "its outer radius is not above its inner one. Exchange or correct them.");
  } else {
    need(body, body.radius, "radius");
    outer = *body.radius;
  }
  if (ball && dimension < 3)
    refuse(body, "a " + body.shape + " needs three dimensions. In 2D take a cylinder or a tube.");
  Vec3 centre = *body.centre, axis = body.axis;
  Real length = 1;
  if (!ball && dimension == 3) {
    need(body, body.length, "length");
    length = *body.length;
  }
  if (norm(axis) == 0) refuse(body, "its axis has no direction. Give one, such as [0, 0, 1].");
  if (dimension == 2) axis = {0, 0, 1}, centre.z = 0.5;
  if (body.tessellation == "voronoi") {
    if (ball) return voronoi(ShellDomain(centre, inner, outer), body.particles, body.seed, body.lloyd, 3);
    return voronoi(TubeDomain(centre, axis, inner, outer, length), body.particles, body.seed, body.lloyd, dimension);
  }
  if (body.cells[1] < 3) refuse(body, "fewer than 3 cells around. Give cells = [radial, around, axial].");
  if (ball && body.cells[2] < 2)
    refuse(body, "fewer than 2 cells from pole to pole. Give cells = [radial, around, axial].");
  if (dimension == 2 && body.cells[2] != 1) refuse(body, "cells along the axis make no sense in 2D. Give two numbers.");
  if (ball) return polar_shell(centre, axis, inner, outer, body.phase, body.cells);
  return polar_tube(centre, axis, inner, outer, length, body.phase, body.cells);
}

}  // namespace

Cells tessellate(BodyConfig const& body, int dimension) {
  bool const round =
      body.shape == "cylinder" || body.shape == "tube" || body.shape == "sphere" || body.shape == "shell";
  bool const polar = body.tessellation == "polar";
  if (body.mesh.has_value() != (body.shape == "mesh"))
    refuse(body, body.mesh ? "the key \"mesh\" belongs to shape = \"mesh\". Set the shape, or leave the key out."
                           : "shape \"mesh\" needs the key \"mesh\", such as { file = \"part.msh\" }. Add it.");
  if (dimension == 1 && body.shape != "box") refuse(body, "only a box exists in one dimension.");
  if (body.shape == "mesh") return cells_from_file(body, dimension);
  std::string const tessellation = body.tessellation.value_or("cartesian");
  if (tessellation == "elements" || tessellation == "tetrahedra")
    refuse(body, "tessellation \"" + tessellation +
                     "\" belongs to shape \"mesh\". Take \"cartesian\", \"polar\" or \"voronoi\".");
  if (round && tessellation == "cartesian")
    refuse(body, "a " + body.shape + " cannot be cut into bricks. Take tessellation = \"polar\" or \"voronoi\".");
  if (round) return tessellate_round(body, dimension);
  if (polar) refuse(body, "a " + body.shape + " has no polar cells. Take \"cartesian\" or \"voronoi\".");
  if (body.shape == "prism") {
    if (body.corners.size() < 6 || body.corners.size() % 2)
      refuse(body, "a prism needs x and y of three corners or more in the key \"corners\".");
    Vec3 low{0, 0, 0}, high{0, 0, 1};
    if (dimension == 3) {
      need(body, body.low, "low");
      need(body, body.high, "high");
      low = *body.low, high = *body.high;
    }
    Cells one = prism(body, low.z, high.z);
    if (body.tessellation != "voronoi") return one;
    Polyhedron const whole = translated(one.shapes[0].polyhedron, one.centre[0]);
    if (auto const f = fault(whole)) refuse(body, "Voronoi cells need a convex prism; it is " + f->what + ".");
    return voronoi(inside_of(whole), body.particles, body.seed, body.lloyd, dimension);
  }
  if (body.shape == "plate") {
    if (dimension < 3) refuse(body, "a plate needs three dimensions. In 2D take a box.");
    need(body, body.centre, "centre");
    need(body, body.length, "length");
    need(body, body.width, "width");
    need(body, body.thickness, "thickness");
    if (norm(body.axis) == 0) refuse(body, "its axis has no direction. Give its normal, such as [0, 0, 1].");
    if (body.tessellation == "voronoi")
      return voronoi(plate_box(*body.centre, body.axis, *body.length, *body.width, *body.thickness), body.particles,
                     body.seed, body.lloyd, 3);
    return cartesian_plate(body);
  }
  return tessellate_box(body, dimension);
}

}  // namespace brisance::solid
