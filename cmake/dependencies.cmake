# Everything comes from packages of Debian 12 or 13; PETSc, Gmsh, METIS and UDUNITS-2 have no CMake configs there.
# An installed Solidus brings this file: whoever links its libraries finds theirs by it.
find_package(PkgConfig REQUIRED)
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
if(Eigen3_VERSION VERSION_LESS 3.4) # asked for 3.4, the package of Eigen 5 would say that it is no Eigen 3
  message(FATAL_ERROR "Eigen ${Eigen3_VERSION} is too old: 3.4 or newer is needed")
endif()
find_package(CLI11 REQUIRED)
if(POLICY CMP0167) # CMake 3.30 and later warn where its own way to find Boost would be asked for; Boost 1.70 and later brings one
  cmake_policy(SET CMP0167 NEW)
endif()
find_package(Boost REQUIRED)
find_package(ZLIB REQUIRED)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-openmpi) # the flavour that PETSc uses

# A distribution on the move may have a PETSc that was built with another MPI than the one that it offers: that is told here and not by
# the first of two hundred sources.
if(NOT SOLIDUS_PETSC_FITS_MPI)
  try_compile(SOLIDUS_PETSC_FITS_MPI SOURCE_FROM_CONTENT petsc.cpp "#include <petscsys.h>\nint main() { return 0; }\n"
              CMAKE_FLAGS -DCMAKE_CXX_STANDARD=20 LINK_LIBRARIES PkgConfig::PETSC MPI::MPI_CXX OUTPUT_VARIABLE said)
  if(NOT SOLIDUS_PETSC_FITS_MPI)
    string(REGEX MATCH "error: [^\n]*" said "${said}\nerror: see CMakeFiles/CMakeConfigureLog.yaml")
    message(FATAL_ERROR "PETSc ${PETSC_VERSION} and the MPI of this system (${MPI_CXX_LIBRARIES}) do not fit each other: ${said}")
  endif()
endif()

# An imported target for a library that is only a shared object and a header, where one is named.
function(solidus_plain_library name)
  if(TARGET ${name})
    return()
  endif()
  find_library(${name}_LIBRARY ${name} REQUIRED)
  add_library(${name} UNKNOWN IMPORTED GLOBAL)
  set_target_properties(${name} PROPERTIES IMPORTED_LOCATION ${${name}_LIBRARY})
  if(ARGN)
    find_path(${name}_INCLUDE_DIR ${ARGN} REQUIRED)
    set_target_properties(${name} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${${name}_INCLUDE_DIR})
  endif()
endfunction()
set(SOLIDUS_GMSH_VERSION "not in this build")
if(SOLIDUS_GMSH)
  solidus_plain_library(gmsh gmsh.h)
  file(STRINGS ${gmsh_INCLUDE_DIR}/gmsh.h version REGEX "^#define GMSH_API_VERSION ")
  string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*$" "\\1" SOLIDUS_GMSH_VERSION "${version}")
endif()
if(SOLIDUS_GMSH) # what CGAL needs, which is headers alone
  solidus_plain_library(gmp)
  solidus_plain_library(mpfr)
endif()
if(SOLIDUS_MED)
  solidus_plain_library(medC med.h)
endif()
solidus_plain_library(metis metis.h)
# BLAS and LAPACK come with PETSc, which declares their functions.
solidus_plain_library(lapack)
solidus_plain_library(blas)
solidus_plain_library(udunits2 udunits2.h)
