/// Runs of small cases that tests export, and what they read in the file.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "case_folder.hpp"
#include "run/structural_export.hpp"

namespace solidus::testing {

/// Exports the last moment of a run of `here` to a file for CalculiX.
inline run::ExportReport exported(const CaseFolder& here, const std::string& run,
                                  const std::filesystem::path& file) {
  return run::export_state(
      setup::load_case(here.root() / run / "case.toml"),
      {.folder = here.root() / run, .file = file, .deck = [](const results::StructuralDeck& deck) {
         return results::structural_deck(deck, results::Dialect::calculix);
       }});
}

/// The numbers of every line below a keyword of the file, up to the next one.
inline std::vector<std::vector<double>> numbers(const std::string& deck, const std::string& keyword) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(deck.substr(deck.find(keyword)));
  std::string line, cell;
  std::getline(lines, line);
  while (std::getline(lines, line) && line[0] != '*') {
    rows.emplace_back();
    for (std::istringstream row(line); std::getline(row, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

inline const std::string k_press = R"(title = "A plate that lies on a block"
[analysis]
kind = "plane_strain"
physics = "mechanics"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "10 mm"]
upper = ["40 mm", "5 mm"]
lower_divisions = [8, 2]
upper_divisions = [8, 1]
[time]
end = "1 s"
step = "1 s"
[[body]]
name = "block"
group = "lower"
material = "steel_mould"
initial_temperature = "20 degC"
[[body]]
name = "plate"
group = "upper"
material = "steel_mould"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "ground"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "side"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "pressed"
group = "upper_y_max"
kind = "pressure"
pressure = "10 MPa"
[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
)";

}  // namespace solidus::testing
