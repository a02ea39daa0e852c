#include "core/solid/mesh_build/draft.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/place.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

/// Makes the components out of the plane of a slab exactly zero, so that nothing ever leaks out of it.
void flatten(Shape& s, int dimension) {
  for (int d = dimension; d < 3; ++d) {
    for (Vec3& v : s.polyhedron.vertices) v[d] = v[d] > 0 ? 0.5 : -0.5;
    s.pole[d] = 0;
    auto diagonal_only = [&](Mat3& m) {
      for (int e = 0; e < 3; ++e)
        if (e != d) m[d][e] = m[e][d] = 0;
    };
    diagonal_only(s.second);
    for (FaceGeometry& f : s.faces) {
      if (std::abs(f.normal[d]) > 0.5) continue;
      f.normal[d] = f.centroid[d] = 0;
      diagonal_only(f.second);
    }
  }
}

}  // namespace

Draft tessellate_all(SolidConfig const& config, int dimension) {
  Draft draft;
  for (std::size_t b = 0; b < config.body.size(); ++b) {
    BodyConfig const& body = config.body[b];
    Cells cells = tessellate(body, dimension);
    if (dimension < 3)
      for (Shape& s : cells.shapes) flatten(s, dimension);
    for (std::size_t c = 0; c < cells.count(); ++c) {
      for (int d = dimension; d < 3; ++d) cells.centre[c][d] = 0.5;
      // A shape used by many cells is looked at once, at its first one.
      auto const shape = static_cast<std::size_t>(cells.shape[c]);
      if (!cells.checked && (c == 0 || cells.shapes.size() > 1))
        if (auto const f = fault(cells.shapes[shape].polyhedron))
          throw Error(Failure::scene,
                      body.at.text() + ": solid.body \"" + body.name + "\": cell " + std::to_string(c) + " is " +
                          f->what + " at " + place_text(cells.centre[c] + f->place) +
                          ". Particles must be closed convex polyhedra: change the corners or the cells.");
    }
    draft.offset.push_back(draft.centre.size());
    for (std::size_t c = 0; c < cells.count(); ++c) {
      draft.body_of.push_back(static_cast<Index>(b));
      draft.cell_of.push_back(c);
      draft.centre.push_back(cells.centre[c]);
    }
    draft.cells.push_back(std::move(cells));
  }
  return draft;
}

Index cell_material(BodyConfig const& body, Cells const& cells, std::size_t c,
                    std::map<std::string, Index> const& material_of) {
  if (!body.material.empty()) return material_of.at(body.material);
  std::vector<Index> named;
  std::string names;
  if (!cells.region.empty())
    for (std::string const& name : cells.region_names[static_cast<std::size_t>(cells.region[c])]) {
      names += (names.empty() ? "\"" : ", \"") + name + "\"";
      auto const found = material_of.find(name);
      if (found != material_of.end()) named.push_back(found->second);
    }
  if (named.size() != 1)
    throw Error(Failure::scene,
                body.at.text() + ": solid.body \"" + body.name + "\" has no material, and cell " + std::to_string(c) +
                    " at " + place_text(cells.centre[c]) + " is in " +
                    (names.empty() ? "no physical group" : "the physical groups " + names) + ", of which " +
                    (named.empty() ? "none is" : "several are") +
                    " in solid.material. Give the body a material, or one to each physical group by its name.");
  return named[0];
}

void name_faces(Mesh& mesh, Draft const& draft, std::vector<GlobalId> const& number) {
  for (std::size_t b = 0; b < draft.cells.size(); ++b) {
    Cells const& cells = draft.cells[b];
    for (auto const& [name, slots] : cells.face_groups)
      for (std::size_t slot : slots) {
        auto const next = std::upper_bound(cells.first.begin(), cells.first.end(), slot);
        auto const c = static_cast<std::size_t>(next - cells.first.begin()) - 1;
        mesh.face_groups[name].push_back({number[draft.offset[b] + c], static_cast<int>(slot - cells.first[c])});
      }
  }
  for (auto& [name, faces] : mesh.face_groups) {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  }
}

}  // namespace brisance::solid
