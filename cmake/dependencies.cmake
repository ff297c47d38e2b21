# Everything comes from Debian 12 packages; PETSc, Gmsh, METIS and UDUNITS-2 have no CMake configs there.
# An installed Solidus brings this file: whoever links its libraries finds theirs by it.
find_package(PkgConfig REQUIRED)
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(CLI11 REQUIRED)
find_package(Boost REQUIRED)
find_package(ZLIB REQUIRED)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-openmpi) # the flavour that PETSc uses

# An imported target for a library that is only a header and a shared object.
function(solidus_plain_library name header)
  if(TARGET ${name})
    return()
  endif()
  find_path(${name}_INCLUDE_DIR ${header} REQUIRED)
  find_library(${name}_LIBRARY ${name} REQUIRED)
  add_library(${name} UNKNOWN IMPORTED GLOBAL)
  set_target_properties(${name} PROPERTIES IMPORTED_LOCATION ${${name}_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${${name}_INCLUDE_DIR})
endfunction()
if(SOLIDUS_GMSH)
  solidus_plain_library(gmsh gmsh.h)
endif()
if(SOLIDUS_MED)
  solidus_plain_library(medC med.h)
endif()
solidus_plain_library(metis metis.h)
solidus_plain_library(udunits2 udunits2.h)
