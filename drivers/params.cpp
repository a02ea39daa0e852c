#include <cstdio>

#include "drivers/commands.hpp"
#include "drivers/scene.hpp"

namespace brisance::drivers {

int print_params(ParamsOptions const& options, parallel::Comm& comm) {
  std::string const text = key_reference<Scene>(options.path);
  if (comm.rank() == 0) std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace brisance::drivers
