// One frame of solid.xdmf: the faces of the particles as polygons, and fields on them.
#pragma once
#include <string>
#include <vector>

#include "drivers/assembly.hpp"

namespace brisance::drivers {

/// Collective. Writes points, faces and fields to `path`, atomically. Rows are numbered by global ids: no rank shows.
/// `fields`: names of solid::particle_field_names(); those of the effects are added.
void write_solid_frame(World const& world, std::vector<std::string> const& fields, std::string const& path);

/// The <Grid> of a frame at `time` in solid.xdmf; `file`: relative to it.
std::string solid_frame_xdmf(World const& world, std::vector<std::string> const& fields, std::string const& file,
                             double time);

}  // namespace brisance::drivers
