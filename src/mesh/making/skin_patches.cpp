/// Smooth parts of skins with their measures, as a table and as a file (mesh/surfaces/face_rules.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/surfaces/face_rules.hpp"
#include "mesh/surfaces/skin.hpp"
#include "mesh/surfaces/smooth_parts.hpp"

namespace solidus::mesh {

std::vector<SkinPatch> skin_patches(const RawMesh& mesh, const std::vector<std::string>& bodies,
                                    double angle) {
  // The skin of each body falls into smooth patches, bounded by edges sharper than the angle or by faces of
  // the drawing.
  std::vector<SkinPatch> all;
  for (const std::string& body : bodies) {
    const std::vector<SkinFace> skin = skin_of(mesh, body);
    std::vector<const SkinFace*> faces;
    for (const SkinFace& face : skin) faces.push_back(&face);
    const SmoothParts parts = smooth_parts(faces, angle, mesh.drawn_faces);
    std::map<std::size_t, SkinPatch> patches;  // by the number of the part
    // Area, centre, normal and extent of a patch are sums over its faces; faces with more corners are divided
    // into triangles.
    for (std::size_t f = 0; f < faces.size(); ++f) {
      SkinPatch& p = patches[parts.of_face[f]];
      const SkinFace& face = *faces[f];
      if (p.faces++ == 0) p.body = body, p.low = p.high = face.centre;
      p.area += face.area;
      for (std::size_t i = 0; i < 3; ++i) {
        p.centre[i] += face.area * face.centre[i];
        p.normal[i] += face.area * face.normal[i];
        for (const Point& x : face.corners)
          p.low[i] = std::min(p.low[i], x[i]), p.high[i] = std::max(p.high[i], x[i]);
      }
      for (std::size_t i = 2; i < face.corners.size(); ++i)
        p.triangles.push_back({face.corners[0], face.corners[i - 1], face.corners[i]});
    }
    // Patches are listed by area, the largest first, and neighbours get the numbers of that order.
    std::vector<std::size_t> order;
    for (auto& [number, p] : patches) {
      for (std::size_t i = 0; i < 3; ++i) p.centre[i] /= p.area, p.normal[i] /= p.area;
      order.push_back(number);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return patches.at(a).area > patches.at(b).area; });
    std::map<std::size_t, std::size_t> place;
    for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = all.size() + k;
    for (const auto& [a, b] : parts.meet) patches.at(a).neighbours.push_back(place.at(b));
    for (const std::size_t number : order) all.push_back(patches.at(number));
  }
  return all;
}

std::string to_text(const std::vector<SkinPatch>& patches) {
  std::string text = fmt::format("\n{:>4}  {:<20} {:>7} {:>11}  {:<27} {:<21} {:<24} {}\n", "face", "owner",
                                 "faces", "area [mm2]", "centre [mm]", "normal", "size [mm]", "neighbours");
  // A line for each patch; a patch is plane when its normals hardly differ.
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const SkinPatch& p = patches[k];
    std::string neighbours;
    constexpr std::size_t k_most = 12;
    for (std::size_t i = 0; i < std::min(k_most, p.neighbours.size()); ++i)
      neighbours += fmt::format("{}{}", i > 0 ? ", " : "", p.neighbours[i] + 1);
    if (p.neighbours.size() > k_most) neighbours += ", …";
    const bool plane = std::hypot(p.normal[0], p.normal[1], p.normal[2]) > 0.9995;
    const auto mm = [](double x) { return std::abs(x) < 1e-9 ? 0.0 : 1e3 * x; };
    text += fmt::format(
        "{:>4}  {:<20} {:>7} {:>11.5g}  {:<27} {:<21} {:<24} {}\n", k + 1, p.body, p.faces, 1e6 * p.area,
        fmt::format("({:.4g}, {:.4g}, {:.4g})", mm(p.centre[0]), mm(p.centre[1]), mm(p.centre[2])),
        plane
            ? fmt::format("({:.2f}, {:.2f}, {:.2f})", p.normal[0] + 0.0, p.normal[1] + 0.0, p.normal[2] + 0.0)
            : std::string("curved"),
        fmt::format("{:.4g} x {:.4g} x {:.4g}", mm(p.high[0] - p.low[0]), mm(p.high[1] - p.low[1]),
                    mm(p.high[2] - p.low[2])),
        neighbours);
  }
  return text;
}

std::string to_vtk(const std::vector<SkinPatch>& patches) {
  // Triangles of all patches with the number of their patch and body.
  std::string points, numbers, bodies;
  std::size_t n = 0;
  int body = -1;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (k == 0 || patches[k].body != patches[k - 1].body) ++body;
    for (const std::array<Point, 3>& triangle : patches[k].triangles) {
      for (const Point& p : triangle) points += fmt::format("{:.9g} {:.9g} {:.9g}\n", p[0], p[1], p[2]);
      numbers += fmt::format("{}\n", k + 1);
      bodies += fmt::format("{}\n", body);
      ++n;
    }
  }
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\nfaces of a mesh by number [m]\nASCII\nDATASET POLYDATA\nPOINTS {} "
      "double\n{}",
      3 * n, points);
  text += fmt::format("POLYGONS {} {}\n", n, 4 * n);
  for (std::size_t t = 0; t < n; ++t) text += fmt::format("3 {} {} {}\n", 3 * t, 3 * t + 1, 3 * t + 2);
  return text + fmt::format(
                    "CELL_DATA {}\nSCALARS face int 1\nLOOKUP_TABLE default\n{}SCALARS body int 1\n"
                    "LOOKUP_TABLE default\n{}",
                    n, numbers, bodies);
}

}  // namespace solidus::mesh
