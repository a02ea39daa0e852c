// Fails on purpose under drivers::guarded: guard_probe all|last|none. The exit code and the messages are what is
// tested.
#include <stdexcept>
#include <string_view>

#include "drivers/guard.hpp"
#include "drivers/log.hpp"
#include "parallel/error.hpp"

int main(int argc, char** argv) {
  auto const comm = brisance::parallel::world(argc, argv);
  std::string_view const who = argc > 1 ? argv[1] : "none";
  brisance::drivers::start_log(*comm, false);
  return brisance::drivers::guarded(*comm, [&] {
    if (who == "all") throw brisance::Error(brisance::Failure::numerical, "cell 7 has no density");
    if (who == "internal") throw std::logic_error("a bug");
    bool const last = comm->rank() == comm->size() - 1;
    if (who == "last" && last) throw brisance::Error(brisance::Failure::system, "disk full");
    comm->barrier();  // the healthy ranks wait here for the failed one
    return 75;
  });
}
