# xsimd is headers only; the package file of Debian asks for a library (xtl) that does not exist. Target BrisanceXsimd::xsimd.
find_path(XSIMD_INCLUDE_DIR xsimd/xsimd.hpp)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BrisanceXsimd DEFAULT_MSG XSIMD_INCLUDE_DIR)
if(BrisanceXsimd_FOUND AND NOT TARGET BrisanceXsimd::xsimd)
  add_library(BrisanceXsimd::xsimd INTERFACE IMPORTED)
  set_target_properties(BrisanceXsimd::xsimd PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${XSIMD_INCLUDE_DIR})
endif()
