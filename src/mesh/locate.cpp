/// The process that finds a point in one of its elements answers for all; averages over groups are
/// integrals over their faces or elements.
#include "mesh/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/block_geometry.hpp"
#include "mesh/block_part.hpp"
#include "mesh/nearest_place.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

namespace {

double global_sum(double value) {
  processes::sum(std::span(&value, 1));
  return value;
}
bool on_any_process(bool value) {
  int n = value ? 1 : 0;
  processes::largest(std::span(&n, 1));
  return n > 0;
}

struct Candidate {
  double distance = std::numeric_limits<double>::infinity();
  double body = 0, number = 0, process = 0;  // that decide when several are equally near
  auto key() const { return std::array{distance, body, number, process}; }
};

}  // namespace

double NodalFunctional::share(std::span<const double> field, int n_components, int component) const {
  double sum = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    sum += weights[k] * field[as_size(nodes[k]) * as_size(n_components) + as_size(component)];
  return sum;
}

LocatedPoint locate(const Mesh& mesh, const Point& point, int body) {
  // Each process looks among its own elements, then the nearest of all decides.
  const int rank = processes::rank();
  LocatedPoint located;
  NearestPlace nearest;
  Candidate best;
  best.process = rank;
  // The nearest element of this process; boxes farther away than what is found are passed over.
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    if (body >= 0 && block.body != body) continue;
    // Only elements that this process counts, so that each element answers once over all processes.
    for (Index e = 0; e < block.n_counted; ++e) {
      if (distance_to_box(element_box(mesh, block, e), point) > best.distance) continue;
      NearestPlace here = nearest_place(mesh, block.shape, block.element(e), point);
      const Candidate candidate{here.distance, static_cast<double>(block.body),
                                static_cast<double>(block.input_element[as_size(e)]),
                                static_cast<double>(rank)};
      if (!(candidate.key() < best.key())) continue;
      best = candidate;
      nearest = std::move(here);
      located.block = as_index(b);
      located.element = e;
    }
  }

  // Of all processes the nearest; at equal distances the least body, element and process decide.
  const std::array own = best.key();
  const std::vector<double> all = processes::gather(own);
  for (std::size_t i = 0; i < all.size(); i += own.size()) {
    const Candidate candidate{all[i], all[i + 1], all[i + 2], all[i + 3]};
    if (candidate.key() < best.key()) best = candidate;
  }
  // One process alone has the element; the others know the distance.
  located.distance = best.distance;
  located.here = static_cast<int>(best.process) == rank && located.element >= 0;
  if (!located.here) {
    located.block = located.element = -1;
    return located;
  }

  // From the face's coordinates to the element's: reference faces are flat.
  const ElementBlock& block = mesh.blocks[as_size(located.block)];
  std::vector<double> values(nearest.local.size());
  basis_values(nearest.shape, nearest.xi, values);
  const Rule reference_nodes = nodal_rule(block.shape);
  for (std::size_t a = 0; a < values.size(); ++a)
    for (std::size_t i = 0; i < 3; ++i)
      located.xi[i] += values[a] * reference_nodes[as_size(nearest.local[a])].xi[i];
  // The nodes of the face (or element) that holds the point, with their shape functions as weights.
  for (std::size_t a = 0; a < values.size(); ++a) {
    located.nodes.push_back(block.element(located.element)[nearest.local[a]]);
    located.weights.push_back(values[a]);
  }
  return located;
}

namespace {

enum class GroupKind { none, surface, body, nodes };

// A surface or body may have no part on a process, so all ask together.
GroupKind kind_of(const Mesh& mesh, const std::string& group) {
  if (std::any_of(mesh.bodies.begin(), mesh.bodies.end(), [&](const Body& b) { return b.name == group; }))
    return GroupKind::body;
  if (on_any_process(mesh.surfaces.contains(group))) return GroupKind::surface;
  if (on_any_process(mesh.node_sets.contains(group))) return GroupKind::nodes;
  return GroupKind::none;
}

// ∫ N_a over the elements that this process counts, summed into the nodes; zero-weight terms left out.
NodalFunctional integral(const Mesh& mesh, const std::string& group, GroupKind group_kind,
                         AnalysisKind kind) {
  // By the kind of group: volumes of elements, areas of faces, or one for each node.
  std::vector<double> weight(as_size(mesh.n_nodes()), 0.0);
  if (group_kind == GroupKind::body) {
    for (const ElementBlock& block : mesh.blocks) {
      if (mesh.bodies[as_size(block.body)].name != group) continue;
      for_parts(block, [&](const ElementBlock& part, Index) {
        const PackVector<Lane> integrals = basis_integrals(mesh, part, kind);
        const int nn = node_count(part.shape);
        for (Index e = 0; e < part.n_counted; ++e)
          for (int a = 0; a < nn; ++a)
            weight[as_size(part.element(e)[a])] +=
                integrals[as_size(e / k_lanes) * as_size(nn) + as_size(a)][e % k_lanes];
      });
    }
  } else if (group_kind == GroupKind::surface && mesh.surfaces.contains(group)) {
    for (const ElementBlock& faces : mesh.surfaces.at(group).faces) {
      const FaceGeometry geometry(mesh, faces, kind, gauss_rule(faces.shape, 5));
      const auto nn = as_size(geometry.n_nodes), np = as_size(geometry.n_points);
      for (Index f = 0; f < faces.n_counted; ++f)
        for (std::size_t p = 0; p < np; ++p)
          for (std::size_t a = 0; a < nn; ++a)
            weight[as_size(faces.element(f)[a])] +=
                geometry.weight[as_size(f) * np + p] * geometry.values[p * nn + a];
    }
  } else if (group_kind == GroupKind::nodes && mesh.node_sets.contains(group)) {
    for (const Index i : mesh.node_sets.at(group))
      if (i < mesh.n_owned_nodes) weight[as_size(i)] = 1;
  }
  // Only nodes with a weight are kept.
  NodalFunctional functional;
  const auto n = as_size(std::count_if(weight.begin(), weight.end(), [](double w) { return w != 0; }));
  functional.nodes.reserve(n);
  functional.weights.reserve(n);
  for (std::size_t i = 0; i < weight.size(); ++i)
    if (weight[i] != 0) {
      functional.nodes.push_back(as_index(i));
      functional.weights.push_back(weight[i]);
    }
  return functional;
}

double total(const NodalFunctional& functional) {
  double sum = 0;
  for (const double w : functional.weights) sum += w;
  return global_sum(sum);
}

GroupKind require_group(const Mesh& mesh, const std::string& group) {
  const GroupKind kind = kind_of(mesh, group);
  if (kind != GroupKind::none) return kind;
  std::string names;
  for (const auto& [name, nodes] : mesh.node_sets) names += (names.empty() ? "" : ", ") + name;
  throw InputError({}, "the mesh has no group '" + group + "'", "groups of the mesh: " + names);
}

}  // namespace

NodalFunctional group_mean(const Mesh& mesh, const std::string& group, AnalysisKind kind) {
  const GroupKind group_kind = require_group(mesh, group);
  NodalFunctional mean = integral(mesh, group, group_kind, kind);
  double sum = total(mean);
  if (!(sum > 0)) {  // the axis of revolution has no area: there, nodes count alike
    mean = integral(mesh, group, GroupKind::nodes, kind);
    sum = total(mean);
  }
  for (double& w : mean.weights) w /= sum;
  return mean;
}

double group_measure(const Mesh& mesh, const std::string& group, AnalysisKind kind) {
  const GroupKind group_kind = require_group(mesh, group);
  return group_kind == GroupKind::nodes ? 0.0 : total(integral(mesh, group, group_kind, kind));
}

}  // namespace solidus::mesh
