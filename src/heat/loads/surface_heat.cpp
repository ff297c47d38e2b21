/// The law gives flux and slope at a point (surface_law.cpp); the patches say which points there are and to
/// which nodes they give: Gauss points of faces, or the nodes themselves by the closed rule.
#include "heat/loads/surface_heat.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

namespace {

/// ∫ Π N_a dA over a face, of the nodes in the list.
double integral(const mesh::FaceGeometry& g, Index face, std::initializer_list<int> nodes) {
  double sum = 0;
  for (int q = 0; q < g.n_points; ++q) {
    double part = g.weight[as_size(face * g.n_points + q)];
    for (const int a : nodes) part *= g.values[as_size(q * g.n_nodes + a)];
    sum += part;
  }
  return sum;
}

}  // namespace

double SurfaceHeat::Patch::temperature(std::span<const double> t, Index face, int point) const {
  const Index* of_face = nodes.data() + static_cast<std::ptrdiff_t>(face) * n_nodes;
  const double* n = values.data() + static_cast<std::ptrdiff_t>(point) * n_nodes;
  double sum = 0;
  for (int a = 0; a < n_nodes; ++a) sum += n[a] * t[as_size(of_face[a])];
  return sum;
}

SurfaceHeat::SurfaceHeat(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::Surface& surface,
                         std::string name, SurfaceLaw law, bool closed)
    : name_(std::move(name)), law_(std::move(law)) {
  // `lumped` are the weights of the closed rule, `positive` those of supply.
  std::vector<double> lumped(as_size(mesh.n_owned_nodes), 0.0);  // ∫ N_i dA
  std::vector<double> positive(lumped.size(), 0.0);
  for (const mesh::ElementBlock& faces : surface.faces) {
    const int order = mesh::order(faces.shape);
    // Exact for N_a N_b times the radius on straight faces.
    const mesh::FaceGeometry g(mesh, faces, kind, mesh::gauss_rule(faces.shape, 2 * order + 1));
    // By the closed rule heat goes to the nodes. Quadratic faces have corners of negative weight: a second
    // set of weights, positive and with the same sum, serves heat that is supplied.
    if (closed) {
      for (Index face = 0; face < g.n_faces; ++face) {
        double area = 0, squares = 0;
        for (int a = 0; a < g.n_nodes; ++a) {
          area += integral(g, face, {a});
          squares += integral(g, face, {a, a});
        }
        for (int a = 0; a < g.n_nodes; ++a) {
          const Index node = faces.element(face)[a];
          if (node >= mesh.n_owned_nodes) continue;
          lumped[as_size(node)] += integral(g, face, {a});
          positive[as_size(node)] += area / squares * integral(g, face, {a, a});
        }
      }
      if (order == 2 && mesh.dimension == 3 && exchanges(law_)) add_corners(faces, g);
      continue;
    }
    // By the open rule the law is taken at Gauss points.
    patches_.push_back({.n_nodes = g.n_nodes,
                        .n_points = g.n_points,
                        .n_faces = g.n_faces,
                        .n_counted = g.n_counted,
                        .nodes = faces.nodes,
                        .values = g.values,
                        .weight = g.weight,
                        .slots = {}});
  }
  // Only nodes with a weight are kept.
  for (std::size_t i = 0; i < positive.size(); ++i) {
    if (positive[i] == 0.0) continue;
    supplied_nodes_.push_back(as_index(i));
    supply_weight_.push_back(positive[i]);
  }
  // The lumped nodes form a patch of one-node faces: so the rest of the class has one way for both
  // rules.
  Patch nodes;
  nodes.values = {1.0};
  for (std::size_t i = 0; i < lumped.size(); ++i) {
    if (lumped[i] == 0.0) continue;
    nodes.nodes.push_back(as_index(i));
    nodes.weight.push_back(lumped[i]);
  }
  nodes.n_faces = nodes.n_counted = as_index(nodes.nodes.size());
  patches_.push_back(std::move(nodes));
  if (law_.placed()) place_points(mesh, kind, surface, closed);
}

void SurfaceHeat::place_points(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::Surface& surface,
                               bool closed) {
  // Every point at which the law is taken, with its place and what belongs to it: a node, or a point in a
  // face.
  std::vector<PlacedLoad::Point> points;
  std::vector<PlacedLoad::Share> shares;
  Index first_cell = 0;
  for (Patch& patch : patches_) {
    patch.first_point = points.size();
    for (Index face = 0; face < patch.n_faces; ++face)
      for (int q = 0; q < patch.n_points; ++q) {
        const auto number = as_index(points.size());
        const double weight = patch.weight[patch.number(face, q)];
        PlacedLoad::Point& point = points.emplace_back();
        if (closed)
          point.node = patch.nodes[as_size(face)];
        else
          point.cell = first_cell + face;
        if (face < patch.n_counted) point.weight = weight;
        // Place and shares of the point by the shape functions of its face.
        for (int a = 0; a < patch.n_nodes; ++a) {
          const Index node = patch.nodes[as_size(face * patch.n_nodes + a)];
          const double n = patch.values[as_size(q * patch.n_nodes + a)];
          for (std::size_t i = 0; i < 3; ++i) point.x[i] += n * mesh.x[as_size(node)][i];
          if (node < mesh.n_owned_nodes && !exchanges(law_)) shares.push_back({node, number, n * weight});
        }
      }
    if (!closed) first_cell += patch.n_faces;
  }
  // The nodes at which the law is taken in addition to the points of integration.
  point_of_node_.assign(mesh.x.size(), 0);
  const auto place = [&](Index node) {
    std::size_t& point = point_of_node_[as_size(node)];
    if (point != 0) return;
    point = points.size();
    points.push_back({mesh.x[as_size(node)], node, -1, 0});
  };
  for (const Index node : supplied_nodes_) place(node);
  for (const Pair& p : pairs_) {
    place(p.i);
    place(p.j);
  }
  for (const LimitedFlow& flow : flows_) place(flow.from);
  if (law_.enclosed()) {
    for (const PlacedLoad::Point& point : points) point_nodes_.push_back(point.node);
    return;
  }
  // The faces themselves, over which integrals of the law are taken.
  std::vector<CellIntegrals::Cells> cells;
  for (const mesh::ElementBlock& faces : surface.faces)
    cells.push_back({faces.shape, faces.nodes, faces.n_counted});
  load_ = std::make_unique<PlacedLoad>(mesh, kind, name_, law_.law(), std::move(cells), std::move(points),
                                       std::move(shares));
}

void SurfaceHeat::set_window(const LoadWindow& window) {
  if (!load_) law_.set_window(window);
  // A surface that has not been irradiated yet sees the opening.
  if (law_.enclosed() && !law_.has_values()) {
    const double c = law_.enclosed()->factor;
    law_.set_values(std::vector<LoadValues>(point_nodes_.size(), {c, c * law_.enclosed()->environment}));
  }
  if (!load_) return;
  load_->set(window);
  if (exchanges(law_)) law_.set_values(load_->means());
}

void SurfaceHeat::irradiate(std::span<const double> fourth) {
  const double coefficient = law_.enclosed()->factor;
  std::vector<LoadValues> means;
  for (const Index node : point_nodes_) means.push_back({coefficient, coefficient * fourth[as_size(node)]});
  law_.set_values(means);
}

SurfaceFlux SurfaceHeat::at_node(std::span<const double> temperature, Index node) const {
  const auto i = as_size(node);
  return law_.at(temperature[i], point_of_node_.empty() ? 0 : point_of_node_[i]);
}

std::pair<double, double> SurfaceHeat::flux_range() const {
  double least = 0, greatest = 0;
  if (is_placed_flux()) {  // of which only the sign counts
    for (const double heat : load_->heat())
      least = std::min(least, heat), greatest = std::max(greatest, heat);
    return {least, greatest};
  }
  // At absolute zero all that comes in is supply: the range that surroundings can drive.
  for (const Patch& patch : patches_)
    for (std::size_t point = 0; point < patch.weight.size(); ++point) {
      const double q = law_.at(0.0, law_.placed() ? patch.first_point + point : 0).q;
      least = std::min(least, q);
      greatest = std::max(greatest, q);
    }
  return {least, greatest};
}

void SurfaceHeat::add_corners(const mesh::ElementBlock& faces, const mesh::FaceGeometry& g) {
  // At the corners of quadratic quadrilaterals weights are negative: their part of the flow is an exchange
  // with the middles next to them, which the limiter may cut.
  const int corners = g.n_nodes / 2;
  for (Index face = 0; face < g.n_faces; ++face) {
    const Index* nodes = faces.element(face);
    for (int a = 0; a < corners; ++a) {
      const double weight = integral(g, face, {a});
      if (weight >= 0) continue;
      for (const int middle : {corners + a, corners + (a + corners - 1) % corners}) {
        flows_.push_back({nodes[a], nodes[middle]});
        flow_weight_.push_back(-0.5 * weight);
      }
      // Products of corner and middle that are negative are exchanges between pairs.
      for (int middle = corners; middle < g.n_nodes; ++middle) {
        const double product = integral(g, face, {a, middle});
        if (product < 0) pairs_.push_back({nodes[a], nodes[middle], -product});
      }
    }
  }
}

void SurfaceHeat::bind(const linear::BlockMatrix& matrix) {
  for (Pair& p : pairs_) {
    p.ij = matrix.slot(p.i, p.j);
    p.ji = matrix.slot(p.j, p.i);
    p.ii = matrix.slot(p.i, p.i);
    p.jj = matrix.slot(p.j, p.j);
  }
  for (Patch& patch : patches_) patch.slots = matrix.clique_slots(patch.nodes, patch.n_nodes);
}

double SurfaceHeat::add_residual(std::span<const double> temperature, std::span<double> r,
                                 double& moved) const {
  // `counted` is the power that leaves or enters through counted faces, `moved` the sum of its magnitudes. A
  // flux that varies from place to place has been integrated to nodal heats beforehand.
  double counted = 0;
  if (is_placed_flux()) {
    const std::span<const double> heat = load_->heat();
    for (std::size_t i = 0; i < heat.size(); ++i) {
      counted += heat[i];
      moved += std::abs(heat[i]);
      r[i] -= heat[i];
    }
    return counted;
  }
  // Films, fluxes and radiation are integrated at the points of each patch (nodes under the closed rule,
  // Gauss points else); heat into the body lowers the residual.
  for (const Patch& patch : patches_)
    for (Index face = 0; face < patch.n_faces; ++face)
      for (int q = 0; q < patch.n_points; ++q) {
        const std::size_t point = patch.number(face, q);
        const double power = law_.at(patch.temperature(temperature, face, q), patch.first_point + point).q *
                             patch.weight[point];
        if (face < patch.n_counted) {
          counted += power;
          moved += std::abs(power);
        }
        for (int a = 0; a < patch.n_nodes; ++a)
          r[as_size(patch.nodes[as_size(face * patch.n_nodes + a)])] -=
              power * patch.values[as_size(q * patch.n_nodes + a)];
      }
  // Off-diagonal parts of films on quadratic faces exchange heat between two nodes of a face, and change no
  // sum.
  for (const Pair& p : pairs_) {
    const auto i = as_size(p.i), j = as_size(p.j);
    const double heat = p.weight * (at_node(temperature, p.i).q - at_node(temperature, p.j).q);  // into i
    r[i] -= heat;
    r[j] += heat;
  }
  // Of these exchanges the limiter has taken a share away: what is left out is taken back here.
  for (std::size_t i = 0; i < flows_.size(); ++i) {
    if (flows_[i].left == 0) continue;
    const double heat = flows_[i].left * flow(temperature, i);
    r[as_size(flows_[i].from)] -= heat;
    r[as_size(flows_[i].to)] += heat;
  }
  return counted;
}

double SurfaceHeat::flow(std::span<const double> temperature, std::size_t i) const {
  return flow_weight_[i] * at_node(temperature, flows_[i].from).q;
}

void SurfaceHeat::add_supply(std::span<const double> temperature, std::span<double> gain,
                             std::span<double> loss) {
  update_flows(temperature);
  if (is_placed_flux()) {
    const std::span<const double> heat = load_->heat();
    for (std::size_t i = 0; i < heat.size(); ++i) (heat[i] > 0 ? gain : loss)[i] += std::abs(heat[i]);
    return;
  }
  // Gains and losses are kept apart.
  for (std::size_t s = 0; s < supplied_nodes_.size(); ++s) {
    const auto i = as_size(supplied_nodes_[s]);
    const double heat = supply_weight_[s] * at_node(temperature, supplied_nodes_[s]).q;
    (heat > 0 ? gain : loss)[i] += std::abs(heat);
  }
}

void SurfaceHeat::update_flows(std::span<const double> temperature) {
  for (std::size_t i = 0; i < flows_.size(); ++i) flows_[i].heat = flow(temperature, i);
}

bool SurfaceHeat::diagonal() const {
  return pairs_.empty() && std::ranges::all_of(patches_, [](const Patch& p) { return p.n_nodes == 1; });
}

void SurfaceHeat::add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) const {
  if (is_placed_flux()) return;
  // The slope of the law at each point, to the nodes of its face.
  for (const Patch& patch : patches_) {
    const linear::BlockMatrix::Slot* slot = patch.slots.data();
    for (Index face = 0; face < patch.n_faces; ++face, slot += patch.n_nodes * patch.n_nodes)
      for (int q = 0; q < patch.n_points; ++q) {
        const std::size_t point = patch.number(face, q);
        const double slope =
            law_.at(patch.temperature(temperature, face, q), patch.first_point + point).slope *
            patch.weight[point];
        const double* n = patch.values.data() + static_cast<std::ptrdiff_t>(q) * patch.n_nodes;
        for (int a = 0; a < patch.n_nodes; ++a)
          for (int b = 0; b < patch.n_nodes; ++b)
            *matrix.block(slot[a * patch.n_nodes + b]) -= slope * n[a] * n[b];
      }
  }
  // Pairs exchange between their nodes, each flow by the temperature that it comes from.
  for (const Pair& p : pairs_) {
    const double of_i = p.weight * at_node(temperature, p.i).slope,
                 of_j = p.weight * at_node(temperature, p.j).slope;
    *matrix.block(p.ii) -= of_i;
    *matrix.block(p.jj) -= of_j;
    *matrix.block(p.ij) += of_j;
    *matrix.block(p.ji) += of_i;
  }
  // The corner's own part: the entries of the mid-edge nodes would not be symmetric.
  for (std::size_t i = 0; i < flows_.size(); ++i) {
    const Index from = flows_[i].from;
    *matrix.block(matrix.slot(from, from)) -=
        flows_[i].left * flow_weight_[i] * at_node(temperature, from).slope;
  }
}

}  // namespace solidus::heat
