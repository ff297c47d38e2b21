# Several sources compiled as one file: headers are read, templates instantiated and inline functions compiled once for all of them,
# which takes half of the time of a test program (docs/developers/build_time.md). ./dev builds with it. Off otherwise, as precompiled
# headers are: an #include that is missing goes unseen.
option(SOLIDUS_BATCHES "Compile several sources as one" OFF)

# Replaces the sources of a target by files that include several of them (batches.py), except those with settings of their own and those
# marked SKIP_UNITY_BUILD_INCLUSION. To be called in the directory of the target.
function(solidus_batch target)
  if(NOT SOLIDUS_BATCHES)
    return()
  endif()
  get_target_property(all ${target} SOURCES)
  set(kept)
  set(sources)
  foreach(source ${all})
    get_filename_component(path "${source}" ABSOLUTE)
    set(alone OFF)
    foreach(property SKIP_UNITY_BUILD_INCLUSION SKIP_PRECOMPILE_HEADERS COMPILE_OPTIONS COMPILE_DEFINITIONS)
      get_source_file_property(value "${source}" ${property})
      if(value)
        set(alone ON)
      endif()
    endforeach()
    if(path MATCHES "\\.cpp$" AND EXISTS "${path}" AND NOT alone)
      list(APPEND sources "${path}")
    else()
      list(APPEND kept "${source}")
    endif()
  endforeach()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/batches)
  file(MAKE_DIRECTORY ${folder})
  execute_process(COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/cmake/batches.py ${folder}/${target} 8 1500 ${sources}
                  OUTPUT_VARIABLE batches OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" batches "${batches}")
  set_property(TARGET ${target} PROPERTY SOURCES ${kept} ${batches})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU") # it takes an included source for a header
    list(FILTER batches INCLUDE REGEX "^${folder}/")
    set_source_files_properties(${batches} PROPERTIES COMPILE_OPTIONS -Wno-subobject-linkage)
  endif()
endfunction()
