# The instances of the element kernels, one object per row of the list and analysis kind: what is in one row shares templates and is
# compiled together. The shapes come from src/mesh/shape_table.hpp. To add a law to the kernels is a row here.
#   name | header of src/mechanics/elements that has the makers, several with a comma | makers and their laws
set(kernels
    "viscoelastic|law_kernels.hpp|law material::Viscoelastic"
    # The kernels of the simultaneous scheme derive from those of the viscoplastic law.
    "viscoplastic|law_kernels.hpp,coupled_kernels.hpp|law material::Viscoplastic,coupled"
    "isentropic|law_kernels.hpp|law material::Isentropic"
    "external|external_block_law.hpp,law_kernels.hpp|law ExternalBlockLaw"
    "mixed|mixed_kernels.hpp|mixed")
set(arguments "const mesh::Mesh&, const mesh::ElementBlock&, const material::Material&")
foreach(row ${kernels})
  string(REPLACE "|" ";" row "${row}")
  list(GET row 0 name)
  list(GET row 1 headers)
  list(GET row 2 makers)
  string(REPLACE "," ";" headers "${headers}")
  string(REPLACE "," ";" makers "${makers}")
  foreach(kind plane_strain axisymmetric solid)
    set(text "// Made by cmake/element_kernels.cmake.\n")
    foreach(header ${headers})
      string(APPEND text "#include \"mechanics/elements/${header}\"\n")
    endforeach()
    string(APPEND text "\nnamespace solidus::mechanics {\n\n")
    set(analysis "AnalysisKind::${kind}")
    foreach(maker ${makers})
      if(maker MATCHES "^law (.*)$")
        set(instance "make_block<${CMAKE_MATCH_1}, ${analysis}>(${arguments}, bool)")
      elseif(maker STREQUAL "coupled")
        set(instance "make_coupled_block<${analysis}>(${arguments}, bool)")
      else()
        set(instance "make_mixed_block<${analysis}>(${arguments}, Mapping, Stabilisation)")
      endif()
      string(APPEND text "template std::unique_ptr<BlockKernel> ${instance};\n")
    endforeach()
    string(APPEND text "\n}  // namespace solidus::mechanics\n")
    set(file ${CMAKE_BINARY_DIR}/made/kernels/${name}_${kind}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY) # leaves a file alone that would not change
    target_sources(solidus_mechanics PRIVATE ${file})
    set_source_files_properties(${file} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # each is a batch already
  endforeach()
endforeach()
