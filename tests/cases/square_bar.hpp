/// A square bar of metal in a closed square die, and pieces of it: meshes of triangles that are mirror images
/// of each other about the planes of symmetry.
///
///   ┌─────────────┐ b   die  from a to b
///   │   ┌─────┐ a │     bar  from −a to a; a half has x ≥ 0, a quarter x ≥ 0 and y ≥ 0
///   │   │  ╳  │   │
///   │   └─────┘   │
///   └─────────────┘
#pragma once

#include <cmath>
#include <string>

#include "triangle_grid.hpp"

namespace solidus::testing {

enum class Piece { quarter, half, whole };

/// Its mesh [mm]; groups as in triangle_grid.hpp, 'cx' to 'dy' along the axes.
inline std::string square_bar(Piece piece, int cells, double a = 20, double b = 40) {
  using Grid = TriangleGrid;
  const double h = a / cells;
  const int outside = static_cast<int>(std::lround(b / h));
  const int from_x = piece == Piece::whole ? -outside : 0, from_y = piece == Piece::quarter ? 0 : -outside;
  Grid grid(h);
  for (int i = from_x; i < outside; ++i)
    for (int j = from_y; j < outside; ++j) {
      const bool inside = i >= -cells && i < cells && j >= -cells && j < cells;
      const Grid::Group body = inside ? Grid::cast : Grid::die;
      grid.square(body, i, j, (i >= 0) == (j >= 0) ? Grid::Diagonal::rising : Grid::Diagonal::falling);
      if (i == 0) grid.line(inside ? Grid::cx : Grid::dx, body, i, j + 1, i, j);
      if (j == 0) grid.line(inside ? Grid::cy : Grid::dy, body, i, j, i + 1, j);
      if (i + 1 == outside) grid.line(Grid::d_out, body, i + 1, j, i + 1, j + 1);
      if (i == -outside) grid.line(Grid::d_out, body, i, j + 1, i, j);
      if (j + 1 == outside) grid.line(Grid::d_out, body, i + 1, j + 1, i, j + 1);
      if (j == -outside) grid.line(Grid::d_out, body, i, j, i + 1, j);
      if (!inside) continue;
      if (i + 1 == cells) grid.wall(i + 1, j, i + 1, j + 1);
      if (i == -cells) grid.wall(i, j + 1, i, j);
      if (j + 1 == cells) grid.wall(i + 1, j + 1, i, j + 1);
      if (j == -cells) grid.wall(i, j, i + 1, j);
    }
  return grid.text();
}

/// The case of a piece in the file `mesh`: AlSi7Mg at 680 °C in H13 at 200 °C, with a gap that gas fills.
inline std::string square_bar_case(Piece piece, const std::string& mesh, bool gravity,
                                   const std::string& material = "aluminium_alsi7mg") {
  std::string text = "title = \"A bar in a die\"\n[analysis]\nkind = \"plane_strain\"\n";
  if (gravity) text += "gravity = \"9.81 m/s2\"\n";
  text += "[mesh]\nfile = \"" + mesh +
          "\"\nunit = \"mm\"\n[time]\nend = \"60 s\"\nstep = \"0.5 s\"\n[[body]]\nname = \"cast\"\n"
          "material = \"" +
          material + R"("
initial_temperature = "680 degC"
[[body]]
name = "die"
material = "h13_tool_steel"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "outside"
group = "d_out"
kind = "film"
coefficient = "200 W/m2/K"
ambient = "30 degC"
[[contact]]
name = "wall"
slave = "c_skin"
master = "d_in"
[contact.heat]
conductance = "3000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.05 W/m/K"
[[probe]]
name = "T_centre"
field = "temperature"
point = ["0 mm", "0 mm"]
unit = "degC"
[[probe]]
name = "gap_corner"
field = "gap"
point = ["20 mm", "20 mm"]
body = "cast"
unit = "um"
[[probe]]
name = "gap_side"
field = "gap"
point = ["20 mm", "0 mm"]
body = "cast"
unit = "um"
[[probe]]
name = "gap_most"
field = "gap"
kind = "maximum"
group = "c_skin"
unit = "um"
[[probe]]
name = "von_mises"
field = "von_mises"
kind = "maximum"
group = "cast"
unit = "MPa"
[[probe]]
name = "pores"
field = "pore_fraction"
kind = "mean"
unit = "1"
group = "cast"
)";
  const auto plane = [&](const char* group, const char* component) {
    text += std::string("[[mechanical_condition]]\nname = \"") + group + "\"\ngroup = \"" + group +
            "\"\nkind = \"displacement\"\n" + component + " = \"0 mm\"\n";
  };
  plane("cx", "ux"), plane("dx", "ux");
  if (piece != Piece::half) plane("cy", "uy"), plane("dy", "uy");
  if (piece == Piece::half)
    text += R"([[mechanical_condition]]
name = "floor"
group = "d_out"
kind = "displacement"
uy = "0 mm"
)";
  return text;
}

}  // namespace solidus::testing
