// The command line of brisance.
#pragma once
#include "parallel/comm.hpp"

namespace brisance::drivers {

/// Reads the arguments, runs the subcommand and returns the exit code of the contract, the same on all ranks.
/// Collective.
int command_line(int argc, char const* const* argv, parallel::Comm& comm);

}  // namespace brisance::drivers
