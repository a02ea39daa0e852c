#include "core/solid/particle_fields.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/solid/gauges/stress.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

using Values = std::vector<double>;

struct Field {
  char const* name;
  int columns;
  Values (*of)(Solid const&);
};

template <class Value>
Values vectors(Solid const& solid, Value value) {
  Values out;
  out.reserve(3 * static_cast<std::size_t>(solid.owned()));
  for (Index p = 0; p < solid.owned(); ++p) {
    Vec3 const v = value(p);
    out.insert(out.end(), {v.x, v.y, v.z});
  }
  return out;
}

template <Real (*figure)(Mat3 const&)>
Values stress_figures(Solid const& solid) {
  Values out;
  for (Mat3 const& stress : mean_stresses(solid)) out.push_back(figure(stress));
  return out;
}

Pose const& pose(Solid const& solid, Index p) { return solid.pose()[static_cast<std::size_t>(p)]; }
Motion const& motion(Solid const& solid, Index p) { return solid.motion()[static_cast<std::size_t>(p)]; }

Values displacement(Solid const& s) {
  return vectors(s, [&](Index p) { return pose(s, p).x - s.mesh().particle(s.id(p)).centre; });
}
Values velocity(Solid const& s) {
  return vectors(s, [&](Index p) { return motion(s, p).v; });
}
Values rotation(Solid const& s) {
  return vectors(s, [&](Index p) { return rotation_vector(pose(s, p).q); });
}
Values spin(Solid const& s) {
  return vectors(s, [&](Index p) { return s.omega_of(p, motion(s, p).spin); });
}
Values stress(Solid const& solid) {
  Values out;
  for (Mat3 const& m : mean_stresses(solid)) out.insert(out.end(), {m[0].x, m[0].y, m[0].z, m[1].y, m[1].z, m[2].z});
  return out;
}

Real mean(Mat3 const& s) { return trace(s) / 3; }

Real von_mises(Mat3 const& s) {
  Real const a = s[0].x - s[1].y, b = s[1].y - s[2].z, c = s[2].z - s[0].x;
  Real const shear = s[0].y * s[0].y + s[0].z * s[0].z + s[1].z * s[1].z;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear);
}

Real largest_principal(Mat3 const& s) {
  Eigen::Matrix3d m;
  m << s[0].x, s[0].y, s[0].z, s[1].x, s[1].y, s[1].z, s[2].x, s[2].y, s[2].z;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

constexpr Field fields[] = {{"displacement", 3, displacement},
                            {"velocity", 3, velocity},
                            {"rotation", 3, rotation},
                            {"spin", 3, spin},
                            {"stress", 6, stress},
                            {"mean_stress", 1, stress_figures<mean>},
                            {"von_mises", 1, stress_figures<von_mises>},
                            {"largest_principal_stress", 1, stress_figures<largest_principal>}};

Field const& named(std::string const& name) {
  for (Field const& field : fields)
    if (name == field.name) return field;
  throw Error(Failure::internal, "there is no particle field \"" + name + "\"");
}

}  // namespace

std::vector<std::string> particle_field_names() {
  std::vector<std::string> names;
  for (Field const& field : fields) names.emplace_back(field.name);
  return names;
}

int particle_field_columns(std::string const& name) { return named(name).columns; }

std::vector<double> particle_field(Solid const& solid, std::string const& name) { return named(name).of(solid); }

}  // namespace brisance::solid
