/// Which faces belong together at a node is decided once, by the feature angle in the drawing; normals of a
/// configuration and their rates then follow from lists of members.
#include "contact/surfaces/master_normals.hpp"

#include <algorithm>
#include <cmath>

#include "contact/surfaces/slave_rule.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

// I − m ⊗ m applied to v.
Point tangential(const Point& m, const Point& v) {
  return add_scaled(v, -dot(m, v), m);
}

}  // namespace

AveragedNormals::AveragedNormals(const ContactSurface& surface, double feature_angle) {
  // First each face gives its own normal to each of its nodes, and each node the list of its faces.
  const Index n = surface.n_faces();
  std::vector<std::vector<std::pair<Index, int>>> at_node(surface.all_nodes().size());
  const auto row_of = [&](Index node) {
    const auto& all = surface.all_nodes();
    return as_size(std::lower_bound(all.begin(), all.end(), node) - all.begin());
  };
  first_node_.push_back(0);
  for (Index f = 0; f < n; ++f) {
    const auto nodes = surface.nodes(f);
    const Face face = surface.reference_face(f);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      at_node[row_of(nodes[a])].emplace_back(f, static_cast<int>(a));
      own_.push_back(face.normal(node_xi(face.shape, a)));
    }
    first_node_.push_back(own_.size());
  }
  mean_.resize(own_.size());
  length_.resize(own_.size());

  // Then the faces whose normals are averaged at a node are found: all those around it that do not bend away
  // by more than the feature angle. An edge that is sharper stays sharp.
  const double least_cosine = std::cos(feature_angle);
  first_member_.push_back(0);
  first_patch_.push_back(0);
  std::vector<Index> patch;
  for (Index f = 0; f < n; ++f) {
    const auto nodes = surface.nodes(f);
    // The patch of a face are the nodes of all faces that take part in one of its normals, its own first; the
    // slots say where in the patch the nodes of a member stand, so that rates need no search.
    patch.assign(nodes.begin(), nodes.end());
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const Point& here = own_[first(f) + a];
      for (const auto& [other, local] : at_node[row_of(nodes[a])]) {
        if (other != f && !(dot(here, own_[first(other) + as_size(local)]) > least_cosine)) continue;
        members_.push_back({other, local, slot_.size()});
        for (Index node : surface.nodes(other)) {
          auto found = std::find(patch.begin(), patch.end(), node);
          if (found == patch.end()) found = patch.insert(found, node);
          slot_.push_back(static_cast<int>(found - patch.begin()));
        }
      }
      first_member_.push_back(members_.size());
    }
    patch_.insert(patch_.end(), patch.begin(), patch.end());
    first_patch_.push_back(patch_.size());
  }
}

std::span<const Index> AveragedNormals::nodes(Index face) const {
  const auto f = as_size(face);
  return std::span(patch_).subspan(first_patch_[f], first_patch_[f + 1] - first_patch_[f]);
}

void AveragedNormals::place(std::span<const Face> faces) {
  // Normals of all faces at their nodes, then at each node the mean of those that belong together.
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t a = 0; a < as_size(faces[f].n_nodes); ++a)
      own_[first_node_[f] + a] = faces[f].normal(node_xi(faces[f].shape, a));
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    Point sum{};
    for (std::size_t k = first_member_[i]; k < first_member_[i + 1]; ++k)
      sum = add(sum, own_[first(members_[k].face) + as_size(members_[k].node)]);
    length_[i] = norm(sum);
    mean_[i] = scale(1 / length_[i], sum);
  }
}

Point AveragedNormals::mean_of(Index face, mesh::Shape shape, const Point& xi) const {
  std::array<double, k_max_face_nodes> values;
  mesh::basis_values(shape, xi, values);
  Point sum{};
  for (std::size_t a = 0; a < as_size(mesh::node_count(shape)); ++a)
    sum = add_scaled(sum, values[a], mean_[first(face) + a]);
  return sum;
}

AveragedNormals::Director AveragedNormals::at(Index face, mesh::Shape shape, const Point& xi) const {
  // The interpolated sum is not of unit length; the normal is its direction.
  const Point sum = mean_of(face, shape, xi);
  const double length = norm(sum);
  Director d;
  d.nu = scale(1 / length, sum);
  std::array<double, 2 * k_max_face_nodes> g;
  mesh::basis_gradients(shape, xi, g);
  const auto dim = as_size(mesh::dimension(shape));
  // The derivative of the interpolated normal, across itself.
  for (std::size_t alpha = 0; alpha < dim; ++alpha) {
    // Only the part across the normal changes its direction; the other changes its length.
    Point slope{};
    for (std::size_t a = 0; a < as_size(mesh::node_count(shape)); ++a)
      slope = add_scaled(slope, g[a * dim + alpha], mean_[first(face) + a]);
    d.nu_xi[alpha] = scale(1 / length, tangential(d.nu, slope));
  }
  return d;
}

void AveragedNormals::rates(Index face, std::span<const Face> faces, const Point& xi,
                            std::span<Tensor> nu_rate) const {
  // The chain goes from nodes of neighbouring faces to their own normals, from these to the mean at
  // a node, from there to the interpolated normal and its direction.
  const Face& here = faces[as_size(face)];
  const Point sum = mean_of(face, here.shape, xi);
  const double length = norm(sum);
  const Point nu = scale(1 / length, sum);
  std::array<double, k_max_face_nodes> values;
  mesh::basis_values(here.shape, xi, values);
  std::fill(nu_rate.begin(), nu_rate.end(), Tensor{});
  // Each node's normal is the mean of the normals of its faces, so that every node of these faces moves it.
  for (std::size_t a = 0; a < as_size(here.n_nodes); ++a) {
    const std::size_t i = first(face) + a;
    for (std::size_t k = first_member_[i]; k < first_member_[i + 1]; ++k) {
      const Member& member = members_[k];
      const Face& other = faces[as_size(member.face)];
      const Point& n = own_[first(member.face) + as_size(member.node)];
      const Point at = node_xi(other.shape, as_size(member.node));
      std::array<double, 2 * k_max_face_nodes> g;
      mesh::basis_gradients(other.shape, at, g);
      const auto dim = as_size(other.dimension());
      const auto dual = dual_basis(other.tangents(at));
      // δn = −τ^β (n·δτ_β), seen through both normalisations.
      std::array<Point, 2> through{};
      for (std::size_t beta = 0; beta < dim; ++beta)
        through[beta] =
            scale(-values[a] / (length_[i] * length), tangential(nu, tangential(mean_[i], dual[beta])));
      for (std::size_t c = 0; c < as_size(other.n_nodes); ++c) {
        Tensor& rate = nu_rate[as_size(slot_[member.first_slot + c])];
        for (std::size_t beta = 0; beta < dim; ++beta) add_outer(rate, g[c * dim + beta], through[beta], n);
      }
    }
  }
}

}  // namespace solidus::contact
