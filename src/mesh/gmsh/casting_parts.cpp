/// Small questions to the open geometry: boxes, volumes, boundaries, and which faces Gmsh complained of.
#include "mesh/gmsh/casting_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

namespace solidus::mesh {

namespace occ = gmsh::model::occ;

double Extent::diagonal() const {
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

Extent extent_of(const gmsh::vectorpair& entities) {
  constexpr double k_huge = 1e300;
  Extent all{{k_huge, k_huge, k_huge}, {-k_huge, -k_huge, -k_huge}};
  for (const auto& [dimension, tag] : entities) {
    Point low{}, high{};
    occ::getBoundingBox(dimension, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      all.low[i] = std::min(all.low[i], low[i]);
      all.high[i] = std::max(all.high[i], high[i]);
    }
  }
  return all;
}

gmsh::vectorpair all_volumes() {
  gmsh::vectorpair all;
  occ::getEntities(all, 3);
  return all;
}

std::vector<int> boundary_of(int volume) {
  gmsh::vectorpair faces;
  gmsh::model::getBoundary({{3, volume}}, faces, false, false, false);
  std::vector<int> tags;
  for (const auto& face : faces) tags.push_back(std::abs(face.second));
  return tags;
}

void generate_mesh(int dimension) {
  constexpr double k_warnings = 2, k_stop_meshing = 1, k_throw = 2;
  gmsh::option::setNumber("General.Verbosity", k_warnings);  // for the log that place_of_complaints() reads
  gmsh::option::setNumber("General.AbortOnError", k_stop_meshing);
  gmsh::model::mesh::generate(dimension);
  gmsh::option::setNumber("General.AbortOnError", k_throw);
  std::string error;  // Gmsh forgets earlier ones when it begins
  gmsh::logger::getLastError(error);
  if (!error.empty()) throw error;
}

std::set<int> surfaces_at_fault() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::set<int> faces;
  for (const std::string& line : log) {
    if (!line.starts_with("Error") && !line.starts_with("Warning")) continue;
    for (std::size_t at = line.find("urface "); at != std::string::npos; at = line.find("urface ", at + 1))
      if (const int tag = std::atoi(line.c_str() + at + 7); tag > 0) faces.insert(tag);
  }
  return faces;
}

std::string place_of_complaints(const std::vector<BodyVolumes>& parts) {
  // Gmsh's own last error, without those that were repaired.
  std::vector<std::string> log;
  gmsh::logger::get(log);
  const auto last = std::find_if(log.rbegin(), log.rend(),
                                 [](const std::string& line) { return line.starts_with("Error"); });
  std::string text;
  std::size_t said = 0;
  // The faces that Gmsh complains of, with their bodies and boxes, the first few of them.
  for (const int face : surfaces_at_fault()) {
    constexpr std::size_t k_most = 4;
    if (said == k_most) break;
    // The first body that has the face is named as its owner.
    std::string owner;
    for (const BodyVolumes& part : parts)
      for (const auto& volume : part.volumes) {
        const std::vector<int> boundary = boundary_of(volume.second);
        if (std::find(boundary.begin(), boundary.end(), face) != boundary.end() && owner.empty())
          owner = part.name;
      }
    if (owner.empty()) continue;
    Point low{}, high{};
    gmsh::model::getBoundingBox(2, face, low[0], low[1], low[2], high[0], high[1], high[2]);
    char place[160];
    std::snprintf(place, sizeof place, "%s a face of '%s' around (%.4g, %.4g, %.4g), %.3g long",
                  said++ == 0 ? "; at fault:" : ",", owner.c_str(), (low[0] + high[0]) / 2,
                  (low[1] + high[1]) / 2, (low[2] + high[2]) / 2,
                  std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
    text += place;
  }
  return (last == log.rend() ? "" : " (" + *last + ")") + text;
}

}  // namespace solidus::mesh
