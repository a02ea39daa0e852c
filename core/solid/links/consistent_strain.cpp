// Scalar Eigen: done once, and GCC 12 warns about its own AVX-512 header otherwise.
#define EIGEN_DONT_VECTORIZE
#include "core/solid/links/consistent_strain.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "core/solid/links/link_blocks.hpp"

namespace brisance::solid {
namespace {

using namespace blocks;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Gap in the mean of both body frames.
template <class V>
Triple<V> turned_back(LinkFrame<V> const& frame) {
  return V(0.5) * (frame.r_i.back(frame.gap) + frame.r_j.back(frame.gap));
}

/// Wrench of a force p, constant in the mean of both body frames, per unit of gap.
template <class V>
LinkWrench<V> wrench_of(LinkFrame<V> const& frame, Triple<V> const& p) {
  Triple<V> const p_i = frame.r_i * p, p_j = frame.r_j * p, half_gap = V(0.5) * frame.gap;
  LinkWrench<V> out;
  out.force = V(0.5) * (p_i + p_j);
  out.torque_i = cross_add(frame.a_i, out.force, cross(half_gap, p_i));
  out.torque_j = cross_add(frame.a_j, out.force, cross(p_j, half_gap));
  return out;
}

double const* rows_of(std::vector<double> const& rows, std::size_t width, Index particle) {
  return rows.data() + width * at(particle);
}

/// (A_i + A_j) v for the matrices of the ends of four links.
Triple<Lanes> sum_times(std::vector<double> const& rows, std::size_t width, LinkBlock const& b,
                        Triple<Lanes> const& v) {
  Lanes out[3];
  for (std::size_t r = 0; r < 3; ++r) {
    auto const read = [&](std::size_t k) {
      return Lanes::load_unaligned(rows_of(rows, width, b.i[k]) + 4 * r) +
             Lanes::load_unaligned(rows_of(rows, width, b.j[k]) + 4 * r);
    };
    Lanes x = read(0), y = read(1), z = read(2), w = read(3);
    transpose(x, y, z, w);
    out[r] = dot(Triple<Lanes>{x, y, z}, v);
  }
  return {out[0], out[1], out[2]};
}

/// Adds u v^T of four links to both ends.
void add_dyads(std::vector<double>& rows, std::size_t width, LinkBlock const& b, Triple<Lanes> const& u,
               Triple<Lanes> const& v) {
  alignas(32) std::array<double, lanes> factor[3];
  u.x.store_aligned(factor[0].data()), u.y.store_aligned(factor[1].data()), u.z.store_aligned(factor[2].data());
  auto const record = per_link(v);
  for (std::size_t k = 0; k < lanes; ++k)
    for (Index const end : {b.i[k], b.j[k]}) {
      double* to = rows.data() + width * at(end);
      for (std::size_t r = 0; r < 3; ++r)
        multiply_add(Lanes(factor[r][k]), record[k], Lanes::load_unaligned(to + 4 * r)).store_unaligned(to + 4 * r);
    }
}

}  // namespace

FaceOffset face_offset(Mesh const& mesh, Link const& link) {
  FaceGeometry const& face = mesh.face(link.i, link.face_i);
  // A wall has its pole at the foot of that of the particle: no offset.
  if (link.j == Link::wall) return {face.area * face.normal, {}};
  Vec3 const pole = mesh.particle(link.i).centre + mesh.shape(link.i).pole;
  Vec3 const between = mesh.particle(link.j).centre + mesh.shape(link.j).pole - pole;
  Real const share = face_distance(mesh, link, link.i) / link.rest_length;
  Vec3 offset = mesh.particle(link.i).centre + face.centroid - (pole + share * between);
  if (norm2(offset) < 1e-20 * norm2(between)) offset = {};
  return {(face.area / link.rest_length) * between, offset};
}

Mat3 gradient_inverse(Mesh const& mesh, GlobalId p) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t const l : mesh.links_of(p)) {
    Link const& link = mesh.links[l];
    Vec3 const pull = face_offset(mesh, link).pull;
    Eigen::Vector3d const d(pull.x, pull.y, pull.z);
    sum += (link.rest_length / mesh.face(link.i, link.face_i).area) * d * d.transpose();
  }
  // Directions without links (rods, plates, slabs) have no gradient.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const solver(sum);
  Eigen::Vector3d inverse = solver.eigenvalues();
  Real const largest = inverse.maxCoeff();
  for (int d = 0; d < 3; ++d) inverse[d] = inverse[d] > 1e-8 * largest ? 1 / inverse[d] : 0;
  Eigen::Matrix3d const m = solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
  Mat3 out;
  for (int r = 0; r < 3; ++r) out[r] = {m(r, 0), m(r, 1), m(r, 2)};
  for (int d = mesh.dimension; d < 3; ++d)  // nothing leaks out of the plane of a slab
    for (int e = 0; e < 3; ++e) out[d][e] = out[e][d] = 0;
  return out;
}

bool ConsistentStrain::needed(Mesh const& mesh) {
  return std::any_of(mesh.links.begin(), mesh.links.end(),
                     [&](Link const& link) { return norm2(face_offset(mesh, link).offset) > 0; });
}

ConsistentStrain::ConsistentStrain(Mesh const& mesh, LinkStore const& links, std::span<GlobalId const> ids,
                                   std::span<std::size_t const> mesh_link, std::size_t entries, Exchange exchange)
    : links_(links),
      exchange_(std::move(exchange)),
      blocks_(links.records().size()),
      gradient_(row * entries),
      pull_(row * entries) {
  for (std::size_t k = 0; k < links.count(); ++k) {
    FaceOffset const of = face_offset(mesh, mesh.links[mesh_link[k]]);
    for (int d = 0; d < 3; ++d) {
      blocks_[k / lanes].field[static_cast<std::size_t>(d)][k % lanes] = of.pull[d];
      blocks_[k / lanes].field[static_cast<std::size_t>(3 + d)][k % lanes] = of.offset[d];
    }
  }
  for (GlobalId const p : ids) inverse_.push_back(gradient_inverse(mesh, p));
}

void ConsistentStrain::times_inverse(std::vector<double>& rows) const {
  for (std::size_t p = 0; p < inverse_.size(); ++p)
    for (std::size_t r = 0; r < 3; ++r) {
      double* m = rows.data() + row * p + 4 * r;
      Vec3 const product = inverse_[p] * Vec3{m[0], m[1], m[2]};  // the inverse is symmetric
      m[0] = product.x, m[1] = product.y, m[2] = product.z;
    }
}

void ConsistentStrain::move_volume(std::span<Pose const> pose, std::span<double> opened) {
  auto const field = [&](std::size_t n, std::size_t f) { return Lanes::load_aligned(blocks_[n].field[f].data()); };
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    LinkBlock const& b = links_.records()[n];
    LinkFrame<Lanes> const frame(read_rest(b), read_ends(pose.data(), b));
    add_dyads(gradient_, row, b, turned_back(frame), {field(n, 0), field(n, 1), field(n, 2)});
  }
  times_inverse(gradient_);
  exchange_(std::span(gradient_).first(row * inverse_.size()), row);
  std::fill(gradient_.begin() + static_cast<std::ptrdiff_t>(row * inverse_.size()), gradient_.end(), 0.0);
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    LinkBlock const& b = links_.records()[n];
    Triple<Lanes> const move = sum_times(gradient_, row, b, {field(n, 3), field(n, 4), field(n, 5)});
    alignas(32) std::array<double, lanes> volume;
    (Lanes(0.5) * dot(read_rest(b).area, move)).store_aligned(volume.data());
    for (std::size_t k = 0; k < lanes; ++k) {
      opened[at(b.i[k])] += volume[k];
      opened[at(b.j[k])] -= volume[k];
    }
  }
}

void ConsistentStrain::take_pressure(std::span<double> pressure) {
  auto const field = [&](std::size_t n, std::size_t f) { return Lanes::load_aligned(blocks_[n].field[f].data()); };
  exchange_(pressure.first(inverse_.size()), 1);
  std::fill(pull_.begin(), pull_.end(), 0.0);
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    LinkBlock const& b = links_.records()[n];
    Lanes const jump = Lanes(0.5) * (gather(pressure.data(), b.i) - gather(pressure.data(), b.j));
    add_dyads(pull_, row, b, jump * read_rest(b).area, {field(n, 3), field(n, 4), field(n, 5)});
  }
  times_inverse(pull_);
  std::fill(pull_.begin() + static_cast<std::ptrdiff_t>(row * inverse_.size()), pull_.end(), 0.0);
}

void ConsistentStrain::add_wrench(std::span<Pose const> pose, std::span<Wrench> wrench) const {
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    LinkBlock const& b = links_.records()[n];
    auto const field = [&](std::size_t f) { return Lanes::load_aligned(blocks_[n].field[f].data()); };
    LinkFrame<Lanes> const frame(read_rest(b), read_ends(pose.data(), b));
    add_to_ends(b, wrench_of(frame, sum_times(pull_, row, b, {field(0), field(1), field(2)})), wrench);
  }
}

LinkWrench<double> ConsistentStrain::wrench(std::size_t link, LinkEnds<double> const& ends) const {
  auto const& field = blocks_[link / lanes].field;
  Triple<double> const c{field[0][link % lanes], field[1][link % lanes], field[2][link % lanes]};
  double const *i = pull_.data() + row * at(links_.end_i(link)), *j = pull_.data() + row * at(links_.end_j(link));
  auto const times = [&](std::size_t r) {
    return dot(Triple<double>{i[r] + j[r], i[r + 1] + j[r + 1], i[r + 2] + j[r + 2]}, c);
  };
  return wrench_of(LinkFrame<double>(links_.rest(link), ends), {times(0), times(4), times(8)});
}

std::size_t ConsistentStrain::bytes() const {
  return blocks_.size() * sizeof(Block) + inverse_.size() * sizeof(Mat3) + 2 * gradient_.size() * sizeof(double);
}

}  // namespace brisance::solid
