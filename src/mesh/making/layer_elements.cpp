/// Columns over the faces of a wall, cut into elements in the order that neighbours agree on.
#include "mesh/making/layer_elements.hpp"

#include <algorithm>

namespace solidus::mesh {

namespace {

bool repeats(std::vector<Index> vertices) {
  std::sort(vertices.begin(), vertices.end());
  return std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end();
}

/// Sorts columns by their vertices of the wall; true if that took an odd number of exchanges.
bool sort_columns(std::vector<LayerColumn>& columns) {
  bool odd = false;
  for (std::size_t i = 1; i < columns.size(); ++i)
    for (std::size_t j = i; j > 0 && columns[j].wall < columns[j - 1].wall; --j) {
      std::swap(columns[j], columns[j - 1]);
      odd = !odd;
    }
  return odd;
}

/// The simplices of a prism: its columns go up one after the other.
std::vector<std::vector<Index>> stairs(std::vector<LayerColumn> columns) {
  const bool odd = sort_columns(columns);
  std::vector<std::vector<Index>> simplices;
  for (std::size_t step = 0; step < columns.size(); ++step) {
    std::vector<Index> s;
    for (std::size_t c = 0; c < columns.size(); ++c)
      s.push_back(c < step ? columns[c].upper : columns[c].lower);
    s.push_back(columns[step].upper);
    if (repeats(s)) continue;
    if (odd) std::swap(s[0], s[1]);
    simplices.push_back(std::move(s));
  }
  return simplices;
}

}  // namespace

bool is_simplex(Shape shape) {
  return vertex_count(shape) == dimension(shape) + 1;
}

std::vector<std::vector<Index>> layer_elements(Shape body, const std::vector<LayerColumn>& face) {
  // Seen from the layer, an outward face of the body is clockwise; an edge is counter-clockwise.
  std::vector<LayerColumn> columns = face;
  if (dimension(body) == 3) std::reverse(columns.begin(), columns.end());
  if (is_simplex(body)) return stairs(std::move(columns));
  std::vector<Index> element;
  for (const LayerColumn& c : columns) element.push_back(c.lower);
  if (dimension(body) == 2) std::reverse(columns.begin(), columns.end());
  for (const LayerColumn& c : columns) element.push_back(c.upper);
  return {element};
}

std::vector<std::vector<Index>> rim_faces(Shape body, const std::vector<LayerColumn>& rim) {
  if (rim.size() == 1) {
    if (rim[0].lower == rim[0].upper) return {};
    return {{rim[0].lower, rim[0].upper}};
  }
  if (is_simplex(body)) return stairs(rim);
  return {{rim[0].lower, rim[1].lower, rim[1].upper, rim[0].upper}};
}

}  // namespace solidus::mesh
