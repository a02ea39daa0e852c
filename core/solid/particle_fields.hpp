// Fields of the particles that can be written, computed when they are.
#pragma once
#include <string>
#include <vector>

#include "core/solid/solid.hpp"

namespace brisance::solid {

/// displacement (m), velocity (m/s), rotation (vector, rad), spin (rad/s), stress (xx xy xz yy yz zz, Pa), mean_stress,
/// von_mises, largest_principal_stress (Pa; tension is positive). Stresses are means over a particle, see
/// mean_stress().
std::vector<std::string> particle_field_names();

/// 1: a scalar, 3: a vector, 6: a symmetric tensor.
int particle_field_columns(std::string const& name);

/// The field of the owned particles, in their order: particle_field_columns(name) numbers each.
/// Expects: forces are current.
std::vector<double> particle_field(Solid const& solid, std::string const& name);

}  // namespace brisance::solid
