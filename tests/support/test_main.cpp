#include "tests/support/test_main.hpp"

#include <gtest/gtest.h>

namespace {
std::unique_ptr<brisance::parallel::Comm> the_comm;
}
namespace brisance::testing {
parallel::Comm& comm() { return *the_comm; }
}  // namespace brisance::testing

int main(int argc, char** argv) {
  the_comm = brisance::parallel::world(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  int result = RUN_ALL_TESTS();
  std::int64_t failed = result;
  the_comm->sum(std::span(&failed, 1));
  the_comm.reset();
  return failed != 0;
}
