/// The verb `new`: makes a case that runs from the geometry of a casting (docs/guide/new_case.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "mesh/shape.hpp"

namespace solidus::new_case {

struct NewCaseOptions {
  std::filesystem::path geometry;        ///< STEP, BREP, IGES, STL, or a mesh
  std::string process = "sand";          ///< sand, shell, gravity_die, high_pressure
  std::string alloy;                     ///< a material of the library, or a file
  std::string unit;                      ///< of the file; empty: what the file says, else mm
  bool riser = false;                    ///< risers on the thick places
  std::filesystem::path feeders;         ///< a file of risers and chills; empty: none
  std::filesystem::path gating;          ///< a file of gating; empty: none
  std::string symmetry;                  ///< "x", "y", "z": half of the part; empty: all of it
  std::vector<std::string> as;           ///< "NAME=role" of bodies of the file
  std::filesystem::path folder;          ///< for the case; empty: the file's name, here
  double fineness = 1;                   ///< so many times as many elements along each edge
  int shots = 0;                         ///< castings in a row, in a die; zero: one casting, without stages
  double shell = 0;                      ///< thickness of an investment shell [m]; zero: that of the process
  bool fill = false;                     ///< the run fills the mould first
  std::optional<mesh::Point> gate = {};  ///< place of the gate [m]; none: the program chooses
  bool preview = false;                  ///< nothing is written: the report is what would be made, as JSON
};

/// The names of the processes.
std::vector<std::string> processes();

struct NewCaseReport {
  std::filesystem::path file;  ///< the case
  std::string text;            ///< report on measured and chosen values, several lines
};

/// Measures the parts, chooses mould, sizes, temperatures, laws and the length of the run, writes the folder
/// with case.toml and a copy of the geometry, and checks that the case is in order. On one process.
/// Throws InputError.
NewCaseReport make_new_case(const NewCaseOptions& options);

}  // namespace solidus::new_case
