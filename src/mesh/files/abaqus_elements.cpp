// Abaqus Analysis User's Guide, "Element Library": node ordering and face numbering.
#include "mesh/files/abaqus_elements.hpp"

#include <array>
#include <cctype>

#include "mesh/shape_table.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

struct Family {
  std::string_view prefix;
  int dimension;
};
// The number of nodes is behind the prefix. Longer prefixes first where one begins another.
constexpr std::array<Family, 23> k_families{
    {{"DC3D", 3}, {"AC3D", 3}, {"F3D", 3},  {"C3D", 3},  {"CPEG", 2},  {"CPE", 2}, {"CPS", 2}, {"CAX", 2},
     {"DC2D", 2}, {"DCAX", 2}, {"AC2D", 2}, {"ACAX", 2}, {"SFM3D", 2}, {"M3D", 2}, {"R3D", 2}, {"STRI", 2},
     {"DS", 2},   {"S", 2},    {"T2D", 1},  {"T3D", 1},  {"DC1D", 1},  {"R2D", 1}, {"B", 1}}};

std::optional<Shape> shape_with(int dimension, int nodes) {
  for (const ShapeRow& row : k_shape_rows)
    if (row.dimension == dimension && row.nodes == nodes && dimension > 0) return row.shape;
  return std::nullopt;
}

}  // namespace

std::optional<Shape> shape_of_abaqus_type(std::string_view type) {
  for (const Family& family : k_families) {
    if (!type.starts_with(family.prefix)) continue;
    // The number behind the prefix of the family is that of the nodes, but for beams, whose second digit is
    // their order.
    std::string_view rest = type.substr(family.prefix.size());
    int digits = 0, number = 0;
    while (as_size(digits) < rest.size() &&
           std::isdigit(static_cast<unsigned char>(rest[as_size(digits)])) != 0)
      number = 10 * number + (rest[as_size(digits++)] - '0');
    if (digits == 0) continue;
    if (family.prefix == "B") {  // B31: in space, linear; B32: quadratic
      if (digits != 2 || number % 10 > 2) return std::nullopt;
      return shape_with(1, number % 10 + 1);
    }
    if (family.prefix == "STRI" && number == 65) number = 6;
    return shape_with(family.dimension, number);
  }
  return std::nullopt;
}

std::span<const int> abaqus_node_order(Shape shape) {
  return row_of(shape).abaqus_nodes;
}

int n_abaqus_faces(Shape shape) {
  constexpr int k_of_wedges_and_pyramids = 5;
  return shape == Shape::wedge6 || shape == Shape::pyramid5 ? k_of_wedges_and_pyramids : face_count(shape);
}

std::optional<int> face_of_abaqus_label(Shape shape, int label) {
  if (label < 1 || label > n_abaqus_faces(shape)) return std::nullopt;
  const Places faces = row_of(shape).abaqus_faces;
  return faces.empty() ? label - 1 : faces[as_size(label - 1)];
}

}  // namespace solidus::mesh
