brisance_test(solid_unit
  SOURCES unit/core/solid/polyhedron_test.cpp unit/core/solid/shapes_test.cpp unit/core/solid/mesh_test.cpp
          unit/core/solid/link_law_test.cpp unit/core/solid/surface_test.cpp unit/core/solid/solid_test.cpp
          unit/core/solid/plasticity_test.cpp
          unit/core/solid/fracture/criteria_test.cpp unit/core/solid/fracture/weibull_test.cpp
          unit/core/solid/contact_test.cpp unit/core/solid/sleep_test.cpp unit/core/solid/particle_fields_test.cpp
          unit/core/solid/fracture/link_laws_test.cpp unit/core/solid/fracture/fragments_test.cpp
  LINKS brisance::solid LABELS unit)
brisance_test(solid_meshes
  SOURCES unit/core/solid/meshes/gmsh_test.cpp unit/core/solid/meshes/surface_test.cpp
          unit/core/solid/meshes/quality_test.cpp
  LINKS brisance::solid LABELS unit)
brisance_test(solid_statics SOURCES verification/solid/statics_test.cpp LINKS brisance::solid LABELS verification)
add_library(brisance_linear_solid STATIC support/linear_solid.cpp support/uniaxial.cpp)
target_link_libraries(brisance_linear_solid PUBLIC brisance::solid Eigen3::Eigen PRIVATE brisance_test_main)
target_compile_options(brisance_linear_solid PRIVATE -Wno-conversion)
foreach(part elastica patch plates pressure rods sphere tetrahedra waves)
  brisance_test(solid_${part} SOURCES verification/solid/${part}_test.cpp LINKS brisance_linear_solid LABELS verification)
endforeach()
brisance_test(solid_rotation SOURCES verification/solid/rotation_test.cpp LINKS brisance::solid Eigen3::Eigen
  LABELS verification)
brisance_test(solid_stable_step SOURCES verification/solid/stable_step_test.cpp LINKS brisance::solid LABELS verification)
brisance_test(solid_energy SOURCES verification/solid/energy_test.cpp LINKS brisance::solid LABELS verification)
brisance_test(solid_multirate SOURCES verification/solid/multirate_test.cpp LINKS brisance::solid LABELS verification)
brisance_test(solid_parallel SOURCES parallel/solid_test.cpp LINKS brisance::solid RANKS 1 2 3 4 LABELS parallel)
brisance_test(solid_fracture_parallel SOURCES parallel/fracture_test.cpp LINKS brisance::solid RANKS 1 2 3 4 LABELS parallel)
brisance_test(solid_restart SOURCES restart/solid_test.cpp LINKS brisance::solid RANKS 1 2 3 4 LABELS restart)
brisance_test(solid_plasticity SOURCES verification/solid/plasticity_test.cpp LINKS brisance::solid LABELS verification)
brisance_test(solid_consistent SOURCES verification/solid/consistent_test.cpp LINKS brisance::solid Eigen3::Eigen
  LABELS verification)
brisance_test(solid_two_materials SOURCES verification/solid/two_materials_test.cpp LINKS brisance::solid LABELS verification)
brisance_test(solid_fracture SOURCES verification/solid/fracture_test.cpp verification/solid/fracture_account_test.cpp
  LINKS brisance::solid LABELS verification)
brisance_test(solid_supports SOURCES verification/solid/supports_test.cpp LINKS brisance::solid LABELS verification)
brisance_test(solid_damping SOURCES verification/solid/damping_test.cpp LINKS brisance::solid LABELS verification)
brisance_test(solid_supports_parallel SOURCES parallel/supports_test.cpp LINKS brisance::solid RANKS 1 2 3 4 LABELS parallel)
brisance_test(solid_loads_unit SOURCES unit/core/solid/loads/blast_test.cpp unit/core/solid/loads/load_test.cpp
  LINKS brisance::solid LABELS unit)
brisance_test(solid_loads SOURCES verification/solid/loads_test.cpp verification/solid/lamb_test.cpp
  LINKS brisance::solid LABELS verification)
brisance_test(solid_contact SOURCES verification/solid/contact_test.cpp verification/solid/contact_lasting_test.cpp
              verification/solid/contact_limits_test.cpp LINKS brisance::solid LABELS verification)
brisance_test(solid_contact_bits SOURCES parallel/contact_test.cpp LINKS brisance::solid RANKS 1 2 3 4 LABELS parallel)
