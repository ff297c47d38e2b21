# `cpack` (./dev package) makes two packages for Debian: solidus, the program, and libsolidus-dev, the libraries for other programs.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME solidus)
set(CPACK_PACKAGE_VERSION ${SOLIDUS_PACKAGE_VERSION})
set(CPACK_PACKAGE_CONTACT "The Solidus authors <solidus@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulates how a metal casting solidifies in its mould")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME solidus)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "simulates how a metal casting solidifies in its mould
 Heat with phase change, elasto-viscoplastic deformation and thermomechanical contact of a casting, its mould, cores and
 chills, coupled. Cases are text files; results are tables, fields for ParaView and a page for the browser.")
# Libraries: by what the program is linked with. The pictures need Python; ranks need mpirun; OpenBLAS is several times as fast as the
# reference BLAS that PETSc would be content with.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libopenblas0-serial | libopenblas0")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-matplotlib, openmpi-bin")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "paraview, libsolidus-dev")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsolidus-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "libraries of Solidus, for other programs
 Static libraries with headers and what CMake's find_package(solidus) needs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "petsc-dev, libopenmpi-dev, libmetis-dev, libeigen3-dev, libudunits2-dev, libcli11-dev, libfmt-dev, libspdlog-dev, libboost-dev, libtomlplusplus-dev, libmuparser-dev, zlib1g-dev, libhdf5-openmpi-dev, pkg-config")
if(SOLIDUS_GMSH)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libgmsh-dev")
endif()
include(CPack)
