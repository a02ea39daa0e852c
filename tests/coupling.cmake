file(GLOB coupling_verification CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/verification/coupling/*_test.cpp)
brisance_test(coupling_verification SOURCES ${coupling_verification} LINKS brisance::drivers LABELS verification)
file(GLOB coupling_unit CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/unit/coupling/*_test.cpp)
brisance_test(coupling_unit SOURCES ${coupling_unit} LINKS brisance::coupling LABELS unit)
