brisance_test(fluid_sweep
  SOURCES unit/fluid/flux/sweep_test.cpp unit/fluid/flux/low_order_test.cpp unit/fluid/flux/operations_test.cpp support/plain_osmp.cpp
  LINKS brisance::fluid
  LABELS unit)
brisance_test(fluid_tubes
  SOURCES verification/fluid/tube_test.cpp verification/fluid/smooth_waves_test.cpp verification/fluid/smooth_option_test.cpp
          verification/fluid/interacting_waves_test.cpp verification/fluid/riemann_test.cpp support/tube.cpp support/riemann.cpp
          support/shocks.cpp
  LINKS brisance::fluid
  LABELS verification)
target_compile_definitions(fluid_tubes PRIVATE BRISANCE_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/verification/fluid")
