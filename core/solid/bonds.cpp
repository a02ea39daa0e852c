#include "core/solid/bonds.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/keys.hpp"
#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {
namespace {

struct Boundary {
  Real key;  // place along a direction in which no two faces of a regular mesh agree
  std::size_t body;
  CellFace face;
  Vec3 centroid, normal;
  Real size;
};

void add_boundary(Cells const& cells, std::size_t body, std::size_t offset, int dimension, std::vector<Boundary>& to) {
  for (std::size_t c = 0; c < cells.count(); ++c) {
    Shape const& s = cells.shapes[static_cast<std::size_t>(cells.shape[c])];
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      if (cells.neighbour[cells.first[c] + f] >= 0 || is_side_of_slab(s.faces[f], dimension)) continue;
      Vec3 const at = cells.centre[c] + s.faces[f].centroid;
      to.push_back({dot(at, {0.57163, 0.68917, 0.44527}),
                    body,
                    {offset + c, static_cast<int>(f)},
                    at,
                    s.faces[f].normal,
                    std::sqrt(s.faces[f].area)});
    }
  }
}

bool on_each_other(Boundary const& a, Boundary const& b) {
  return a.body != b.body && norm(a.centroid - b.centroid) <= 1e-6 * a.size &&
         std::abs(a.size - b.size) <= 1e-6 * a.size && norm(a.normal + b.normal) <= 1e-6;
}

}  // namespace

void BondConfig::keys(Keys<BondConfig>& k) {
  k("bodies", &BondConfig::bodies, "", "names of bodies; their faces that lie on each other are linked").required();
}

std::map<CellFace, CellFace> find_bonds(SolidConfig const& config, std::span<Cells const> cells,
                                        std::span<std::size_t const> offset, int dimension) {
  std::map<CellFace, CellFace> partner;
  for (BondConfig const& bond : config.bond) {
    require(config.links.has_value(), bond.at,
            "solid.bond glues by links, and the scene has none: add links = {} to [solid].");
    require(bond.bodies.size() > 1, bond.at, "solid.bond needs two bodies or more.");
    std::vector<Boundary> faces;
    std::vector<std::size_t> glued;
    for (std::string const& name : bond.bodies) {
      auto const found = std::find_if(config.body.begin(), config.body.end(),
                                      [&](BodyConfig const& body) { return body.name == name; });
      if (found == config.body.end()) {
        std::vector<std::string> names;
        for (BodyConfig const& body : config.body) names.push_back(body.name);
        scene_error(bond.at,
                    "solid.bond: no body is called \"" + name + "\"; did you mean \"" + nearest(name, names) + "\"?");
      }
      auto const b = static_cast<std::size_t>(found - config.body.begin());
      require(std::find(glued.begin(), glued.end(), b) == glued.end(), bond.at,
              "solid.bond names the body \"" + name + "\" twice.");
      glued.push_back(b);
      add_boundary(cells[b], b, offset[b], dimension, faces);
    }
    std::sort(faces.begin(), faces.end(), [](Boundary const& a, Boundary const& b) {
      return std::tuple(a.key, a.face) < std::tuple(b.key, b.face);
    });
    std::vector<char> matched(config.body.size(), 0);
    for (std::size_t a = 0; a < faces.size(); ++a)
      for (std::size_t b = a + 1; b < faces.size() && faces[b].key - faces[a].key <= 2e-6 * faces[a].size; ++b) {
        if (!on_each_other(faces[a], faces[b])) continue;
        partner[faces[a].face] = faces[b].face;
        partner[faces[b].face] = faces[a].face;
        matched[faces[a].body] = matched[faces[b].body] = 1;
      }
    for (std::size_t const b : glued)
      require(
          matched[b] != 0, bond.at,
          "solid.bond: no face of body \"" + config.body[b].name +
              "\" lies on an equal face of the others. Bonds join whole faces: let the bodies touch and cut them so "
              "that the faces of their particles match (cartesian cells of the same size, or one mesh file).");
  }
  return partner;
}

}  // namespace brisance::solid
