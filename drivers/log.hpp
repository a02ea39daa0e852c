// What a run says: through spdlog's default logger, on rank 0 only. Messages to the terminal, warnings and errors to
// stderr, and all of it with times to run.log once the output directory exists.
#pragma once
#include <string>

#include "parallel/comm.hpp"

namespace brisance::drivers {

/// Sets the default logger of this rank up: silent on all ranks but 0; `quiet` leaves warnings and errors only.
void start_log(parallel::Comm const& comm, bool quiet);

/// From now on everything goes to this file too (appended). Rank 0 only has an effect.
void log_to_file(std::string const& path);

}  // namespace brisance::drivers
