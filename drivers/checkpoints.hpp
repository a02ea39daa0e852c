// Checkpoints of a run: checkpoints/step-N.h5 and checkpoints/latest, the last two kept.
#pragma once
#include <string>
#include <vector>

#include "drivers/assembly.hpp"

namespace brisance::drivers {

/// Collective. Writes a checkpoint of the present state and removes all but it and the one before it.
void write_checkpoint(World& world, std::string const& directory);

/// Collective. Checkpoints in `directory`, newest first; empty if there are none.
std::vector<std::string> list_checkpoints(parallel::Comm& comm, std::string const& directory);

/// Collective. Removes the checkpoints of an earlier run that starts anew in `directory`.
void forget_checkpoints(parallel::Comm& comm, std::string const& directory);

/// Collective. Reads `path` into the world.  Errors: system error naming the file and what is wrong with it.
void read_checkpoint(World& world, std::string const& path);

}  // namespace brisance::drivers
