// A solid linearised about its present state, and what follows from that: modes, Bloch waves, equilibria.
// The stiffness comes from the product's own forces by differences, so that it is the product that is verified.
#pragma once
// Scalar Eigen: GCC 12 warns about its own AVX-512 header otherwise.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <functional>
#include <vector>

#include "core/solid/solid.hpp"

namespace brisance::testing {

using Sparse = Eigen::SparseMatrix<double>;

/// M u'' + K u = 0 for the shifts (m) and turns (rad, fixed axes) of the particles that move.
struct LinearSolid {
  std::vector<GlobalId> particles;   ///< those that are free
  std::vector<Vec3> centre, pole;    ///< of them, in the reference state, m
  std::vector<std::size_t> freedom;  ///< of 0..5 (x, y, z, about x, about y, about z): those of the dimension
  Sparse stiffness, mass;            ///< N/m, N, N m and kg, kg m2

  std::size_t count() const { return particles.size(); }
  /// Row of a freedom of the particle at `slot`; `f` counts `freedom`.
  Eigen::Index row(std::size_t slot, std::size_t f = 0) const {
    return static_cast<Eigen::Index>(slot * freedom.size() + f);
  }
  /// Shift of the pole of a particle in a vector of freedoms, m.  Expects: 3D.
  Vec3 pole_shift(Eigen::VectorXd const& u, std::size_t slot) const {
    Eigen::Index const r = row(slot);
    return Vec3{u(r), u(r + 1), u(r + 2)} + cross({u(r + 3), u(r + 4), u(r + 5)}, pole[slot] - centre[slot]);
  }
};

/// Linearises a solid on one rank. Particles that no force connects are moved together.
LinearSolid linearise(solid::Solid& solid);

/// Eigenvalues omega^2 (rad2/s2), ascending, and mode shapes normalised by the mass.
struct Modes {
  Eigen::VectorXd omega2;
  Eigen::MatrixXd shape;
  Real omega(Eigen::Index mode) const { return std::sqrt(omega2(mode)); }
};

/// The `count` lowest modes by a Krylov space of (K + shift M)^-1 M; a free body needs a positive shift (rad2/s2) about
/// as large as its lowest eigenvalue.  Errors: std::runtime_error without convergence to 1e-9.
Modes lowest_modes(LinearSolid const& solid, int count, Real shift = 0);

/// Displacement under small loads: K u = forces of the present state (those of load_faces and load() at rest).
/// `anchor` (rad2/s2) times the mass holds the rigid motions of a free body, whose loads must balance.
/// Errors: std::runtime_error if they do not.
Eigen::VectorXd response(solid::Solid& solid, LinearSolid const& linear, Real anchor = 0);

/// omega^2 of the waves exp(i k.X) of an unbounded lattice: `cell` are slots of one cell deep inside a block, `twin`
/// tells of any slot which place in `cell` it repeats (-1: none).
Eigen::VectorXd bloch_waves(LinearSolid const& solid, std::vector<std::size_t> const& cell,
                            std::function<int(std::size_t)> const& twin, Vec3 const& wave_vector);

/// Moves the free particles of a solid on one rank to where internal forces and loads balance, by Newton's method.
/// `anchor` (rad2/s2) times the mass holds the rigid motions of a free body during the search. Returns the largest
/// unbalanced force (N) or torque (N m).  Errors: std::runtime_error above `tolerance`.
Real balance(solid::Solid& solid, Real tolerance, Real anchor = 0);

}  // namespace brisance::testing
