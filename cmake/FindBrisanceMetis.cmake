# METIS has no package file; target BrisanceMetis::metis.
find_path(METIS_INCLUDE_DIR metis.h)
find_library(METIS_LIBRARY metis)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BrisanceMetis DEFAULT_MSG METIS_LIBRARY METIS_INCLUDE_DIR)
if(BrisanceMetis_FOUND AND NOT TARGET BrisanceMetis::metis)
  add_library(BrisanceMetis::metis UNKNOWN IMPORTED)
  set_target_properties(BrisanceMetis::metis PROPERTIES IMPORTED_LOCATION ${METIS_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${METIS_INCLUDE_DIR})
endif()
