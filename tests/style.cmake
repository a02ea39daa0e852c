# The layers and the format of the sources, and proof that the layer check finds what it looks for.
add_test(NAME layers COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/check_layers.cmake)
add_test(NAME format COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/check_format.cmake)
set(crooked ${CMAKE_CURRENT_BINARY_DIR}/crooked)
file(WRITE ${crooked}/fluid/sideways.cpp "#include \"core/solid/solid.hpp\"\n")
file(WRITE ${crooked}/core/base/up.hpp "#include \"core/model/plan.hpp\"\n")
file(WRITE ${crooked}/coupling/raw.cpp "#include <mpi.h>\n")
brisance_expect(layers_finds_faults CODE 1 LABELS unit
                MESSAGE "core/base/up.hpp.*fluid/sideways.cpp.*coupling/raw.cpp.*belongs in parallel"
                COMMAND ${CMAKE_COMMAND} -DROOT=${crooked} -P ${PROJECT_SOURCE_DIR}/cmake/check_layers.cmake)
set_tests_properties(layers format PROPERTIES LABELS unit)
