// The Comm of a test program: MPI_COMM_WORLD under mpirun, one rank otherwise.
#pragma once
#include "parallel/comm.hpp"

namespace brisance::testing {
parallel::Comm& comm();
}
