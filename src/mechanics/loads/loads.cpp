/// Loads that are the same everywhere become one vector for each function of time, so that a step only scales
/// and adds them; others points with weights. Prescribed displacements become a list of entries.
#include "mechanics/loads/loads.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/common_failure.hpp"
#include "system/errors.hpp"

namespace solidus::mechanics {

namespace {

template <class Map>
const typename Map::mapped_type& find(const Map& groups, const std::string& name, const char* what) {
  const auto found = groups.find(name);
  if (found != groups.end()) return found->second;
  std::string allowed;
  for (const auto& group : groups) allowed += (allowed.empty() ? "" : ", ") + group.first;
  throw InputError({}, std::string("no ") + what + " '" + name + "' in the mesh", allowed);
}

/// A point of a rule on a face, with what it weighs.
struct FacePoint {
  const Index* nodes;    ///< of the face, local
  const double* values;  ///< N_a, [node]
  int n_nodes;
  double weight;       ///< [m²]
  mesh::Point normal;  ///< out of the body
};

/// Visits every point of every active face. Closed surfaces of quadratic shapes are integrated with the
/// degree that is exact for straight faces: N times the radius.
/// @param more  degrees of the rule beyond that
void visit_points(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                  const mesh::Surface& surface, int more,
                  const std::function<void(const FacePoint&)>& visit) {
  for (const mesh::ElementBlock& faces : active.part(mesh, surface).faces) {
    const mesh::FaceGeometry geometry(mesh, faces, kind,
                                      mesh::gauss_rule(faces.shape, 2 * mesh::order(faces.shape) + 1 + more));
    const double out = active.reversed(faces) ? -1.0 : 1.0;
    for (Index face = 0; face < geometry.n_faces; ++face)
      for (int q = 0; q < geometry.n_points; ++q) {
        const auto at = as_size(face * geometry.n_points + q);
        FacePoint point{faces.element(face),
                        geometry.values.data() + static_cast<std::ptrdiff_t>(q) * geometry.n_nodes,
                        geometry.n_nodes, geometry.weight[at], geometry.normal[at]};
        for (double& n : point.normal) n *= out;
        visit(point);
      }
  }
}

/// Where a point with these basis functions lies [m].
Position place_of(const mesh::Mesh& mesh, const Index* nodes, const double* values, int n_nodes) {
  Position x{};
  for (int a = 0; a < n_nodes; ++a)
    for (std::size_t i = 0; i < 3; ++i) x[i] += values[a] * mesh.x[as_size(nodes[a])][i];
  return x;
}

/// The coordinate that a set of nodes has in common, −1 when it is not exactly one of the mesh's. Collective.
int common_coordinate(const mesh::Mesh& mesh, std::span<const Index> nodes) {
  constexpr double k_flat = 1e-6;  // of the largest extent: what meshing programs leave
  // The extent of the set along each axis, over all processes.
  std::array<double, 3> extent{};
  for (std::size_t i = 0; i < 3; ++i) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Index node : nodes) {
      low = std::min(low, mesh.x[as_size(node)][i]);
      high = std::max(high, mesh.x[as_size(node)][i]);
    }
    extent[i] = parallel::global_max(high) - parallel::global_min(low);
  }
  // Flat along exactly one axis: that is the plane of the set. A point or a line has more than one.
  const double largest = *std::max_element(extent.begin(), extent.end());
  int common = -1, n = 0;
  for (int i = 0; i < mesh.dimension; ++i)
    if (extent[as_size(i)] <= k_flat * largest) {
      common = i;
      ++n;
    }
  return n == 1 ? common : -1;
}

/// Sums entries of the same degree of freedom.
void merge(std::vector<std::pair<Index, double>>& force) {
  std::sort(force.begin(), force.end());
  std::vector<std::pair<Index, double>> merged;
  for (const auto& [entry, value] : force)
    if (!merged.empty() && merged.back().first == entry)
      merged.back().second += value;
    else
      merged.emplace_back(entry, value);
  force = std::move(merged);
}

}  // namespace

Loads::Loads(const mesh::Mesh& mesh, AnalysisKind kind, MechanicalConditions conditions,
             const linear::ActiveSet& active, std::span<const double> start, std::span<const double> density)
    : mesh_(mesh),
      density_(density.begin(), density.end()),
      conditions_(std::move(conditions)),
      components_(displacement_components(kind)),
      constant_(as_size(mesh.n_owned_nodes * components_), 0.0),
      fixed_(as_size(mesh.n_nodes() * components_), 0),
      supported_(fixed_.size(), 0) {
  // Loads on surfaces come first, then supports, then faces that stay plane, since those look at what is
  // prescribed.
  for (const Pressure& pressure : conditions_.pressures) add_surface(mesh, kind, active, pressure);
  for (const Traction& traction : conditions_.tractions) add_surface(mesh, kind, active, traction);
  for (const BodyForce& force : conditions_.body_forces) add_volume(kind, active, force);
  // Around an axis the radial displacement on the axis is zero, though no condition says it.
  if (kind == AnalysisKind::axisymmetric) {
    double largest = 0;
    for (const mesh::Point& x : mesh.x) largest = std::max(largest, std::abs(x[0]));
    largest = parallel::global_max(largest);  // a process may have nothing but nodes on the axis
    Support axis{0.0, {}, {}, {}};
    for (Index node = 0; node < mesh.n_nodes(); ++node)
      if (std::abs(mesh.x[as_size(node)][0]) <= 1e-10 * largest) axis.entries.push_back(node * components_);
    supports_.push_back(std::move(axis));
  }
  for (const PrescribedDisplacement& condition : conditions_.displacements)
    add_support(mesh, active, condition, start);
  // Prescribed entries are marked for all conditions together.
  for (const Support& support : supports_)
    for (Index entry : support.entries) fixed_[as_size(entry)] = 1;
  std::vector<char> tied(conditions_.plane_faces.empty() ? 0 : fixed_.size(), 0);
  for (const PlaneFace& face : conditions_.plane_faces) add_plane_face(mesh, active, face, tied);
  for (Index node = 0; node < mesh.n_nodes(); ++node)
    if (!active.node(node)) std::fill_n(fixed_.begin() + node * components_, components_, 1);
}

void Loads::add_support(const mesh::Mesh& mesh, const linear::ActiveSet& active,
                        const PrescribedDisplacement& condition, std::span<const double> start) {
  // The component may be one that the analysis does not have, such as z in the plane.
  if (condition.component < 0 || condition.component >= components_)
    throw InputError({}, "displacement component " + std::to_string(condition.component) + " of '" +
                             condition.node_set + "' does not exist in this analysis");
  Support support{condition.value, {}, {}, {}};
  // The entries of nodes that are there; relative to the start of the stage where the condition says so.
  for (Index node : find(mesh.node_sets, condition.node_set, "group"))
    if (active.node(node)) support.entries.push_back(node * components_ + condition.component);
  if (condition.relative)
    for (const Index entry : support.entries)
      support.start.push_back(start.empty() ? 0.0 : start[as_size(entry)]);
  if (!condition.value.uniform())
    for (const Index entry : support.entries) support.x.push_back(mesh.x[as_size(entry / components_)]);
  // Entries that are held have no equation; later conditions may hold the same one.
  for (const Index entry : support.entries) supported_[as_size(entry)] = 1;
  supports_.push_back(std::move(support));
}

void Loads::add_plane_face(const mesh::Mesh& mesh, const linear::ActiveSet& active, const PlaneFace& face,
                           std::vector<char>& tied) {
  // The nodes of the group must lie in a plane normal to a coordinate: their displacement in that direction
  // is then one unknown.
  const std::vector<Index>& nodes = find(mesh.node_sets, face.node_set, "group");
  const int normal = common_coordinate(mesh, nodes);
  if (normal < 0)
    throw InputError(
        {}, "the face '" + face.node_set + "' shall stay plane, but it is not normal to a coordinate",
        "a group whose nodes have one coordinate in common");
  // The entries of active nodes are collected. A node whose displacement is prescribed, or that another plane
  // face has tied already, contradicts the condition.
  std::vector<Index> group;
  bool is_fixed = false, is_tied = false;
  for (const Index node : nodes) {
    if (!active.node(node)) continue;
    const Index entry = node * components_ + normal;
    const auto at = as_size(entry);
    is_fixed = is_fixed || fixed_[at] != 0;
    is_tied = is_tied || tied[at] != 0;
    tied[at] = 1;
    group.push_back(entry);
  }
  // Any process may have met the contradiction, so all of them ask before one throws.
  if (parallel::any_process(is_fixed))
    throw InputError({},
                     "the face '" + face.node_set +
                         "' shall stay plane, but its normal displacement is prescribed at some nodes",
                     "one of the two conditions");
  if (parallel::any_process(is_tied))
    throw InputError({},
                     "the plane face '" + face.node_set + "' shares nodes with another in the same direction",
                     "one group for both");
  constraint_groups_.push_back(std::move(group));
}

void Loads::add_surface(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                        const Pressure& pressure) {
  const mesh::Surface& surface = find(mesh.surfaces, pressure.surface, "surface");
  // The nodal forces of a unit pressure, or points that have a pressure of their own each.
  const bool placed = !pressure.value.uniform();
  Unit unit{pressure.value, {}};
  PlacedForce load(pressure.value);
  visit_points(mesh, kind, active, surface, placed ? 1 : 0, [&](const FacePoint& p) {
    const std::size_t point = placed ? load.add_point(place_of(mesh, p.nodes, p.values, p.n_nodes)) : 0;
    for (int a = 0; a < p.n_nodes; ++a) {
      const Index node = p.nodes[a];
      if (node >= mesh.n_owned_nodes) continue;
      for (int i = 0; i < components_; ++i) {
        const double weight = -p.weight * p.values[a] * p.normal[as_size(i)];
        if (placed)
          load.add_share(node * components_ + i, point, weight);
        else
          unit.force.emplace_back(node * components_ + i, weight);
      }
    }
  });
  if (placed) {
    placed_.push_back(std::move(load));
    return;
  }
  merge(unit.force);
  units_.push_back(std::move(unit));
}

void Loads::add_surface(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                        const Traction& traction) {
  const mesh::Surface& surface = find(mesh.surfaces, traction.surface, "surface");
  for (int i = 0; i < components_; ++i)
    add_component(mesh, kind, active, surface, i, traction.value[as_size(i)]);
}

void Loads::add_component(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                          const mesh::Surface& surface, int component, const PlaceFunction& value) {
  // The nodal forces of a unit traction, which the load multiplies, or points with tractions of their own.
  const bool placed = !value.uniform();
  Unit unit{value, {}};
  PlacedForce load(value);
  visit_points(mesh, kind, active, surface, placed ? 1 : 0, [&](const FacePoint& p) {
    const std::size_t point = placed ? load.add_point(place_of(mesh, p.nodes, p.values, p.n_nodes)) : 0;
    for (int a = 0; a < p.n_nodes; ++a) {
      if (p.nodes[a] >= mesh.n_owned_nodes) continue;
      const Index entry = p.nodes[a] * components_ + component;
      if (placed)
        load.add_share(entry, point, p.weight * p.values[a]);
      else
        unit.force.emplace_back(entry, p.weight * p.values[a]);
    }
  });
  if (placed) {
    placed_.push_back(std::move(load));
    return;
  }
  merge(unit.force);
  units_.push_back(std::move(unit));
}

void Loads::add_volume(AnalysisKind kind, const linear::ActiveSet& active, const BodyForce& force) {
  std::vector<PlacedForce> loads;
  for (int i = 0; i < components_; ++i) loads.emplace_back(force.value[as_size(i)]);
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    if (mesh_.bodies[as_size(block.body)].name != force.body || !active.body(block.body)) continue;
    // Every point of every element that touches a node of this process; padding of a batch weighs nothing.
    const double scale = scale_of(force, block.body);
    const mesh::BlockGeometry g(mesh_, block, kind,
                                mesh::gauss_rule(block.shape, 2 * mesh::order(block.shape) + 1));
    for (Index e = 0; e < g.n_elements; ++e)
      for (int q = 0; q < g.n_points; ++q) {
        const double* values = g.values.data() + static_cast<std::ptrdiff_t>(q) * g.n_nodes;
        const double weight = scale * g.weight_at(e / k_lanes, q)[static_cast<int>(e % k_lanes)];
        const Position x = place_of(mesh_, block.element(e), values, g.n_nodes);
        for (int i = 0; i < components_; ++i) {
          PlacedForce& load = loads[as_size(i)];
          const std::size_t point = load.add_point(x);
          for (int a = 0; a < g.n_nodes; ++a)
            if (const Index node = block.element(e)[a]; node < mesh_.n_owned_nodes)
              load.add_share(node * components_ + i, point, weight * values[a]);
        }
      }
  }
  for (PlacedForce& load : loads) placed_.push_back(std::move(load));
}

void Loads::add_body_forces(const mesh::ElementBlock& block, double time, std::span<double> force) const {
  // The middles of the elements are those of their corners, which linear simplices have alone.
  const auto n = as_size(mesh::node_count(block.shape));
  const std::vector<double> equal(n, 1.0 / static_cast<double>(n));
  std::vector<Position> x;
  for (Index e = 0; e < block.size(); ++e)
    x.push_back(place_of(mesh_, block.element(e), equal.data(), static_cast<int>(n)));
  std::vector<double> values(x.size());
  for (const BodyForce& one : conditions_.body_forces) {
    if (mesh_.bodies[as_size(block.body)].name != one.body) continue;
    for (std::size_t i = 0; i < as_size(components_); ++i) {
      one.value[i].values(x, time, values);
      for (std::size_t e = 0; e < x.size(); ++e) force[3 * e + i] += scale_of(one, block.body) * values[e];
    }
  }
}

void Loads::add_constant(std::span<const double> force) {
  for (std::size_t i = 0; i < constant_.size(); ++i) constant_[i] += force[i];
}

void Loads::evaluate(double time, std::span<double> force) const {
  std::copy(constant_.begin(), constant_.end(), force.begin());
  for (const Unit& unit : units_) {
    const double factor = unit.factor.value(time);
    if (factor == 0) continue;
    for (const auto& [entry, value] : unit.force) force[as_size(entry)] += factor * value;
  }
  if (placed_.empty()) return;
  run_collectively([&] {
    for (const PlacedForce& load : placed_) load.add(time, force);
  });
}

std::vector<double> Loads::Support::values(double time) const {
  if (value.uniform()) return std::vector<double>(entries.size(), value.value(time));
  std::vector<double> at_nodes(x.size());
  run_collectively([&] { value.values(x, time, at_nodes); });
  return at_nodes;
}

void Loads::prescribe(double time, std::span<double> displacement) const {
  for (const Support& support : supports_) {
    const std::vector<double> values = support.values(time);
    for (std::size_t i = 0; i < support.entries.size(); ++i)
      displacement[as_size(support.entries[i])] =
          support.start.empty() ? values[i] : support.start[i] + values[i];
  }
}

void Loads::prescribe_rate(double time, std::span<double> velocity) const {
  for (const Support& support : supports_) {
    if (support.value.tabulated()) {
      const double rate = support.value.derivative(time);
      for (const Index entry : support.entries) velocity[as_size(entry)] = rate;
      continue;
    }
    // Of a formula the parabola through three times from this one on, so close that rounding and curvature
    // do not matter compared with each other.
    constexpr double k_apart = 1e-6;  // [s]
    const std::vector<double> now = support.values(time), next = support.values(time + k_apart),
                              last = support.values(time + 2 * k_apart);
    for (std::size_t i = 0; i < support.entries.size(); ++i)
      velocity[as_size(support.entries[i])] = (4 * next[i] - 3 * now[i] - last[i]) / (2 * k_apart);
  }
}

}  // namespace solidus::mechanics
