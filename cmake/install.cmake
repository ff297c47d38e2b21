# What `cmake --install` brings. The component `program`: the program, materials, interfaces, the Python modules that draw, cases as
# examples, schemas, completion for shells, the manual page and the documents; the program finds them relative to itself, so that the
# prefix may be moved. The component `development`: the libraries with their headers and what find_package(solidus) needs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(shared ${CMAKE_INSTALL_DATADIR}/solidus)

install(TARGETS solidus COMPONENT program)
install(TARGETS solidus_reader DESTINATION libexec/solidus COMPONENT program) # found relative to the program (src/mesh/making/reader_process.cpp)
install(DIRECTORY materials interfaces DESTINATION ${shared} COMPONENT program)
install(DIRECTORY python DESTINATION ${shared} COMPONENT program PATTERN __pycache__ EXCLUDE)
install(DIRECTORY cases DESTINATION ${shared} COMPONENT program PATTERN __pycache__ EXCLUDE PATTERN results EXCLUDE)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program)
install(FILES README.md CHANGELOG.md LICENSE SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# The version is in CMakeLists.txt alone: what is installed says in its citation which one it is.
file(READ CITATION.cff citation)
file(WRITE ${PROJECT_BINARY_DIR}/made/CITATION.cff "${citation}version: \"${SOLIDUS_PACKAGE_VERSION}\"\n")
install(FILES ${PROJECT_BINARY_DIR}/made/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
if(TARGET solidus_python)
  install(TARGETS solidus_python LIBRARY DESTINATION ${shared}/python/solidus_casting COMPONENT program)
endif()

# Debian's Python looks for packages in /usr/lib/python3/dist-packages: there a file names the folder that has ours. In another prefix no
# Python reads it.
file(WRITE ${PROJECT_BINARY_DIR}/made/solidus.pth "../../../share/solidus/python\n")
install(FILES ${PROJECT_BINARY_DIR}/made/solidus.pth DESTINATION lib/python3/dist-packages COMPONENT program)

# The program that was just installed writes them, from its own declarations.
install(CODE "
  set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
  set(program \"\${prefix}/${CMAKE_INSTALL_BINDIR}/solidus\")
  function(solidus_writes file)
    message(STATUS \"Installing: \${prefix}/\${file}\")
    get_filename_component(folder \"\${prefix}/\${file}\" DIRECTORY)
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND \"\${program}\" \${ARGN} OUTPUT_FILE \"\${prefix}/\${file}\" RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR \"\${program} \${ARGN}: \${failed}\")
    endif()
  endfunction()
  solidus_writes(${CMAKE_INSTALL_DATADIR}/bash-completion/completions/solidus completion bash)
  solidus_writes(${CMAKE_INSTALL_DATADIR}/zsh/site-functions/_solidus completion zsh)
  solidus_writes(${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d/solidus.fish completion fish)
  solidus_writes(${CMAKE_INSTALL_MANDIR}/man1/solidus.1 man)
  solidus_writes(${shared}/schema/case.schema.json schema)
  solidus_writes(${shared}/schema/material.schema.json schema --material)
  solidus_writes(${shared}/schema/point.schema.json schema --point)
" COMPONENT program)

# The libraries: solidus::run for whole cases, solidus::material for laws and cards, and so on, one a folder of src.
get_property(rooms GLOBAL PROPERTY SOLIDUS_ROOMS)
foreach(room ${rooms} solidus_options)
  string(REPLACE solidus_ "" name ${room})
  set_target_properties(${room} PROPERTIES EXPORT_NAME ${name})
endforeach()
install(TARGETS ${rooms} solidus_options EXPORT solidus_targets COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/solidus)
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/solidus COMPONENT development
        FILES_MATCHING PATTERN *.hpp PATTERN app EXCLUDE)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/solidus)
install(EXPORT solidus_targets NAMESPACE solidus:: DESTINATION ${config} COMPONENT development)
configure_package_config_file(cmake/solidus-config.cmake.in made/solidus-config.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(made/solidus-config-version.cmake COMPATIBILITY ExactVersion)
install(FILES ${PROJECT_BINARY_DIR}/made/solidus-config.cmake ${PROJECT_BINARY_DIR}/made/solidus-config-version.cmake
        cmake/dependencies.cmake DESTINATION ${config} COMPONENT development)
install(DIRECTORY examples/embed DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libsolidus-dev/examples COMPONENT development)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libsolidus-dev COMPONENT development)
