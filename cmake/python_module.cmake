# The compiled part of the Python package, for Debian's Python: without pybind11 (pybind11-dev) it is left out, and the package does
# without what needs it.
option(SOLIDUS_PYTHON "Build the compiled part of the Python package where pybind11 is found" ON)
set(SOLIDUS_PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the compiled part is for")

# A sanitized module would need a sanitized Python.
if(SOLIDUS_PYTHON AND NOT SOLIDUS_SANITIZE AND EXISTS "${SOLIDUS_PYTHON_EXECUTABLE}")
  set(Python_EXECUTABLE "${SOLIDUS_PYTHON_EXECUTABLE}")
  find_package(Python COMPONENTS Interpreter Development.Module QUIET)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
if(NOT SOLIDUS_PYTHON OR SOLIDUS_SANITIZE OR NOT Python_FOUND OR NOT pybind11_FOUND)
  message(STATUS "Python package: without its compiled part (SOLIDUS_PYTHON=${SOLIDUS_PYTHON}, pybind11 ${pybind11_VERSION})")
  return()
endif()

file(GLOB python_sources CONFIGURE_DEPENDS src/python/*.cpp)
pybind11_add_module(solidus_python MODULE NO_EXTRAS ${python_sources} src/app/built_version.cpp)
add_dependencies(solidus_python solidus_program_version solidus_reader) # a reader of another commit is refused
target_link_libraries(solidus_python PRIVATE solidus_run solidus_point)
# Next to the program, where the package of the sources looks for it; never below python/, where it would be of one build among several.
set_target_properties(solidus_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python)
# What it shares with other modules of the process is Python, MPI and PETSc: its own symbols stay its own.
target_link_options(solidus_python PRIVATE -Wl,--exclude-libs,ALL)
# The bindings hold no loops that count: half the time of compiling.
target_compile_options(solidus_python PRIVATE $<$<CONFIG:Release>:-O1>)
solidus_batch(solidus_python)
