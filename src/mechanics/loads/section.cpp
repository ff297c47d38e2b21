/// The skin of a body is the set of faces that one element alone has; planes of symmetry are taken off, and
/// volume and area are summed in an order that does not depend on the processes.
#include "mechanics/loads/section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "mesh/block_geometry.hpp"
#include "mesh/quadrature.hpp"
#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::mechanics {

namespace {

/// Marks the components in which a node cannot move freely off a plane: bit i for component i, [local node].
std::vector<unsigned> held_components(const mesh::Mesh& mesh, const MechanicalConditions& conditions) {
  std::vector<unsigned> held(mesh.x.size(), 0);
  const auto mark = [&](const std::string& node_set, unsigned bits) {
    const auto set = mesh.node_sets.find(node_set);
    if (set == mesh.node_sets.end()) return;
    for (const Index node : set->second) held[as_size(node)] |= bits;
  };
  for (const PrescribedDisplacement& d : conditions.displacements) mark(d.node_set, 1U << d.component);
  for (const PlaneFace& face : conditions.plane_faces) mark(face.node_set, 7U);
  return held;
}

/// A face of an element.
struct Face {
  mesh::FaceKey key;
  std::size_t block;
  Index element;
  int number;  ///< of the element's faces
};

/// Whether this process counts a face: it owns the node of the least global number, so it has every element
/// there and sees whether two of them share it.
bool counts(const mesh::Mesh& mesh, const mesh::FaceKey& key) {
  Index first = -1;
  for (const Index node : key.vertices)
    if (node >= 0 && (first < 0 || mesh.global_node[as_size(node)] < mesh.global_node[as_size(first)]))
      first = node;
  return first < mesh.n_owned_nodes;
}

/// The faces of a body that one of its elements alone has, of those that this process counts.
std::vector<Face> skin_faces(const mesh::Mesh& mesh, int body) {
  std::vector<Face> faces;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    if (block.body != body) continue;
    const auto vertices = as_size(mesh::vertex_count(mesh::face_shape(block.shape)));
    // Every face of every element of the body, with a key of its sorted vertices.
    for (Index e = 0; e < block.size(); ++e)
      for (int f = 0; f < mesh::face_count(block.shape); ++f) {
        std::array<Index, 4> nodes{};
        const auto local = mesh::face_nodes(block.shape, f);
        for (std::size_t v = 0; v < vertices; ++v) nodes[v] = block.element(e)[local[v]];
        const mesh::FaceKey key = mesh::face_key(nodes.data(), static_cast<int>(vertices));
        if (counts(mesh, key)) faces.push_back({key, b, e, f});
      }
  }
  // Faces with one key lie next to each other then: a face inside is there twice, one of the skin
  // once.
  std::ranges::sort(faces, {}, [](const Face& face) { return face.key.vertices; });
  std::vector<Face> skin;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool as_before = i > 0 && faces[i].key == faces[i - 1].key,
               as_next = i + 1 < faces.size() && faces[i].key == faces[i + 1].key;
    if (!as_before && !as_next) skin.push_back(faces[i]);
  }
  return skin;
}

/// Whether the displacement along the normal of a face is held at all of its corners.
bool is_held(const mesh::FaceKey& key, const mesh::Point& normal, const std::vector<unsigned>& held) {
  constexpr double k_along = 0.999;
  for (unsigned i = 0; i < 3; ++i)
    if (std::abs(normal[i]) > k_along)
      return std::ranges::all_of(
          key.vertices, [&](Index node) { return node < 0 || (held[as_size(node)] & (1U << i)) != 0; });
  return false;
}

/// The areas of the faces of a body's skin that this process counts, without those that are held along their
/// normal [m²].
std::vector<double> cooling_areas(const mesh::Mesh& mesh, AnalysisKind kind, int body,
                                  const std::vector<unsigned>& held) {
  std::vector<double> areas;
  for (const Face& face : skin_faces(mesh, body)) {
    const mesh::ElementBlock& block = mesh.blocks[face.block];
    mesh::ElementBlock one;
    one.shape = mesh::face_shape(block.shape);
    one.n_counted = 1;
    for (const int n : mesh::face_nodes(block.shape, face.number))
      one.nodes.push_back(block.element(face.element)[n]);
    const mesh::FaceGeometry geometry(mesh, one, kind, mesh::stiffness_rule(one.shape));
    if (is_held(face.key, geometry.normal.front(), held)) continue;
    areas.push_back(std::accumulate(geometry.weight.begin(), geometry.weight.end(), 0.0));
  }
  return areas;
}

/// The volumes of the elements of a body that this process counts [m³].
std::vector<double> volumes(const mesh::Mesh& mesh, AnalysisKind kind, int body) {
  std::vector<double> result;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body != body) continue;
    const mesh::BlockGeometry geometry(mesh, block, kind, mesh::stiffness_rule(block.shape));
    for (Index batch = 0; batch < geometry.n_batches; ++batch) {
      Lane volume(0.0);
      // Elements that another process counts weigh nothing here.
      for (int q = 0; q < geometry.n_points; ++q) volume += geometry.weight_at(batch, q);
      volume *= geometry.counted[as_size(batch)];
      for (int lane = 0; lane < k_lanes; ++lane) result.push_back(volume[lane]);
    }
  }
  return result;
}

/// The sum over all processes, the same bits however the parts are spread over them: whole numbers of a
/// 2^30th of the largest part. What hangs on it is kept in checkpoints, which other numbers of processes
/// read.
double sum_in_any_order(const std::vector<double>& parts) {
  const double largest =
      parallel::global_max(parts.empty() ? 0.0 : *std::max_element(parts.begin(), parts.end()));
  if (!(largest > 0)) return 0;
  const double unit = std::ldexp(largest, -30);
  std::int64_t units[1] = {0};
  for (const double part : parts) units[0] += std::llround(part / unit);
  processes::sum(std::span<std::int64_t>(units));
  return static_cast<double>(units[0]) * unit;
}

}  // namespace

std::vector<double> sections(const mesh::Mesh& mesh, AnalysisKind kind,
                             const MechanicalConditions& conditions, const linear::ActiveSet& active) {
  const std::vector<unsigned> held = held_components(mesh, conditions);
  std::vector<double> result(mesh.bodies.size(), 0.0);
  // Volume over cooling area, of bodies that are there and are cooled somewhere.
  for (std::size_t b = 0; b < result.size(); ++b) {
    const auto body = static_cast<int>(b);
    if (!active.body(body)) continue;
    const double volume = sum_in_any_order(volumes(mesh, kind, body)),
                 area = sum_in_any_order(cooling_areas(mesh, kind, body, held));
    if (area > 0) result[b] = volume / area;
  }
  return result;
}

}  // namespace solidus::mechanics
