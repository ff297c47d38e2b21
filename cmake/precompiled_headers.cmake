# Headers that every file of a target would read again, compiled once: two thirds of the time of a file of src/setup, a third elsewhere, a
# quarter of a test (g++ 12). ./dev builds with them. Off otherwise: ccache shares no objects between build folders then, and an
# #include that is missing goes unseen.
option(SOLIDUS_PCH "Build with precompiled headers" OFF)

if(SOLIDUS_PCH)
  if(CCACHE) # what ccache's manual asks for
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  endif()
  # g++ 12 forgets that a precompiled header is the system's, and its false alarms in std::string (PR 105651, see -Wno-restrict)
  # come back under other names. Builds without precompiled headers keep these warnings.
  target_compile_options(solidus_options INTERFACE
    $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>>
    $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>>)
endif()

# Headers compiled once for all the targets that use them: the standard library's, fmt's and those named after `libraries`, whose
# include folders and definitions they are read with. A target compiled with other definitions that these headers look at could not
# use them (-Winvalid-pch).
# @param name       what solidus_precompile calls them
# @param libraries  targets, a list
function(solidus_common_headers name libraries)
  if(NOT SOLIDUS_PCH)
    return()
  endif()
  add_library(solidus_headers_${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/nothing.cpp)
  target_link_libraries(solidus_headers_${name} PRIVATE solidus_options fmt::fmt spdlog::spdlog tomlplusplus::tomlplusplus ${libraries})
  target_precompile_headers(solidus_headers_${name} PRIVATE <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map>
                            <memory> <optional> <set> <sstream> <string> <unordered_map> <variant> <vector> <fmt/format.h> ${ARGN})
  if(CCACHE)
    set_target_properties(solidus_headers_${name} PROPERTIES CXX_COMPILER_LAUNCHER
                          "sh;${PROJECT_SOURCE_DIR}/cmake/compile_header.sh;${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
endfunction()

function(solidus_precompile target name)
  if(SOLIDUS_PCH)
    target_precompile_headers(${target} REUSE_FROM solidus_headers_${name})
  endif()
endfunction()
