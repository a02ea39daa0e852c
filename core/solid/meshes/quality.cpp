#include "core/solid/meshes/quality.hpp"
#include "core/base/place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "core/solid/meshes/element_mesh.hpp"
#include "core/solid/meshes/layers.hpp"
#include "core/solid/solid.hpp"

// Scalar Eigen: small systems, and GCC 12 warns about its own AVX-512 header otherwise.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
std::size_t at(GlobalId i) { return static_cast<std::size_t>(i); }

void keep(Worst& worst, Real value, GlobalId particle) {
  if (value > worst.value || worst.particle < 0) worst = {value, particle};
}

/// Longest over shortest semi-axis of the ellipsoid with the moments of a particle, in the dimensions of the run.
Real aspect_of(Shape const& s, int dimension) {
  Eigen::MatrixXd k(dimension, dimension);
  for (int r = 0; r < dimension; ++r)
    for (int c = 0; c < dimension; ++c) k(r, c) = s.second[r][c];
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const axes(k, Eigen::EigenvaluesOnly);
  return std::sqrt(axes.eigenvalues().maxCoeff() / axes.eigenvalues().minCoeff());
}

/// Sets of particles joined by links.
GlobalId count_parts(Mesh const& mesh, Index body) {
  std::vector<GlobalId> parent(at(mesh.size()));
  std::iota(parent.begin(), parent.end(), GlobalId{0});
  auto root = [&](GlobalId p) {
    while (parent[at(p)] != p) p = parent[at(p)] = parent[at(parent[at(p)])];
    return p;
  };
  for (Link const& l : mesh.links)
    if (l.j != Link::wall) parent[at(root(l.j))] = root(l.i);
  GlobalId parts = 0;
  for (GlobalId p = 0; p < mesh.size(); ++p) parts += mesh.particle(p).body == body && root(p) == p;
  return parts;
}

/// Is the particle as thick as the body in just one direction, and does it have neighbours in another two (2D: one)?
bool spans_a_layer(Mesh const& mesh, GlobalId p) {
  std::vector<Vec3> across;
  auto const faces = mesh.free_faces_of(p);
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      Vec3 const n = mesh.face(p, faces[a].face).normal, m = mesh.face(p, faces[b].face).normal;
      if (dot(n, m) > -0.9) continue;
      bool const known =
          std::any_of(across.begin(), across.end(), [&](Vec3 const& w) { return std::abs(dot(w, n)) > 0.7; });
      if (!known) across.push_back(n);
    }
  return across.size() == 1 && static_cast<int>(mesh.links_of(p).size()) >= mesh.dimension - 1;
}

/// Edges at which two boundary faces form an inward right angle, over the number of boundary faces; 0 unless all
/// boundary faces look along three common axes.
Real count_stairs(Mesh const& mesh, Index body) {
  std::vector<Vec3> axes;
  struct Edge {
    Vec3 middle, along, normal, centroid;
  };
  std::vector<Edge> edges;
  std::vector<Vec3> place;
  GlobalId faces = 0;
  for (FreeFace const& free : mesh.free_faces) {
    Particle const& particle = mesh.particle(free.particle);
    if (particle.body != body) continue;
    ++faces;
    FaceGeometry const& f = mesh.face(free.particle, free.face);
    bool known = false;
    for (Vec3 const& a : axes) known = known || std::abs(dot(a, f.normal)) > 1 - 1e-9;
    if (!known) axes.push_back(f.normal);
    if (axes.size() > 3) return 0;
    Polyhedron const& shape = mesh.shape(free.particle).polyhedron;
    auto const& loop = shape.faces[at(free.face)];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Vec3 const a = shape.vertices[at(loop[k])], b = shape.vertices[at(loop[(k + 1) % loop.size()])];
      if (mesh.dimension == 2 && std::abs(a.z - b.z) < 0.5) continue;  // edges in the plane belong to the sides
      edges.push_back({particle.centre + 0.5 * (a + b), b - a, f.normal, particle.centre + f.centroid});
    }
  }
  for (Edge const& e : edges) place.push_back(e.middle);
  if (faces == 0) return 0;
  std::map<std::array<std::int64_t, 3>, std::vector<std::size_t>> at_place;
  GlobalId inward = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    Real const width = 1e-4 * norm(edges[e].along);
    std::array<std::int64_t, 3> key;
    for (int d = 0; d < 3; ++d) key[at(d)] = std::llround(place[e][d] / width);
    for (std::size_t o : at_place[key]) {
      if (std::abs(dot(edges[o].normal, edges[e].normal)) > 0.5) continue;
      // Inward: the middle of one face lies in front of the other.
      if (dot(edges[o].centroid - edges[e].centroid, edges[e].normal) > 0) ++inward;
    }
    at_place[key].push_back(e);
  }
  return static_cast<Real>(inward) / static_cast<Real>(faces);
}

}  // namespace

std::vector<MeshQuality> measure_quality(Mesh const& mesh, GlobalId patch) {
  std::vector<MeshQuality> all(mesh.bodies.size());
  std::vector<Real> volume(all.size(), 0), offsets(all.size(), 0), count(all.size(), 0), layers(all.size(), 0);
  for (std::size_t b = 0; b < all.size(); ++b) all[b].body = static_cast<Index>(b);
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    auto const b = at(mesh.particle(p).body);
    volume[b] += mesh.shape(p).volume;
    keep(all[b].aspect, mesh.dimension == 1 ? 1 : aspect_of(mesh.shape(p), mesh.dimension), p);
    Real const nu = mesh.material(p).poisson_ratio;
    if (std::abs(nu) > std::abs(all[b].poisson_ratio)) all[b].poisson_ratio = nu;
    layers[b] += spans_a_layer(mesh, p);
  }
  for (Link const& link : mesh.links) {
    if (link.j == Link::wall) continue;
    auto const b = at(mesh.particle(link.i).body);
    FaceGeometry const& f = mesh.face(link.i, link.face_i);
    Vec3 const from = mesh.particle(link.i).centre + mesh.shape(link.i).pole;
    Vec3 const line = mesh.particle(link.j).centre + mesh.shape(link.j).pole + mesh.shift(link) - from;
    Real const angle = std::atan2(norm(cross(line, f.normal)), dot(line, f.normal));
    keep(all[b].angle, angle * 180 / std::numbers::pi, link.i);
    Real const share = face_distance(mesh, link, link.i) / link.rest_length;
    offsets[b] += norm2(mesh.particle(link.i).centre + f.centroid - from - share * line);
    ++count[b];
  }
  for (MeshQuality& q : all) {
    auto const b = at(q.body);
    auto const particles = static_cast<Real>(mesh.bodies[b].particles);
    Real const spacing = std::pow(volume[b] / particles, 1.0 / mesh.dimension);
    q.offset = count[b] > 0 ? std::sqrt(offsets[b] / count[b]) / spacing : 0;
    q.single_layer = layers[b] / particles;
    q.rod_layers = layers_across_a_rod(mesh, q.body);
    if (mesh.bodies[b].whole_volume > 0) q.volume = volume[b] / mesh.bodies[b].whole_volume - 1;
    q.parts = count_parts(mesh, q.body);
    q.stairs = mesh.dimension > 1 ? count_stairs(mesh, q.body) : 0;
    if (mesh.dimension == 1 || count[b] == 0 || (q.offset < 1e-8 && q.angle.value < 1e-5)) continue;
    Patch const piece(mesh, q.body, patch);
    if (piece.size() < 8) continue;
    q.patch = piece.size();
    q.moduli = measure_moduli(piece, q.poisson_ratio, 1e-6);
  }
  return all;
}

std::string describe(MeshQuality const& q, Mesh const& mesh) {
  std::string text = fmt::format(
      "{} particles; worst angle of a face to the line of poles {:.2g} degrees; face offset {:.2g} h "
      "(rms); worst aspect ratio {:.3g}",
      mesh.bodies[at(q.body)].particles, q.angle.value, q.offset, q.aspect.value);
  if (std::abs(q.volume) > 1e-6) text += fmt::format("; volume {:+.2f} % of the shape", 100 * q.volume);
  if (!q.moduli)
    return text + (q.patch == 0 && q.offset < 1e-8 && q.angle.value < 1e-5 ? "; homogeneous strains are exact" : "");
  text += fmt::format("; a patch of {} of them at nu = {:.3g}:", q.patch, q.poisson_ratio);
  if (q.moduli->stretch) text += fmt::format(" E {:+.2f} %", 100 * q.moduli->young);
  if (q.moduli->shearing) text += fmt::format(" G {:+.2f} %", 100 * q.moduli->shear);
  if (q.moduli->squeeze) text += fmt::format(" nu {:+.3f}", q.moduli->poisson);
  return text + fmt::format(", scatter {:.2g} % of the strain", 100 * q.moduli->scatter);
}

std::vector<std::string> warnings(MeshQuality const& q, Mesh const& mesh) {
  std::vector<std::string> list;
  auto where = [&](Worst const& w) {
    return fmt::format("particle {} at {}", w.particle, place_text(mesh.particle(w.particle).centre));
  };
  if (q.parts > 1)
    list.push_back(
        fmt::format("it consists of {} parts that no link joins: check the faces between them, or give "
                    "them as bodies of their own",
                    q.parts));
  if (std::abs(q.volume) > 0.02)
    list.push_back(
        fmt::format("its particles have {:+.1f} % of the volume of the shape: use more of them, or another density",
                    100 * q.volume));
  if (q.angle.value > 10)
    list.push_back(
        fmt::format("a face of {} is {:.0f} degrees off the line of poles: such meshes are a few per cent off, "
                    "at any size; fill the body with Voronoi cells if that is too much",
                    where(q.angle), q.angle.value));
  if (q.moduli && max(std::abs(q.moduli->young), std::abs(q.moduli->shear)) > 0.02)
    list.push_back(
        fmt::format("its effective moduli are off by up to {:.1f} %: use Voronoi cells with 10 to 30 sweeps of "
                    "Lloyd, or bricks",
                    100 * max(std::abs(q.moduli->young), std::abs(q.moduli->shear))));
  if (q.moduli && !q.moduli->converged)
    list.push_back("the patch of it did not come to rest: the figures of the moduli are not to be trusted");
  if (q.aspect.value > 10)
    list.push_back(fmt::format("{} is {:.0f} times longer than wide", where(q.aspect), q.aspect.value));
  if (q.single_layer > 0.5 && q.poisson_ratio != 0)
    list.push_back(fmt::format(
        "{:.0f} % of it is a plate or shell of one layer: with nu = {:.3g} its bending stiffness is E t^3/12, {:.0f} % "
        "too low, and curvatures do not couple; use two layers or more",
        100 * q.single_layer, q.poisson_ratio, 100 * square(q.poisson_ratio)));
  if (Real const excess = stiffening_of_a_rod(q.poisson_ratio, q.rod_layers); excess > 0.05)
    list.push_back(
        fmt::format("it is a rod of {} particles across: with nu = {:.3g} that is about {:.0f} % too stiff in bending "
                    "(cubes), since each layer has one strain across; one layer is exact, {} would be {:.0f} % off",
                    q.rod_layers, q.poisson_ratio, 100 * excess, 2 * q.rod_layers,
                    100 * stiffening_of_a_rod(q.poisson_ratio, 2 * q.rod_layers)));
  if (q.stairs > 0.15)
    list.push_back(
        fmt::format("its boundary is a staircase ({:.0f} inward corners in 100 faces): a curved body made of "
                    "bricks is first order and weak in shear (-6 % on a sphere of 9 cells a radius); use fitted "
                    "Voronoi cells",
                    100 * q.stairs));
  return list;
}

StepLimit describe_step_limit(Solid const& solid) {
  std::vector<double> steps;
  GlobalId limiting = -1;
  Real least = 1e300;
  auto const limits = solid.step_limits();
  for (std::size_t l = 0; l < limits.size(); ++l) {
    if (limits[l] >= 1e300) continue;
    steps.push_back(limits[l]);
    if (limits[l] < least) least = limits[l], limiting = solid.id(static_cast<Index>(l));
  }
  if (steps.empty()) return {};
  auto const middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  Mesh const& mesh = solid.mesh();
  Particle const& p = mesh.particle(limiting);
  return {
      fmt::format("particle {} of \"{}\" at {} allows the shortest step: {:.3g} s, {:.2g} times the median of {:.3g} s",
                  limiting, mesh.bodies[at(p.body)].name, place_text(p.centre), least, least / *middle, *middle),
      least / *middle};
}

}  // namespace brisance::solid
