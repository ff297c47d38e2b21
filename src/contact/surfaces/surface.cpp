/// Faces are held in an order that the numbers in the mesh file define, so that every process and every
/// partition has the same surface.
#include "contact/surfaces/surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::contact {

ContactSurface::ContactSurface(const mesh::Mesh& mesh, const std::string& name) : mesh_(mesh), name_(name) {
  const auto found = mesh.surfaces.find(name);
  if (found == mesh.surfaces.end())
    throw InputError({}, "the mesh has no surface '" + name + "' for contact");
  // All faces of the surface are collected and sorted by the numbers of their nodes in the input, so that the
  // order does not depend on the partition: every process sees the same surface.
  const mesh::Surface& surface = found->second;

  struct Entry {
    mesh::Shape shape;
    const Index* nodes;
  };
  std::vector<Entry> entries;
  for (const mesh::ElementBlock& block : surface.faces)
    for (Index f = 0; f < block.size(); ++f) entries.push_back({block.shape, block.element(f)});
  if (entries.empty()) throw InputError({}, "surface '" + name + "' has no faces for contact");
  // The key is the list of a face's nodes by their numbers in the file, which no partition changes.
  const auto key = [&](const Entry& e, std::vector<GlobalIndex>& k) {
    k.clear();
    for (int a = 0; a < mesh::node_count(e.shape); ++a) k.push_back(mesh.input_node[as_size(e.nodes[a])]);
  };
  std::vector<GlobalIndex> left, right;
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    key(a, left);
    key(b, right);
    return left < right;
  });

  // Nodes follow face by face, and once all of them sorted without doubles.
  first_node_.push_back(0);
  for (const Entry& e : entries) {
    shape_.push_back(e.shape);
    nodes_.insert(nodes_.end(), e.nodes, e.nodes + mesh::node_count(e.shape));
    first_node_.push_back(nodes_.size());
  }
  all_nodes_ = nodes_;
  std::sort(all_nodes_.begin(), all_nodes_.end());
  all_nodes_.erase(std::unique(all_nodes_.begin(), all_nodes_.end()), all_nodes_.end());
}

std::span<const Index> ContactSurface::nodes(Index face) const {
  const auto f = as_size(face);
  return std::span(nodes_).subspan(first_node_[f], first_node_[f + 1] - first_node_[f]);
}

Face ContactSurface::reference_face(Index face) const {
  Face result;
  result.shape = shape(face);
  const auto list = nodes(face);
  result.n_nodes = static_cast<int>(list.size());
  for (std::size_t a = 0; a < list.size(); ++a) result.x[a] = mesh_.x[as_size(list[a])];
  return result;
}

Face ContactSurface::current_face(Index face, std::span<const double> displacement, int components) const {
  Face result = reference_face(face);
  const auto list = nodes(face);
  const auto c = as_size(components);
  for (std::size_t a = 0; a < list.size(); ++a)
    for (std::size_t i = 0; i < c; ++i) result.x[a][i] += displacement[as_size(list[a]) * c + i];
  return result;
}

std::vector<Point> ContactSurface::averaged_normals(std::span<const double> displacement, int components,
                                                    double feature_angle) const {
  // The reference coordinates of a face's nodes: vertices, then the middles of the edges.
  const auto node_xi = [](mesh::Shape shape, std::size_t a) {
    const auto v = reference_vertices(shape);
    return a < v.size() ? v[a] : scale(0.5, add(v[a - v.size()], v[(a - v.size() + 1) % v.size()]));
  };
  // Every face's own normal at each of its nodes, and which of them meet at a node.
  std::vector<Point> own(nodes_.size());
  std::map<Index, std::vector<std::size_t>> at_node;
  for (Index f = 0; f < n_faces(); ++f) {
    const Face face = current_face(f, displacement, components);
    for (std::size_t a = 0; a < as_size(face.n_nodes); ++a) {
      const std::size_t i = first_node_[as_size(f)] + a;
      own[i] = face.normal(node_xi(face.shape, a));
      at_node[nodes_[i]].push_back(i);
    }
  }
  // At a node those normals are averaged that differ by less than the feature angle, always the own
  // one too.
  const double least_cosine = std::cos(feature_angle);
  std::vector<Point> mean(nodes_.size());
  for (const auto& [node, entries] : at_node)
    for (std::size_t i : entries) {
      Point sum{};
      for (std::size_t j : entries)
        if (dot(own[i], own[j]) > least_cosine || i == j) sum = add(sum, own[j]);
      mean[i] = scale(1 / norm(sum), sum);
    }
  return mean;
}

double ContactSurface::measure() const {
  double sum = 0;
  for (Index f = 0; f < n_faces(); ++f) sum += reference_face(f).measure();
  return sum;
}

double ContactSurface::mean_face_size() const {
  double sum = 0;
  for (Index f = 0; f < n_faces(); ++f) sum += reference_face(f).size();
  return sum / n_faces();
}

double ContactSurface::extent() const {
  std::array<Point, 2> box = reference_face(0).box();
  for (Index f = 1; f < n_faces(); ++f) {
    const auto b = reference_face(f).box();
    for (std::size_t i = 0; i < 3; ++i) {
      box[0][i] = std::min(box[0][i], b[0][i]);
      box[1][i] = std::max(box[1][i], b[1][i]);
    }
  }
  return distance(box[0], box[1]);
}

}  // namespace solidus::contact
