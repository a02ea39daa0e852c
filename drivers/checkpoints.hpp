// Checkpoints of a run: checkpoints/step-N.h5 and checkpoints/latest, the last two kept.
#pragma once
#include <string>
#include <vector>

#include "drivers/assembly.hpp"

namespace brisance::drivers {

/// Collective. Writes a checkpoint of the present state and removes all but the last two.
void write_checkpoint(World& world, std::string const& directory);

/// Collective. Checkpoints in `directory`, newest first; empty if there are none.
std::vector<std::string> list_checkpoints(parallel::Comm& comm, std::string const& directory);

/// Collective. Reads `path` into the world.  Errors: system error naming the file and what is wrong with it.
void read_checkpoint(World& world, std::string const& path);

}  // namespace brisance::drivers
