// The program: MPI, then the command line.
#include "drivers/command_line.hpp"

int main(int argc, char** argv) {
  auto const comm = brisance::parallel::world(argc, argv);
  return brisance::drivers::command_line(argc, argv, *comm);
}
