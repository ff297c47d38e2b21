/// Our own shapes come from the table of shapes; the others of Gmsh are listed for messages.
#include "mesh/files/gmsh_elements.hpp"

#include <map>

#include "mesh/shape_table.hpp"

namespace solidus::mesh {

namespace {

/// Gmsh's name of a type that Solidus has: "Hexahedron 20".
std::string gmsh_name(const ShapeRow& row) {
  if (row.dimension == 0) return "Point";
  if (row.shape == Shape::wedge6) return "Prism 6";
  if (row.shape == Shape::pyramid5) return "Pyramid 5";
  const char* family = "Line";
  if (row.dimension == 2) family = row.reference == Reference::simplex ? "Triangle" : "Quadrilateral";
  if (row.dimension == 3) family = row.reference == Reference::simplex ? "Tetrahedron" : "Hexahedron";
  return family + (" " + std::to_string(row.nodes));
}

std::map<int, GmshElement> all_elements() {
  // Those that Solidus does not have, for messages.
  std::map<int, GmshElement> elements = {{10, {"Quadrilateral 9", 2, 9, {}}},
                                         {12, {"Hexahedron 27", 3, 27, {}}},
                                         {13, {"Prism 18", 3, 18, {}}},
                                         {14, {"Pyramid 14", 3, 14, {}}},
                                         {18, {"Prism 15", 3, 15, {}}},
                                         {19, {"Pyramid 13", 3, 13, {}}},
                                         {20, {"Triangle 9", 2, 9, {}}},
                                         {21, {"Triangle 10", 2, 10, {}}},
                                         {22, {"Triangle 12", 2, 12, {}}},
                                         {23, {"Triangle 15", 2, 15, {}}},
                                         {26, {"Line 4", 1, 4, {}}},
                                         {27, {"Line 5", 1, 5, {}}},
                                         {28, {"Line 6", 1, 6, {}}},
                                         {29, {"Tetrahedron 20", 3, 20, {}}},
                                         {30, {"Tetrahedron 35", 3, 35, {}}},
                                         {31, {"Tetrahedron 56", 3, 56, {}}},
                                         {36, {"Quadrilateral 16", 2, 16, {}}},
                                         {92, {"Hexahedron 64", 3, 64, {}}}};
  // The others are those of our own table of shapes.
  for (const ShapeRow& row : k_shape_rows)
    elements[row.gmsh] = {gmsh_name(row), row.dimension, row.nodes, row.shape};
  return elements;
}

}  // namespace

const GmshElement* gmsh_element(int type) {
  static const std::map<int, GmshElement> elements = all_elements();
  const auto found = elements.find(type);
  return found == elements.end() ? nullptr : &found->second;
}

}  // namespace solidus::mesh
