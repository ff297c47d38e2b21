/// Curves of one face alone are open; pieces are counted by the curves that faces share.
#include "mesh/gmsh/open_faces.hpp"

#include <gmsh.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <vector>

namespace solidus::mesh {

namespace {

namespace occ = gmsh::model::occ;

/// Faces by the curves that bound them; a seam, where a face meets itself, has its face twice.
std::map<int, std::vector<std::size_t>> faces_of_curves(const gmsh::vectorpair& faces) {
  std::map<int, std::vector<std::size_t>> of;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    gmsh::vectorpair curves;
    gmsh::model::getBoundary({faces[f]}, curves, false, true, false);
    for (const auto& [dimension, tag] : curves) of[std::abs(tag)].push_back(f);
  }
  return of;
}

/// The number of groups of faces that hang together by their curves.
std::size_t count_pieces(std::size_t n_faces, const std::map<int, std::vector<std::size_t>>& of) {
  std::vector<std::size_t> first(n_faces);
  std::iota(first.begin(), first.end(), 0U);
  const auto root = [&](std::size_t f) {
    while (first[f] != f) f = first[f];
    return f;
  };
  for (const auto& [curve, faces] : of)
    for (const std::size_t face : faces) first[root(face)] = root(faces.front());
  std::size_t n = 0;
  for (std::size_t f = 0; f < n_faces; ++f) n += first[f] == f ? 1U : 0U;
  return n;
}

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace

std::string open_faces_text(double unit) {
  gmsh::vectorpair faces;
  gmsh::model::getEntities(faces, 2);
  const auto of = faces_of_curves(faces);
  std::size_t n_open = 0;
  double longest = 0;
  int where = 0;
  // A curve of one face alone is open; the longest one is told with its place.
  for (const auto& [curve, sides] : of) {
    if (sides.size() != 1) continue;
    double length = 0;
    occ::getMass(1, curve, length);
    if (!(length > 0)) continue;  // the apex of a cone
    ++n_open;
    if (length > longest) longest = length, where = curve;
  }
  const std::string text = counted(faces.size(), "face", "faces") + " in " +
                           counted(count_pieces(faces.size(), of), "piece", "pieces");
  if (n_open == 0) return text + ", which have no open curve, yet the CAD kernel makes no solid of them";
  // The middle of the box of the longest open curve is the place, in millimetres of the file's
  // unit.
  double low[3], high[3];
  gmsh::model::getBoundingBox(1, where, low[0], low[1], low[2], high[0], high[1], high[2]);
  const double mm = 1e3 * unit / 2;
  char place[160];
  std::snprintf(place, sizeof place, " only, the longest of %.3g mm around (%.4g, %.4g, %.4g) mm",
                1e3 * unit * longest, mm * (low[0] + high[0]), mm * (low[1] + high[1]),
                mm * (low[2] + high[2]));
  return text + "; " + counted(n_open, "curve bounds", "curves bound") + " one face" + place;
}

}  // namespace solidus::mesh
