#include "core/solid/mesh_build/links.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/solid/bonds.hpp"

namespace brisance::solid {
namespace {

/// The face of a cell behind which `other` lies; `twin` is its centroid seen from the other cell (a pair of cells may
/// share several faces).
int face_towards(Cells const& cells, std::size_t c, Index other, Vec3 const& twin) {
  Shape const& s = cells.shapes[static_cast<std::size_t>(cells.shape[c])];
  int best = -1;
  Real nearest = 0;
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    if (cells.neighbour[cells.first[c] + f] != other) continue;
    Real const d = norm2(cells.centre[c] + s.faces[f].centroid - twin);
    if (best < 0 || d < nearest) best = static_cast<int>(f), nearest = d;
  }
  return best;
}

/// Link of two half links in series; the weights are by compliance, which of one material are those by distance.
/// Source: theory/solid.md section 1.
/// `shift`: of q across a periodic side, whose place in Mesh::far_sides is `far`.
Link series_link(Mesh const& mesh, GlobalId p, int face, GlobalId q, int twin, Vec3 const& shift, Index far) {
  FaceGeometry const& f = mesh.face(p, face);
  Vec3 const place = mesh.particle(p).centre + f.centroid;
  Vec3 const pole_i = mesh.particle(p).centre + mesh.shape(p).pole,
             pole_j = mesh.particle(q).centre + mesh.shape(q).pole + shift;
  Real const length = dot(pole_j - pole_i, f.normal), near = dot(place - pole_i, f.normal);
  Real const shear_i = mesh.material(p).shear(), shear_j = mesh.material(q).shear();
  if (shear_i == shear_j) return {p, q, face, twin, length, near / length, 2 * shear_i * f.area / length, far};
  Real const give_i = near / shear_i, give_j = (length - near) / shear_j;
  return {p, q, face, twin, length, give_i / (give_i + give_j), 2 * f.area / (give_i + give_j), far};
}

void index_links(Mesh& mesh) {
  auto const n = mesh.particles.size();
  // Links of one particle: by (i, j), the walls after all others.
  std::sort(mesh.links.begin(), mesh.links.end(), [n](Link const& a, Link const& b) {
    auto const key = [n](Link const& l) { return l.j == Link::wall ? static_cast<GlobalId>(n) : l.j; };
    return std::tuple(a.i, key(a), a.face_i) < std::tuple(b.i, key(b), b.face_i);
  });
  mesh.first_link.assign(n + 1, 0);
  auto for_each_end = [&](auto&& visit) {
    for (std::size_t l = 0; l < mesh.links.size(); ++l) {
      visit(static_cast<std::size_t>(mesh.links[l].i), l);
      if (mesh.links[l].j != Link::wall) visit(static_cast<std::size_t>(mesh.links[l].j), l);
    }
  };
  for_each_end([&](std::size_t p, std::size_t) { ++mesh.first_link[p + 1]; });
  for (std::size_t p = 0; p < n; ++p) mesh.first_link[p + 1] += mesh.first_link[p];
  mesh.link_of.resize(mesh.first_link[n]);
  auto next = mesh.first_link;
  for_each_end([&](std::size_t p, std::size_t l) { mesh.link_of[next[p]++] = l; });
}

/// The cell beyond a face of a periodic box, and the shift of its image.
struct Beyond {
  Index cell;
  Vec3 shift;
};
std::optional<Beyond> beyond(BodyConfig const& body, std::size_t cell, FaceGeometry const& face) {
  for (std::string const& axis : body.periodic) {
    int const d = axis[0] - 'x';
    if (std::abs(face.normal[d]) < 0.5) continue;
    Index const n = body.cells[static_cast<std::size_t>(d)];
    Index const stride = d == 0 ? 1 : d == 1 ? body.cells[0] : body.cells[0] * body.cells[1];
    Index const side = face.normal[d] > 0 ? 1 : -1;
    Vec3 shift{};
    shift[d] = static_cast<Real>(side) * ((*body.high)[d] - (*body.low)[d]);
    return Beyond{static_cast<Index>(cell) - side * (n - 1) * stride, shift};
  }
  return std::nullopt;
}

}  // namespace

void connect(Mesh& mesh, Draft const& draft, SolidConfig const& config, std::vector<GlobalId> const& number,
             Supports& supports) {
  std::vector<std::size_t> draft_of(mesh.particles.size());
  for (std::size_t a = 0; a < number.size(); ++a) draft_of[static_cast<std::size_t>(number[a])] = a;
  mesh.first_free.assign(1, 0);
  auto const bonds = find_bonds(config, draft.cells, draft.offset, mesh.dimension);
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    std::size_t const a = draft_of[static_cast<std::size_t>(p)];
    auto const b = static_cast<std::size_t>(draft.body_of[a]);
    Cells const& cells = draft.cells[b];
    std::size_t const c = draft.cell_of[a];
    Shape const& s = mesh.shape(p);
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      if (is_side_of_slab(s.faces[f], mesh.dimension)) continue;
      int const face = static_cast<int>(f);
      Index other = cells.neighbour[cells.first[c] + f];
      std::optional<Beyond> const wrapped = other < 0 ? beyond(config.body[b], c, s.faces[f]) : std::nullopt;
      if (wrapped) other = wrapped->cell;
      if (other >= 0 && config.links) {
        auto const o = static_cast<std::size_t>(other);
        GlobalId const q = number[draft.offset[b] + o];
        if (q < p) continue;  // made from its other end
        Vec3 const shift = wrapped ? wrapped->shift : Vec3{};
        Vec3 const place = mesh.particle(p).centre + s.faces[f].centroid;
        // Across a periodic side the twin is the face that looks the other way.
        int const twin = wrapped ? static_cast<int>(f ^ 1U) : face_towards(cells, o, static_cast<Index>(c), place);
        if (twin < 0) continue;  // a sliver of a face that rounding left on one side only
        mesh.links.push_back(series_link(mesh, p, face, q, twin, shift, wrapped ? supports.shifted(shift) : -1));
        continue;
      }
      if (auto const bond = bonds.find({a, face}); bond != bonds.end()) {
        GlobalId const q = number[bond->second.cell];
        if (q > p) mesh.links.push_back(series_link(mesh, p, face, q, bond->second.face, {}, -1));
        continue;
      }
      FreeFace free{p, face, dot(s.faces[f].centroid - s.pole, s.faces[f].normal), false};
      if (auto const link = supports.link(b, p, free)) {
        free.clamped = true;
        mesh.links.push_back(*link);
      }
      mesh.free_faces.push_back(free);
    }
    mesh.first_free.push_back(mesh.free_faces.size());
  }
  index_links(mesh);
}

}  // namespace brisance::solid
