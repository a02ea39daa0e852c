#include "drivers/solid_frame.hpp"

#include <fmt/format.h>

#include "core/solid/particle_fields.hpp"

namespace brisance::drivers {
namespace {

/// A field on the particles; all faces of a particle show its value.
struct Field {
  std::string name;
  int columns;
  std::vector<double> of_particle;
};

std::vector<Field> compute(World const& world, std::vector<std::string> const& names) {
  std::vector<Field> fields;
  for (std::string const& name : names)
    fields.push_back({name, solid::particle_field_columns(name), solid::particle_field(*world.solid, name)});
  for (Plan::ParticleField const& field : world.plan.particle_fields()) {
    Field& added = fields.emplace_back(Field{field.name, 1, {}});
    added.of_particle.resize(static_cast<std::size_t>(world.solid->owned()));
    field.fill(added.of_particle);
  }
  return fields;
}

/// Points, faces and entries of the list of polygons.
struct Size {
  std::int64_t points = 0, faces = 0, entries = 0;
  void add(solid::Polyhedron const& shape) {
    points += static_cast<std::int64_t>(shape.vertices.size());
    faces += static_cast<std::int64_t>(shape.faces.size());
    for (auto const& face : shape.faces) entries += 2 + static_cast<std::int64_t>(face.size());
  }
};

std::string attribute(std::string const& name, int columns, std::int64_t rows, std::string const& file,
                      bool integers = false) {
  char const* const type = columns == 1 ? "Scalar" : columns == 3 ? "Vector" : "Tensor6";
  return fmt::format(
      "    <Attribute Name=\"{0}\" AttributeType=\"{1}\" Center=\"Cell\"><DataItem Format=\"HDF\"{2} Precision=\"8\" "
      "Dimensions=\"{3}{4}\">{5}:/{0}</DataItem></Attribute>\n",
      name, type, integers ? " NumberType=\"Int\"" : "", rows, columns > 1 ? fmt::format(" {}", columns) : "", file);
}

}  // namespace

void write_solid_frame(World const& world, std::vector<std::string> const& names, std::string const& path) {
  solid::Mesh const& mesh = *world.mesh;
  solid::Solid const& solid = *world.solid;
  std::vector<Field> const fields = compute(world, names);
  std::vector<std::vector<double>> of_face(fields.size());
  std::vector<double> xyz;
  std::vector<std::int64_t> topology, particle, body;
  std::vector<parallel::Range> point_rows, entry_rows, face_rows;
  Size before;
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    solid::Polyhedron const& shape = mesh.shape(p).polyhedron;
    Size after = before;
    after.add(shape);
    if (solid.owner(p) == world.comm->rank()) {
      auto const local = static_cast<std::size_t>(solid.local(p));
      solid::Pose const& pose = solid.pose()[local];
      for (Vec3 const& v : shape.vertices) {
        Vec3 const x = pose.x + rotate(pose.q, v);
        xyz.insert(xyz.end(), {x.x, x.y, x.z});
      }
      for (auto const& face : shape.faces) {
        topology.push_back(3);
        topology.push_back(static_cast<std::int64_t>(face.size()));
        for (int const v : face) topology.push_back(before.points + v);
        particle.push_back(p);
        body.push_back(mesh.particle(p).body);
        for (std::size_t n = 0; n < fields.size(); ++n) {
          auto const columns = static_cast<std::size_t>(fields[n].columns);
          auto const from = fields[n].of_particle.begin() + static_cast<std::ptrdiff_t>(local * columns);
          of_face[n].insert(of_face[n].end(), from, from + fields[n].columns);
        }
      }
      point_rows.push_back({before.points, after.points - before.points});
      entry_rows.push_back({before.entries, after.entries - before.entries});
      face_rows.push_back({before.faces, after.faces - before.faces});
    }
    before = after;
  }
  parallel::ArchiveWriter file(*world.comm, path);
  file.rows("points", before.points, 3, point_rows, xyz);
  file.rows_int("topology", before.entries, 1, entry_rows, topology);
  file.rows_int("particle", before.faces, 1, face_rows, particle);
  file.rows_int("body", before.faces, 1, face_rows, body);
  for (std::size_t n = 0; n < fields.size(); ++n)
    file.rows(fields[n].name, before.faces, fields[n].columns, face_rows, of_face[n]);
  file.attribute("time", world.simulation->clock().time);
  file.close();
}

std::string solid_frame_xdmf(World const& world, std::vector<std::string> const& fields, std::string const& file,
                             double time) {
  Size size;
  for (GlobalId p = 0; p < world.mesh->size(); ++p) size.add(world.mesh->shape(p).polyhedron);
  std::string text = fmt::format(
      "   <Grid Name=\"solid\"><Time Value=\"{:.9g}\"/>\n    <Topology TopologyType=\"Mixed\" "
      "NumberOfElements=\"{}\"><DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"8\" "
      "Dimensions=\"{}\">{}:/topology"
      "</DataItem></Topology>\n    <Geometry GeometryType=\"XYZ\"><DataItem Format=\"HDF\" Precision=\"8\" "
      "Dimensions=\"{} 3\">{}:/points</DataItem></Geometry>\n",
      time, size.faces, size.entries, file, size.points, file);
  for (char const* name : {"particle", "body"}) text += attribute(name, 1, size.faces, file, true);
  for (std::string const& name : fields) text += attribute(name, solid::particle_field_columns(name), size.faces, file);
  for (Plan::ParticleField const& field : world.plan.particle_fields())
    text += attribute(field.name, 1, size.faces, file);
  return text + "   </Grid>\n";
}

}  // namespace brisance::drivers
