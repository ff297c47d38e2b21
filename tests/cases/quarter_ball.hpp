/// A ball of 50 mm by a quarter of its section: its mesh and probes on its equator.
#pragma once

#include <fmt/format.h>

#include <string>

namespace solidus::testing {

/// A script for Gmsh with triangles of a size [mm] and the groups "equator", "skin", "axis" and "ball".
inline std::string quarter_ball(double size) {
  return fmt::format(R"(h = {};
Point(1) = {{0, 0, 0, h}};
Point(2) = {{50, 0, 0, h}};
Point(3) = {{0, 50, 0, h}};
Line(1) = {{1, 2}};
Circle(2) = {{2, 1, 3}};
Line(3) = {{3, 1}};
Line Loop(1) = {{1, 2, 3}};
Plane Surface(1) = {{1}};
Physical Line("equator") = {{1}};
Physical Line("skin") = {{2}};
Physical Line("axis") = {{3}};
Physical Surface("ball") = {{1}};
)",
                     size);
}

/// @param component  empty for a scalar
/// @param radius     where on the equator [mm]
inline std::string probe_on_equator(const std::string& name, const std::string& field,
                                    const std::string& component, int radius, const std::string& unit) {
  return fmt::format(
      "[[probe]]\nname = \"{}\"\nfield = \"{}\"\n{}point = [\"{} mm\", \"0 mm\"]\nunit = \"{}\"\n", name,
      field, component.empty() ? "" : "component = \"" + component + "\"\n", radius, unit);
}

}  // namespace solidus::testing
