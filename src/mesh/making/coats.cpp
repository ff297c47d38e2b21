#include "mesh/making/coats.hpp"

#include "mesh/making/level_cut.hpp"
#include "mesh/making/poor_tetrahedra.hpp"
#include "mesh/making/smoothing.hpp"
#include "mesh/making/unused_parts.hpp"
#include "mesh/surfaces/faces.hpp"
#include "mesh/surfaces/skin.hpp"
#include "mesh/tetrahedra.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

std::vector<std::string> other_bodies(const RawMesh& mesh, const std::string& block) {
  std::vector<std::string> bodies;
  for (const auto& [name, group] : mesh.groups)
    if (group.dimension == mesh.dimension && name != block) bodies.push_back(name);
  return bodies;
}

/// The faces of the block that another body has as well.
std::vector<SkinFace> coated_skin(const RawMesh& mesh, const std::string& block) {
  const auto key = [](const SkinFace& face) { return face_key(face.nodes.data(), vertex_count(face.shape)); };
  std::vector<SkinFace> skin = skin_of(mesh, block);
  FaceOwners owners;
  // Faces are told apart by their vertices; the owners are found in one pass over all other bodies.
  for (const SkinFace& face : skin) owners.emplace(key(face), FaceOwner{});
  find_face_owners(mesh, other_bodies(mesh, block), owners);
  std::erase_if(skin, [&](const SkinFace& face) { return owners.at(key(face)).body < 0; });
  return skin;
}

CoatReport report_on(const RawMesh& mesh, const std::string& coat) {
  CoatReport report{coat};
  for (const RawBlock& block : mesh.groups.at(coat).blocks) {
    const auto n = as_size(node_count(block.shape));
    for (std::size_t e = 0; e < block.nodes.size(); e += n, ++report.elements) {
      const auto x = [&](std::size_t a) { return mesh.x[as_size(block.nodes[e + a])]; };
      // The volume is that of straight-edged tetrahedra, which is enough for a report.
      report.volume += std::abs(volume_6(x(0), x(1), x(2), x(3))) / 6;
    }
  }
  return report;
}

}  // namespace

std::vector<CoatReport> make_coats(RawMesh& mesh, const std::string& block, const std::vector<Coat>& coats,
                                   bool bed, const std::string& source) {
  // Names are compared with those of the geometry first: a coat of such a name would be added to a body that
  // is there.
  double whole = 0;
  for (const Coat& coat : coats) {
    whole += coat.thickness;
    if (mesh.groups.contains(coat.name))
      throw InputError({source}, "the coat '" + coat.name + "' has the name of a group of the geometry",
                       "another name in [[mesh.coat]]");
  }
  // The skin is taken once, from the whole block: each coat is measured from the metal and not from the coat
  // below it.
  const std::vector<SkinFace> skin = coated_skin(mesh, block);
  if (skin.empty())
    throw InputError({source}, "there is nothing to be coated: no body shares faces with '" + block + "'");
  // Farther away than the whole shell the distance is not needed, only that it is larger.
  constexpr double k_beyond = 1.1;
  const double reach = k_beyond * whole;
  const SkinSearch search(skin, reach);
  // Each cut takes the innermost part off the block, which becomes the next coat; the rest is the bed.
  double depth = 0;
  for (const Coat& coat : coats) {
    depth += coat.thickness;
    const LevelFunction level = [&](const Point& x) {
      const auto found = search.nearest(x);
      return (found ? found->distance : reach) - depth;
    };
    cut_at_level(mesh, block, coat.name, level, source);
  }
  if (!bed) leave_out(mesh, block);
  // Some elements are flat where the surface cut off little; nodes that are free to move mend most of them.
  smooth_poor_tetrahedra(mesh);
  // A repair changes the connections of elements, and is kept for those that stay poor when their nodes have
  // moved.
  constexpr double k_poor = 0.1;
  repair_poor_tetrahedra(mesh, k_poor);
  std::vector<CoatReport> reports;
  for (const Coat& coat : coats) reports.push_back(report_on(mesh, coat.name));
  return reports;
}

}  // namespace solidus::mesh
