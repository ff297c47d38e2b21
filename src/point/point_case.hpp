/// Reads a point file: the curves to compute.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "input/document.hpp"
#include "material/material.hpp"
#include "point/measured.hpp"
#include "point/point_history.hpp"
#include "point/spec.hpp"

namespace solidus::point {

struct Curve {
  std::string name, label;
  material::Material material;
  Program program;
  std::optional<Measured> measured;
};

struct PointCase {
  std::string title;
  std::vector<Curve> curves;
  std::vector<PictureSpec> pictures;
  Value document;  ///< with every default filled in, paths absolute
};

/// Checks everything and loads materials and measured points. Throws InputError with the place.
/// @param document  a file as load_document gives it, perhaps with keys changed
/// @param library   folders in which materials are found by name
PointCase make_point_case(Value document, std::span<const std::filesystem::path> library);

}  // namespace solidus::point
