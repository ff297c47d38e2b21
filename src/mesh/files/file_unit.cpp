/// The file's own unit wins; a unit of the user must agree with it, and is taken where the file has none.
#include "mesh/files/file_unit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "input/units.hpp"
#include "mesh/files/file_format.hpp"

namespace solidus::mesh {

namespace {

bool is_regular(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

}  // namespace

std::optional<LengthUnit> unit_of_file(const std::string& path) {
  if (!is_regular(path)) return std::nullopt;
  const FileFormat& format = file_format(path);
  return format.unit == nullptr ? std::nullopt : format.unit(path);
}

double metres_of_unit(const std::string& path, const std::string& told, const std::string& otherwise,
                      const SourceLocation& where) {
  // What the user says must be a length at all.
  if (!told.empty() && !units::compatible(told, "m"))
    throw InputError(where, fmt::format("'{}' is no unit of length", told), "\"mm\", \"m\", \"inch\", ...");
  std::optional<LengthUnit> own;
  bool in_mm = false;
  // A file that cannot be read says nothing of its unit here; the reader tells what is wrong with
  // it.
  try {
    own = unit_of_file(path);
    in_mm = is_regular(path) && file_format(path).in_mm;
  } catch (const InputError&) {  // NOLINT: the reader says what is wrong with the file
  }
  constexpr double k_mm = 1e-3;
  // What the file says, which the user must not contradict; else what the user says, else mm for geometries
  // of CAD.
  if (!own) return units::convert(1, !told.empty() ? told : in_mm ? "mm" : otherwise, "m");
  if (!told.empty()) {
    constexpr double k_rounding = 1e-5;
    if (const double metres = units::convert(1, told, "m");
        !(std::abs(metres / own->metres - 1) < k_rounding))
      throw InputError(
          where,
          fmt::format("the unit '{}' contradicts the file '{}', which says itself that its lengths are in {}",
                      told, path, own->name),
          own->metres > 0 ? fmt::format("no unit, or \"{}\"", own->name) : "no unit");
  }
  return k_mm;
}

}  // namespace solidus::mesh
