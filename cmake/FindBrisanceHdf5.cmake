# Parallel HDF5 of Debian (libhdf5-openmpi-dev), through pkg-config; target BrisanceHdf5::hdf5.
find_package(PkgConfig REQUIRED)
pkg_check_modules(HDF5_OPENMPI QUIET IMPORTED_TARGET hdf5-openmpi)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BrisanceHdf5 DEFAULT_MSG HDF5_OPENMPI_FOUND)
if(BrisanceHdf5_FOUND AND NOT TARGET BrisanceHdf5::hdf5)
  add_library(BrisanceHdf5::hdf5 ALIAS PkgConfig::HDF5_OPENMPI)
endif()
