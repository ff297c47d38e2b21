/// The neighbours of a run: the same case with one parameter changed a little, for derivatives.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "setup/case_file.hpp"

namespace solidus::run {

/// A parameter and the case in which it has changed.
struct Neighbour {
  std::string name;
  double change = 0;  ///< of the parameter, in the unit that whoever asks counts it in
  setup::Case c;
};

/// Reads a list of parameters:
///
///   [[parameter]]
///   name = "film"
///   change = 0.01
///   set = ["thermal_condition.air.coefficient=1000.01 W/m2/K"]   # as --set, in addition to those of the run
///
/// @param load  the case with further assignments
/// Throws InputError.
std::vector<Neighbour> read_neighbours(
    const std::filesystem::path& file,
    const std::function<setup::Case(const std::vector<std::string>&)>& load);

}  // namespace solidus::run
