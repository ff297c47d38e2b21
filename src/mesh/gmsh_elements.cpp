#include "mesh/gmsh_elements.hpp"

#include <map>

namespace solidus::mesh {

const GmshElement* gmsh_element(int type) {
  static const std::map<int, GmshElement> elements = {{1, {"Line 2", 1, 2, Shape::line2}},
                                                      {2, {"Triangle 3", 2, 3, Shape::tri3}},
                                                      {3, {"Quadrilateral 4", 2, 4, Shape::quad4}},
                                                      {4, {"Tetrahedron 4", 3, 4, Shape::tet4}},
                                                      {5, {"Hexahedron 8", 3, 8, Shape::hex8}},
                                                      {6, {"Prism 6", 3, 6, {}}},
                                                      {7, {"Pyramid 5", 3, 5, {}}},
                                                      {8, {"Line 3", 1, 3, Shape::line3}},
                                                      {9, {"Triangle 6", 2, 6, Shape::tri6}},
                                                      {10, {"Quadrilateral 9", 2, 9, {}}},
                                                      {11, {"Tetrahedron 10", 3, 10, Shape::tet10}},
                                                      {12, {"Hexahedron 27", 3, 27, {}}},
                                                      {13, {"Prism 18", 3, 18, {}}},
                                                      {14, {"Pyramid 14", 3, 14, {}}},
                                                      {15, {"Point", 0, 1, Shape::point1}},
                                                      {16, {"Quadrilateral 8", 2, 8, Shape::quad8}},
                                                      {17, {"Hexahedron 20", 3, 20, Shape::hex20}},
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
  const auto found = elements.find(type);
  return found == elements.end() ? nullptr : &found->second;
}

}  // namespace solidus::mesh
