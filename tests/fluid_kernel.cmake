brisance_test(fluid_sweep
  SOURCES unit/fluid/flux/sweep_test.cpp support/plain_osmp.cpp
  LINKS brisance::fluid
  LABELS unit)
