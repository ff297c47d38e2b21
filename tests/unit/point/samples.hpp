/// A small point file; tests change one thing in it.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "point/point_case.hpp"

namespace solidus::point {

inline const std::string k_point_file = R"(title = "Tension"
material = "low_carbon_steel"
temperature = "20 degC"
[[segment]]
strain = 0.01
strain_rate = "1e-3 1/s"
steps = 10
)";

inline PointCase read_point(const std::string& text) {
  const std::vector<std::filesystem::path> library = {SOLIDUS_SOURCE_DIR "/materials"};
  return make_point_case(parse_document(text, "point.toml"), library);
}

/// Returns the message of the error that a text causes; empty: none.
inline std::string error_of(const std::string& text) {
  try {
    for (const Curve& curve : read_point(text).curves) run(curve.material, curve.program);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline std::string changed(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error("not in the text: " + what);
  return text.replace(at, what.size(), with);
}

}  // namespace solidus::point
