/// Broken cases, meshes, materials and command lines, each with what its message must say.
#pragma once

#include <map>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace solidus::testing {

/// A small heat case that is right; every broken one is this with one thing changed.
const std::string k_good = R"(title = "A block cools"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "5 mm"]
divisions = [4, 2]
[time]
end = "2 s"
step = "1 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "cooling"
group = "x_max"
kind = "film"
coefficient = "100 W/m2/K"
ambient = "20 degC"
[[probe]]
name = "T"
field = "temperature"
point = ["5 mm", "2 mm"]
unit = "degC"
)";

/// The same block from a mesh file of two triangles, in millimetres.
const std::string k_mesh_case = R"(title = "Two triangles cool"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
file = "part.msh"
unit = "mm"
[time]
end = "2 s"
step = "1 s"
[[body]]
name = "part"
material = "steel_mould"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "cooling"
group = "side"
kind = "film"
coefficient = "100 W/m2/K"
ambient = "20 degC"
)";

/// Gmsh's format 2.2: a square of two triangles, its left side named.
inline std::string mesh(const std::string& nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n",
                        const std::string& triangles = "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n",
                        const std::string& names = "2\n2 1 \"part\"\n1 2 \"side\"\n") {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" +
         (names.empty() ? "" : "$PhysicalNames\n" + names + "$EndPhysicalNames\n") + "$Nodes\n4\n" + nodes +
         "$EndNodes\n$Elements\n3\n" + triangles + "3 1 2 2 2 4 1\n$EndElements\n";
}

const std::string k_material = R"(title = "A material"
density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
)";

/// It yields too; its flow stress is in line 9, last.
const std::string k_plastic_material = k_material + R"(young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "1.2e-5 1/K"
[plasticity]
flow_stress = { argument_unit = "degC", unit = "MPa", points = [[20, 300], [600, 90]] }
)";

/// `text` with the first `what` replaced; a test that changes nothing would prove nothing.
inline std::string changed(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error("the broken case is the good one: " + what);
  return text.replace(at, what.size(), with);
}
inline std::string good_but(const std::string& what, const std::string& with) {
  return changed(k_good, what, with);
}

struct BadInput {
  std::string name;                          ///< what is wrong
  std::map<std::string, std::string> files;  ///< name -> content
  std::string arguments;                     ///< of the program, run in the folder of the files
  std::vector<std::string> phrases;          ///< that its message must hold
};

inline void PrintTo(const BadInput& input, std::ostream* out) {
  *out << input.name;
}

inline BadInput bad_case(const std::string& name, const std::string& content,
                         std::vector<std::string> phrases) {
  return {name, {{"case.toml", content}}, "check case.toml", std::move(phrases)};
}
inline BadInput bad_mesh(const std::string& name, const std::string& content,
                         std::vector<std::string> phrases) {
  return {name, {{"case.toml", k_mesh_case}, {"part.msh", content}}, "check case.toml", std::move(phrases)};
}
inline BadInput bad_material(const std::string& name, const std::string& content,
                             std::vector<std::string> phrases) {
  return {name,
          {{"case.toml", good_but("\"steel_mould\"", "\"own.toml\"")}, {"own.toml", content}},
          "check case.toml",
          std::move(phrases)};
}
inline BadInput bad_arguments(const std::string& name, const std::string& arguments,
                              std::vector<std::string> phrases) {
  return {name, {{"case.toml", k_good}}, arguments, std::move(phrases)};
}

inline std::vector<BadInput> files_and_syntax() {
  return {
      bad_case("included_name_that_no_system_takes",
               "include = \"" + std::string(300, 'x') + ".toml\"\n" + k_good,
               {"case.toml:1:11", "does not exist"}),
      {"missing_case", {}, "check nowhere.toml", {"nowhere.toml", "no such file"}},
      {"folder_without_case", {}, "check .", {"the folder has no case.toml"}},
      bad_case("empty_file", "", {"case.toml", "empty"}),
      bad_case("binary_garbage",
               std::string("\x7f"
                           "ELF\0\0\x01\x02",
                           8),
               {"case.toml", "not a text file"}),
      bad_case("not_utf8", good_but("block cools", "block \xff\xfe"), {"case.toml:1:"}),
      bad_case("syntax", good_but("kind = \"plane_strain\"", "kind = = \"plane_strain\""), {"case.toml:3:"}),
      bad_case("open_quote", good_but("\"A block cools\"", "\"A block cools"), {"case.toml:1:"}),
      bad_case("key_given_twice", good_but("step = \"1 s\"", "end = \"3 s\"\nstep = \"1 s\""),
               {"case.toml:13:"}),
      bad_case("missing_include", "include = \"base.toml\"\n", {"case.toml:1:11", "does not exist"}),
      bad_case("include_of_itself", "include = \"case.toml\"\n", {"case.toml:1:11", "included by itself"}),
  };
}

inline std::vector<BadInput> keys_and_values() {
  return {
      bad_case("typo_in_a_section", good_but("initial_temperature", "initial_temprature"),
               {"case.toml:17:1", "unknown key 'initial_temprature' in [[body]]",
                "did you mean 'initial_temperature'?"}),
      bad_case("typo_in_a_heading", good_but("[time]", "[tiem]"),
               {"case.toml:11:", "'tiem'", "did you mean 'time'?"}),
      bad_case("single_instead_of_double_brackets", good_but("[[body]]", "[body]"), {"'body'", "[[body]]"}),
      bad_case("missing_key", good_but("material = \"steel_mould\"\n", ""),
               {"case.toml:14", "'material' is missing in [[body]]"}),
      bad_case("text_instead_of_list", good_but("[4, 2]", "\"4\""),
               {"case.toml:10:13", "'divisions'", "a list"}),
      bad_case("number_instead_of_text", good_but("\"A block cools\"", "3"),
               {"case.toml:1:9", "the number 3", "text"}),
      bad_case("fraction_instead_of_whole_number", good_but("[4, 2]", "[4.5, 2]"),
               {"case.toml:10:", "whole number"}),
      bad_case("wrong_dimension", good_but("step = \"1 s\"", "step = \"1 kg\""),
               {"case.toml:13:8", "'step'", "a time"}),
      bad_case("unknown_unit", good_but("step = \"1 s\"", "step = \"1 fortnite\""),
               {"case.toml:13:8", "fortnite"}),
      bad_case("no_unit", good_but("step = \"1 s\"", "step = 1"), {"case.toml:13:8", "without a unit", "\""}),
      bad_case("negative_step", good_but("step = \"1 s\"", "step = \"-1 s\""),
               {"case.toml:13:8", "out of range", "above 0 s"}),
      bad_case("below_absolute_zero", good_but("\"200 degC\"", "\"-300 degC\""),
               {"case.toml:17:23", "above 0 K"}),
      bad_case("not_a_number", good_but("[4, 2]", "[nan, 2]"), {"case.toml:10:14", "not finite"}),
      bad_case("infinite_quantity", good_but("step = \"1 s\"", "step = \"inf s\""),
               {"case.toml:13:8", "'step'"}),
      bad_case("huge_number", good_but("step = \"1 s\"", "step = \"1e999 s\""), {"case.toml:13:8", "'step'"}),
      bad_case("huge_divisions", good_but("[4, 2]", "[99999999999999999999, 2]"), {"case.toml:10:"}),
      bad_case("too_many_elements", good_but("[4, 2]", "[100000, 100000]"),
               {"case.toml:5", "1e+10 elements"}),
      bad_case("too_many_steps", good_but("step = \"1 s\"", "step = \"1e-12 s\""),
               {"case.toml:11:", "steps"}),
      bad_case("date", good_but("step = \"1 s\"", "step = 2020-01-01"), {"case.toml:13:8", "date"}),
      bad_case("unknown_choice", good_but("\"plane_strain\"", "\"plane_stress\""),
               {"case.toml:3:8", "did you mean 'plane_strain'?"}),
      bad_case(
          "key_of_another_kind", k_good.substr(0, k_good.find("[[probe]]")) + "emissivity = 0.3\n",
          {"case.toml:24:", "'emissivity' does not belong to [[thermal_condition]] with kind = \"film\""}),
      bad_case("table_out_of_order",
               good_but("\"20 degC\"",
                        "{ of = \"time\", argument_unit = \"s\", unit = \"degC\", points = [[0, 20], [10, "
                        "30], [5, 40]] }"),
               {"case.toml:23:", "point 3 of 'ambient'", "must increase"}),
      bad_case("table_without_unit",
               good_but("\"20 degC\"", "{ argument_unit = \"s\", points = [[0, 20], [10, 30]] }"),
               {"case.toml:23:", "without a unit"}),
      bad_case("negative_film", good_but("\"100 W/m2/K\"", "\"-100 W/m2/K\""),
               {"case.toml:22:15", "at least 0 W/m2/K"}),
  };
}

inline std::vector<BadInput> contradictions() {
  const std::string mechanical = good_but("physics = \"heat\"", "physics = \"thermomechanical\"");
  const auto with = [&](const std::string& more) { return mechanical + more; };
  const std::string film =
      "[[thermal_condition]]\nname = \"cooling\"\ngroup = \"x_min\"\nkind = \"flux\"\nflux = \"1 W/m2\"\n";
  return {
      bad_case("no_mesh", good_but("shape = \"block\"\n", ""),
               {"'block' does not belong to [mesh] without 'shape'", "it needs shape = block"}),
      bad_case("mesh_twice", good_but("shape = \"block\"", "shape = \"block\"\nfile = \"part.msh\""),
               {"both a shape and a file"}),
      bad_case("element_of_another_dimension", good_but("quad4", "hex8"), {"hex8", "quad4"}),
      bad_case("step_longer_than_the_run", good_but("step = \"1 s\"", "step = \"1 h\""),
               {"case.toml:11", "longer than the whole time"}),
      bad_case(
          "no_body",
          changed(k_good,
                  k_good.substr(k_good.find("[[body]]"), k_good.find("[[thermal") - k_good.find("[[body]]")),
                  ""),
          {"no body"}),
      bad_case("name_used_twice", k_good + film, {"'cooling' is used by two"}),
      bad_case("unknown_material", good_but("\"steel_mould\"", "\"steel_mold\""),
               {"case.toml:14", "did you mean 'steel_mould'?"}),
      bad_case("unknown_group", good_but("\"x_max\"", "\"x_mox\""), {"case.toml:18", "'x_mox'", "x_max"}),
      bad_case("body_without_group", good_but("name = \"block\"", "name = \"blok\""),
               {"case.toml:14", "'blok'", "block"}),
      bad_case("probe_outside", good_but("[\"5 mm\", \"2 mm\"]", "[\"5 m\", \"2 mm\"]"), {"'T'", "outside"}),
      bad_case("probe_in_a_wrong_unit", good_but("unit = \"degC\"", "unit = \"mm\""),
               {"'T'", "a temperature"}),
      bad_case("probe_of_an_unknown_field", good_but("field = \"temperature\"", "field = \"temprature\""),
               {"did you mean 'temperature'?"}),
      bad_case("component_that_is_not_there",
               with("[[mechanical_condition]]\nname = \"fix\"\ngroup = \"x_min\"\nkind = "
                    "\"displacement\"\nur = \"0 m\"\n"),
               {"'fix'", "'ur'", "ux, uy"}),
      bad_case("contact_with_itself",
               with("[[contact]]\nname = \"c\"\nslave = \"x_max\"\nmaster = \"x_max\"\n"),
               {"one surface on both sides"}),
      bad_case("contact_with_an_unknown_surface",
               with("[[contact]]\nname = \"c\"\nslave = \"x_max\"\nmaster = \"y_mix\"\n"),
               {"'y_mix'", "y_min"}),
  };
}

inline std::vector<BadInput> meshes() {
  return {
      {"missing_mesh", {{"case.toml", k_mesh_case}}, "check case.toml", {"part.msh"}},
      bad_mesh("empty_mesh", "", {"part.msh", "empty"}),
      bad_mesh("mesh_of_garbage", std::string("\x01\x02\xff\xfe\0\0MZ", 8), {"part.msh"}),
      bad_mesh("truncated_mesh", mesh().substr(0, 150), {"part.msh"}),
      bad_mesh("mesh_without_names",
               mesh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n", "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n", ""),
               {"part"}),
      bad_mesh("mesh_without_the_group",
               mesh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n", "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n",
                    "2\n2 1 \"part\"\n1 2 \"sight\"\n"),
               {"'side'", "sight"}),
      bad_mesh("flat_element", mesh("1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n"), {"part.msh", "1"}),
      bad_mesh("node_that_is_not_a_number", mesh("1 0 0 0\n2 1 0 0\n3 nan 1 0\n4 0 1 0\n"), {"part.msh"}),
      bad_mesh("node_that_does_not_exist",
               mesh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n", "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 99\n"),
               {"part.msh"}),
      {"unit_that_is_no_length",
       {{"case.toml", changed(k_mesh_case, "\"mm\"", "\"kg\"")}, {"part.msh", mesh()}},
       "check case.toml",
       {"'kg'", "length"}},
      {"solid_analysis_of_a_plane_mesh",
       {{"case.toml", changed(k_mesh_case, "plane_strain", "solid")}, {"part.msh", mesh()}},
       "check case.toml",
       {"part.msh"}},
      {"negative_radius",
       {{"case.toml", changed(k_mesh_case, "plane_strain", "axisymmetric")},
        {"part.msh", mesh("1 -1 0 0\n2 1 0 0\n3 1 1 0\n4 -1 1 0\n")}},
       "check case.toml",
       {"radius"}},
  };
}

inline std::vector<BadInput> material_files() {
  return {
      {"missing_material_file",
       {{"case.toml", good_but("\"steel_mould\"", "\"own.toml\"")}},
       "check case.toml",
       {"own.toml"}},
      bad_material("negative_conductivity", changed(k_material, "\"40 W", "\"-40 W"),
                   {"own.toml:3:16", "'conductivity'", "above 0"}),
      bad_material("missing_density", changed(k_material, "density = \"7800 kg/m3\"\n", ""),
                   {"own.toml", "'density'"}),
      bad_material("wrong_unit_of_a_property", changed(k_material, "J/kg/K", "J/kg"),
                   {"own.toml:4:17", "'specific_heat'"}),
      bad_material("unknown_property", k_material + "colour = \"grey\"\n",
                   {"own.toml:5:1", "unknown key 'colour'"}),
      bad_material("property_table_out_of_order",
                   changed(k_material, "\"40 W/m/K\"",
                           "{ argument_unit = \"degC\", unit = \"W/m/K\", points = [[100, 40], [20, 50]] }"),
                   {"own.toml:3:", "point 2 of 'conductivity'"}),
      bad_material("flow_stress_that_rises_with_temperature", changed(k_plastic_material, "90]]", "310]]"),
                   {"own.toml:9:15", "from 300 MPa at 20 degC to 310 MPa at 600 degC", "2.121",
                    "allow_thermal_hardening"}),
      bad_material("flow_stress_in_the_wrong_unit", changed(k_plastic_material, "\"MPa\"", "\"GPa\""),
                   {"own.toml:9:15", "tenth of Young's modulus", "is a unit wrong?"}),
      bad_material("plasticity_without_stiffness",
                   changed(k_plastic_material,
                           "young_modulus = \"200 GPa\"\npoisson_ratio = "
                           "0.3\nexpansion = \"1.2e-5 1/K\"\n",
                           ""),
                   {"own.toml:5", "no elastic properties"}),
      bad_material("hardening_without_its_modulus", k_plastic_material + "isotropic_hardening = \"linear\"\n",
                   {"own.toml:8", "'hardening_modulus' is missing"}),
      bad_material("key_of_another_hardening", k_plastic_material + "saturation_rate = 10\n",
                   {"own.toml:10:19", "'saturation_rate' does not belong", "saturation"}),
      bad_material("rate_exponent_too_small",
                   k_plastic_material + "rate_dependence = \"perzyna\"\nviscosity = \"1e9 Pa "
                                        "s\"\nrate_exponent = 0.05\n",
                   {"own.toml:12:17", "'rate_exponent'", "at least 0.1"}),
      bad_material("flow_curve_that_softens",
                   changed(k_plastic_material, "flow_stress", "isotropic_hardening = \"table\" # ") +
                       "[[plasticity.flow_curve]]\ntemperature = \"20 degC\"\nstress = { unit = \"MPa\", "
                       "points = [[0, 300], [0.1, 250]] }\n",
                   {"own.toml:12:10", "falls from 300 MPa", "softening is not supported"}),
      bad_material("liquid_model_of_what_never_melts",
                   "liquid_model = \"degenerated\"\n" + k_plastic_material,
                   {"own.toml", "does not solidify"}),
      {"mechanics_of_a_material_without_stiffness",
       {{"case.toml", changed(good_but("\"steel_mould\"", "\"own.toml\""), "physics = \"heat\"",
                              "physics = \"thermomechanical\"")},
        {"own.toml", k_material}},
       "check case.toml",
       {"case.toml:14", "no elastic properties"}},
      {"melt_without_stiffness",
       {{"case.toml", changed(changed(good_but("\"steel_mould\"", "\"own.toml\""), "physics = \"heat\"",
                                      "physics = \"thermomechanical\""),
                              "200 degC", "650 degC")},
        {"own.toml", "like = \"aluminium_alsi7mg\"\nliquid_model = \"modified_shear\"\n"}},
       "check case.toml",
       {"case.toml:14", "a melt has no stiffness against shear", "maxwell"}},
  };
}

inline std::vector<BadInput> command_lines() {
  return {
      bad_arguments("no_verb", "", {"--help"}),
      bad_arguments("unknown_verb", "chekc case.toml", {"'chekc'", "did you mean 'check'?"}),
      bad_arguments("unknown_option", "check case.toml --speed 3", {"--speed"}),
      bad_arguments("no_case", "run", {"CASE"}),
      bad_arguments("override_without_value", "check case.toml --set time.step", {"no assignment"}),
      bad_arguments("override_of_an_unknown_key", "check case.toml --set time.setp='1 s'",
                    {"--set time.setp=1 s", "did you mean 'step'?"}),
      bad_arguments("override_of_an_unknown_body", "check case.toml --set body.blok.material=x",
                    {"'blok'", "did you mean 'block'?"}),
      bad_arguments("explanation_of_an_unknown_key", "explain time.stop", {"'stop'", "did you mean 'step'?"}),
      bad_arguments("material_that_is_not_there", "materials aluminum_99_7",
                    {"did you mean 'aluminium_99_7'?"}),
      bad_arguments("tables_of_no_material", "materials -o tables", {"materials NAME -o FOLDER"}),
      {"tables_where_a_file_is",
       {{"taken", "a file"}},
       "materials steel_mould -o taken/here",
       {"taken/here"}},
      {"results_where_a_file_is",
       {{"case.toml", k_good}, {"taken", "a file"}},
       "run case.toml -o taken/here",
       {"taken"}},
      {"results_among_foreign_files",
       {{"case.toml", k_good}, {"mine/history.csv", "my own data"}},
       "run case.toml -o mine",
       {"mine", "did not write"}},
  };
}

inline std::vector<BadInput> all() {
  std::vector<BadInput> inputs;
  for (auto&& part :
       {files_and_syntax(), keys_and_values(), contradictions(), meshes(), material_files(), command_lines()})
    inputs.insert(inputs.end(), part.begin(), part.end());
  return inputs;
}

}  // namespace solidus::testing
