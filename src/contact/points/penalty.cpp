/// The stiffness next to a surface is a modulus over the height of the elements behind its faces, averaged
/// over the area.
#include "contact/points/penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

// Sorted input numbers of the vertices name a face whatever its orientation.
std::vector<GlobalIndex> face_key(const mesh::Mesh& mesh, std::span<const Index> vertices) {
  std::vector<GlobalIndex> key;
  for (Index n : vertices) key.push_back(mesh.input_node[as_size(n)]);
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace

double local_stiffness(const mesh::Mesh& mesh, const ContactSurface& surface,
                       std::span<const double> modulus) {
  // Which face of the surface each set of corners is.
  std::map<std::vector<GlobalIndex>, Index> face_of;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    const auto vertices = as_size(mesh::vertex_count(surface.shape(f)));
    face_of[face_key(mesh, surface.nodes(f).first(vertices))] = f;
  }
  // A face belongs to the process that owns its first node: it holds the element behind.
  double sum = 0, area = 0;
  std::vector<Index> vertices;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body < 0) continue;
    for (Index e = 0; e < block.size(); ++e) {
      const Index* nodes = block.element(e);
      for (int k = 0; k < mesh::face_count(block.shape); ++k) {
        const auto local = mesh::face_nodes(block.shape, k);
        const auto n = as_size(mesh::vertex_count(mesh::face_shape(block.shape)));
        vertices.clear();
        for (std::size_t i = 0; i < n; ++i) vertices.push_back(nodes[local[i]]);
        // The element behind a face: its modulus over its height along the normal is the stiffness per area,
        // whose mean by area is asked for.
        const auto found = face_of.find(face_key(mesh, vertices));
        if (found == face_of.end() || surface.nodes(found->second)[0] >= mesh.n_owned_nodes) continue;
        const Face face = surface.reference_face(found->second);
        const Point centre = reference_centre(face.shape), normal = face.normal(centre), x = face.at(centre);
        double height = 0;
        for (int a = 0; a < mesh::node_count(block.shape); ++a)
          height = std::max(height, dot(subtract(x, mesh.x[as_size(nodes[a])]), normal));
        if (height <= 0) continue;
        const double measure = face.measure();
        sum += measure * modulus[as_size(block.body)] / height;
        area += measure;
      }
    }
  }
  sum = parallel::global_sum(sum);
  area = parallel::global_sum(area);
  return area > 0 ? sum / area : 0;
}

double stiffness_of(const mesh::Mesh& mesh, const PairSurfaces& surfaces, std::span<const double> modulus) {
  if (modulus.size() != mesh.bodies.size()) return 0;
  return std::max(local_stiffness(mesh, surfaces.slave, modulus),
                  surfaces.master ? local_stiffness(mesh, *surfaces.master, modulus) : 0.0);
}

double penalty_of(const mesh::Mesh& mesh, const ContactParameters& spec, const PairSurfaces& surfaces,
                  std::span<const double> modulus) {
  if (!(spec.penalty > 0))
    throw InputError(spec.where, fmt::format("contact '{}': the penalty is not positive", spec.name));
  if (!spec.penalty_is_factor) return spec.penalty;
  const double stiffness = stiffness_of(mesh, surfaces, modulus);
  if (!(stiffness > 0))
    throw InputError(
        spec.where,
        fmt::format("contact '{}': a penalty factor needs the stiffness of the bodies", spec.name),
        "a penalty in Pa/m");
  return std::min(spec.penalty * stiffness, spec.largest_penalty);
}

}  // namespace solidus::contact
