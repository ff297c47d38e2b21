# The version that the program says and packages bear: that of the project on a tag vX.Y.Z of it, else with the day and the hash of the
# commit, X.Y.Z+20261122.4b0355f, and with ".modified" where sources were changed since. An archive that git made (git archive) has
# both in cmake/commit.txt; one without them has the project's version alone.
#
# Included by CMakeLists.txt it makes the header app/program_version.hpp, which only src/app/built_version.cpp includes, once more with each
# build; run as a script (-DSOURCES=… -DBASE=… -DHEADER=…) it writes the header where the version has changed.
function(solidus_git output)
  execute_process(COMMAND git -C "${SOURCES}" ${ARGN} OUTPUT_VARIABLE text ERROR_QUIET RESULT_VARIABLE failed
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    set(text "")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

function(solidus_version output)
  set(${output} "${BASE}" PARENT_SCOPE)
  solidus_git(top rev-parse --show-toplevel)
  if(top STREQUAL SOURCES)  # not a repository that happens to lie around an archive
    solidus_git(tag describe --exact-match --tags --match "v${BASE}" HEAD)
    solidus_git(commit log -1 --format=%cd.%h --date=format:%Y%m%d --abbrev=7)
    solidus_git(changes status --porcelain --untracked-files=no)
    if(changes)
      string(APPEND commit ".modified")
    endif()
    if(NOT tag OR changes)
      set(${output} "${BASE}+${commit}" PARENT_SCOPE)
    endif()
    return()
  endif()
  file(STRINGS "${SOURCES}/cmake/commit.txt" archived LIMIT_COUNT 1)
  if(archived MATCHES "^([0-9]+)-([0-9]+)-([0-9]+) ([0-9a-f]+)$")
    set(${output} "${BASE}+${CMAKE_MATCH_1}${CMAKE_MATCH_2}${CMAKE_MATCH_3}.${CMAKE_MATCH_4}" PARENT_SCOPE)
  endif()
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  solidus_version(version)
  if(NOT HEADER)
    execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${version}")
    return()
  endif()
  set(text "// Made by cmake/version.cmake.\n#pragma once\n\n#define SOLIDUS_PROGRAM_VERSION \"${version}\"\n")
  set(before "")
  if(EXISTS "${HEADER}")
    file(READ "${HEADER}" before)
  endif()
  if(NOT text STREQUAL before)
    file(WRITE "${HEADER}" "${text}")
  endif()
  return()
endif()

set(SOURCES ${PROJECT_SOURCE_DIR})
set(BASE ${PROJECT_VERSION})
solidus_version(SOLIDUS_PACKAGE_VERSION)
set(version_header ${PROJECT_BINARY_DIR}/made/app/program_version.hpp)
add_custom_target(solidus_program_version BYPRODUCTS ${version_header} VERBATIM
                  COMMAND ${CMAKE_COMMAND} -DSOURCES=${PROJECT_SOURCE_DIR} -DBASE=${PROJECT_VERSION} -DHEADER=${version_header}
                          -P ${CMAKE_CURRENT_LIST_FILE})
add_dependencies(solidus solidus_program_version)
add_dependencies(solidus_reader solidus_program_version)
set_source_files_properties(src/app/built_version.cpp PROPERTIES INCLUDE_DIRECTORIES ${PROJECT_BINARY_DIR}/made
                            OBJECT_DEPENDS ${version_header})
