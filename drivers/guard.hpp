// The one place where exceptions end: one message, one exit code, on all ranks.
#pragma once
#include <functional>

#include "parallel/comm.hpp"

namespace brisance::drivers {

/// Runs `body` and returns its exit code, the same on all ranks. When all ranks fail, rank 0 says why. When a rank
/// fails while others wait for it inside a collective call, it says why itself and ends them all.
int guarded(parallel::Comm& comm, std::function<int()> const& body);

}  // namespace brisance::drivers
