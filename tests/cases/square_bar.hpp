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
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace solidus::testing {

enum class Piece { quarter, half, whole };

/// A mesh in Gmsh's format 2.2 [mm]: bodies 1 'cast' and 2 'die'; lines 'c_skin' and 'd_in' that face each
/// other, 'd_out', and along the axes, planes of symmetry of a piece, 'cx', 'cy', 'dx', 'dy'.
inline std::string square_bar(Piece piece, int cells, double a = 20, double b = 40) {
  struct Element {
    int group;
    std::vector<int> nodes;
  };
  enum Group { cast = 1, die, c_skin, d_in, d_out, cx, cy, dx, dy };
  std::map<std::pair<long, long>, int> number[2];
  std::vector<std::pair<double, double>> places;
  std::vector<Element> lines, triangles;
  const double h = a / cells;
  const int outside = static_cast<int>(std::lround(b / h));
  const auto node = [&](int body, int i, int j) {
    const auto [found, fresh] = number[body].try_emplace({i, j}, static_cast<int>(places.size()) + 1);
    if (fresh) places.emplace_back(i * h, j * h);
    return found->second;
  };
  const int from_x = piece == Piece::whole ? -outside : 0, from_y = piece == Piece::quarter ? 0 : -outside;
  const auto line = [&](int group, int body, int i, int j, int k, int l) {
    lines.push_back({group, {node(body, i, j), node(body, k, l)}});
  };
  for (int i = from_x; i < outside; ++i)
    for (int j = from_y; j < outside; ++j) {
      const bool inside = i >= -cells && i < cells && j >= -cells && j < cells;
      const int body = inside ? 0 : 1, group = inside ? cast : die;
      const int p = node(body, i, j), q = node(body, i + 1, j), r = node(body, i + 1, j + 1),
                s = node(body, i, j + 1);
      if ((i >= 0) == (j >= 0)) {
        triangles.push_back({group, {p, q, r}});
        triangles.push_back({group, {p, r, s}});
      } else {
        triangles.push_back({group, {p, q, s}});
        triangles.push_back({group, {q, r, s}});
      }
      if (i == 0) line(inside ? cx : dx, body, i, j + 1, i, j);
      if (j == 0) line(inside ? cy : dy, body, i, j, i + 1, j);
      if (i + 1 == outside) line(d_out, body, i + 1, j, i + 1, j + 1);
      if (i == -outside) line(d_out, body, i, j + 1, i, j);
      if (j + 1 == outside) line(d_out, body, i + 1, j + 1, i, j + 1);
      if (j == -outside) line(d_out, body, i, j, i + 1, j);
      if (!inside) continue;
      const auto face = [&](int k, int l, int m, int n) {
        line(c_skin, 0, k, l, m, n);
        line(d_in, 1, m, n, k, l);
      };
      if (i + 1 == cells) face(i + 1, j, i + 1, j + 1);
      if (i == -cells) face(i, j + 1, i, j);
      if (j + 1 == cells) face(i + 1, j + 1, i, j + 1);
      if (j == -cells) face(i, j, i + 1, j);
    }
  std::ostringstream out;
  out.precision(17);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n9\n2 1 \"cast\"\n2 2 \"die\"\n1 3 "
         "\"c_skin\"\n"
         "1 4 \"d_in\"\n1 5 \"d_out\"\n1 6 \"cx\"\n1 7 \"cy\"\n1 8 \"dx\"\n1 9 \"dy\"\n$EndPhysicalNames\n"
      << "$Nodes\n"
      << places.size() << "\n";
  for (std::size_t i = 0; i < places.size(); ++i)
    out << i + 1 << " " << places[i].first << " " << places[i].second << " 0\n";
  out << "$EndNodes\n$Elements\n" << lines.size() + triangles.size() << "\n";
  int n = 0;
  for (const auto* list : {&lines, &triangles})
    for (const Element& e : *list) {
      out << ++n << (list == &lines ? " 1 2 " : " 2 2 ") << e.group << " " << e.group;
      for (const int v : e.nodes) out << " " << v;
      out << "\n";
    }
  out << "$EndElements\n";
  return out.str();
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
