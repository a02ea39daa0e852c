brisance_test(fluid_domain_unit
  SOURCES unit/fluid/grid/grid_test.cpp unit/fluid/grid/block_test.cpp unit/fluid/boundary/boundaries_test.cpp
          unit/fluid/boundary/far_field_test.cpp unit/fluid/boundary/inflow_test.cpp unit/fluid/boundary/moving_wall_test.cpp
          unit/fluid/flow_config_test.cpp unit/fluid/flow_test.cpp unit/fluid/time_step_test.cpp
          unit/fluid/gauges/gauge_stencil_test.cpp unit/fluid/gauges/gauge_history_test.cpp
          unit/fluid/sleep_test.cpp
          unit/fluid/survey_test.cpp
  LINKS brisance::fluid
  LABELS unit)
brisance_test(fluid_ghosts SOURCES unit/fluid/ghosts_test.cpp LINKS brisance::fluid RANKS 1 2 3 4 LABELS unit)
brisance_test(fluid_shock_sensor SOURCES unit/fluid/shock_sensor_test.cpp LINKS brisance::fluid RANKS 1 3 LABELS unit)
brisance_test(fluid_initial_state
  SOURCES unit/fluid/initial_state_test.cpp unit/fluid/rows_test.cpp unit/fluid/cell_fields_test.cpp
          unit/fluid/gauges/gauges_test.cpp
  LINKS brisance::fluid
  RANKS 1 3
  LABELS unit)
brisance_test(fluid_blast_bits SOURCES parallel/fluid/blast_test.cpp LINKS brisance::fluid RANKS 1 2 3 4 LABELS parallel)
brisance_test(fluid_sleep SOURCES parallel/fluid/sleep_test.cpp LINKS brisance::fluid RANKS 1 2 3 4 LABELS parallel)
brisance_test(fluid_vortex SOURCES verification/fluid/vortex_test.cpp LINKS brisance::fluid LABELS verification)
brisance_test(fluid_conservation
  SOURCES verification/fluid/conservation_test.cpp
  LINKS brisance::fluid
  LABELS verification)
brisance_test(fluid_spherical_blast
  SOURCES verification/fluid/spherical_blast_test.cpp
  LINKS brisance::fluid
  LABELS verification)
brisance_test(fluid_gauges
  SOURCES verification/fluid/gauge_test.cpp support/riemann.cpp
  LINKS brisance::fluid
  LABELS verification)
brisance_test(fluid_sides
  SOURCES verification/fluid/leaving_waves_test.cpp verification/fluid/entering_waves_test.cpp
  LINKS brisance::fluid
  LABELS verification)
brisance_test(fluid_given_sides
  SOURCES verification/fluid/given_sides_test.cpp
  LINKS brisance::drivers
  LABELS verification)
set(hard_cases support/hard_cases.cpp support/hostile_cases.cpp support/hard_run.cpp support/held_cells.cpp
    support/shocks.cpp support/riemann.cpp)
brisance_test(fluid_stability
  SOURCES stability/fluid/matrix_test.cpp ${hard_cases}
  LINKS brisance::fluid
  LABELS stability)
brisance_test(fluid_several_dimensions
  SOURCES verification/fluid/several_dimensions_test.cpp ${hard_cases}
  LINKS brisance::fluid
  LABELS verification)
brisance_test(fluid_viscous
  SOURCES verification/fluid/viscous_waves_test.cpp verification/fluid/viscous_walls_test.cpp
          verification/fluid/viscous_shock_test.cpp
  LINKS brisance::fluid
  LABELS verification)
brisance_test(fluid_viscosity_unit SOURCES unit/fluid/viscosity_test.cpp LINKS brisance::fluid RANKS 1 3 LABELS unit)
brisance_test(fluid_mixture
  SOURCES verification/fluid/mixture_test.cpp support/mixture_tube.cpp support/riemann.cpp
  LINKS brisance::fluid
  LABELS verification)
brisance_test(fluid_products SOURCES unit/fluid/products_test.cpp LINKS brisance::fluid RANKS 1 3 LABELS unit)
