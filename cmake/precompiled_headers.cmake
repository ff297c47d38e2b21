# Headers that every file of a target would read again, compiled once: two thirds of the time of a file of src/model, a third elsewhere, a
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
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>
    $<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>)
endif()

# The standard library's, fmt's and, where the target links it, PETSc's; and the headers named.
function(solidus_precompile target)
  if(NOT SOLIDUS_PCH)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional>
                            <set> <sstream> <string> <unordered_map> <variant> <vector> <fmt/format.h> ${ARGN})
endfunction()
