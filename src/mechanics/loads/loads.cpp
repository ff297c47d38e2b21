/// Loads become one vector for each table of time, so that a step only scales and adds them; prescribed
/// displacements become a list of entries.
#include "mechanics/loads/loads.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/block_geometry.hpp"
#include "parallel/parallel.hpp"
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

/// Calls visit(owned node, ∫ N dA, ∫ N n dA) for every node of every active face, n out of the body there.
/// Closed surfaces of quadratic shapes are integrated with the degree that is exact for straight faces: N
/// times the radius.
void integrate(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
               const mesh::Surface& surface,
               const std::function<void(Index, double, const mesh::Point&)>& visit) {
  for (const mesh::ElementBlock& faces : active.part(mesh, surface).faces) {
    const mesh::FaceGeometry geometry(mesh, faces, kind,
                                      mesh::gauss_rule(faces.shape, 2 * mesh::order(faces.shape) + 1));
    const double out = active.reversed(faces) ? -1.0 : 1.0;
    for (Index face = 0; face < geometry.n_faces; ++face)
      for (int a = 0; a < geometry.n_nodes; ++a) {
        const Index node = faces.element(face)[a];
        if (node >= mesh.n_owned_nodes) continue;
        double area = 0;
        mesh::Point normal{};
        for (int q = 0; q < geometry.n_points; ++q) {
          const auto at = static_cast<std::size_t>(face * geometry.n_points + q);
          const double w =
              geometry.weight[at] * geometry.values[static_cast<std::size_t>(q * geometry.n_nodes + a)];
          area += w;
          for (std::size_t i = 0; i < 3; ++i) normal[i] += out * w * geometry.normal[at][i];
        }
        visit(node, area, normal);
      }
  }
}

/// The coordinate that a set of nodes has in common, −1 when it is not exactly one of the mesh's. Collective.
int common_coordinate(const mesh::Mesh& mesh, std::span<const Index> nodes) {
  constexpr double k_flat = 1e-6;  // of the largest extent: what meshing programs leave
  // The extent of the set along each axis, over all processes.
  std::array<double, 3> extent{};
  for (std::size_t i = 0; i < 3; ++i) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Index node : nodes) {
      low = std::min(low, mesh.x[static_cast<std::size_t>(node)][i]);
      high = std::max(high, mesh.x[static_cast<std::size_t>(node)][i]);
    }
    extent[i] = parallel::global_max(high) - parallel::global_min(low);
  }
  // Flat along exactly one axis: that is the plane of the set. A point or a line has more than one.
  const double largest = *std::max_element(extent.begin(), extent.end());
  int common = -1, n = 0;
  for (int i = 0; i < mesh.dimension; ++i)
    if (extent[static_cast<std::size_t>(i)] <= k_flat * largest) {
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
             const linear::ActiveSet& active, std::span<const double> start)
    : conditions_(std::move(conditions)),
      components_(displacement_components(kind)),
      constant_(static_cast<std::size_t>(mesh.n_owned_nodes * components_), 0.0),
      fixed_(static_cast<std::size_t>(mesh.n_nodes() * components_), 0),
      supported_(fixed_.size(), 0) {
  // Loads on surfaces come first, then supports, then faces that stay plane, since those look at what is
  // prescribed.
  for (const Pressure& pressure : conditions_.pressures) add_surface(mesh, kind, active, pressure);
  for (const Traction& traction : conditions_.tractions) add_surface(mesh, kind, active, traction);
  // Around an axis the radial displacement on the axis is zero, though no condition says it.
  if (kind == AnalysisKind::axisymmetric) {
    double largest = 0;
    for (const mesh::Point& x : mesh.x) largest = std::max(largest, std::abs(x[0]));
    largest = parallel::global_max(largest);  // a process may have nothing but nodes on the axis
    Support axis{0.0, {}, {}};
    for (Index node = 0; node < mesh.n_nodes(); ++node)
      if (std::abs(mesh.x[static_cast<std::size_t>(node)][0]) <= 1e-10 * largest)
        axis.entries.push_back(node * components_);
    supports_.push_back(std::move(axis));
  }
  for (const PrescribedDisplacement& condition : conditions_.displacements)
    add_support(mesh, active, condition, start);
  // Prescribed entries are marked for all conditions together.
  for (const Support& support : supports_)
    for (Index entry : support.entries) fixed_[static_cast<std::size_t>(entry)] = 1;
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
  Support support{condition.value, {}, {}};
  // The entries of nodes that are there; relative to the start of the stage where the condition says so.
  for (Index node : find(mesh.node_sets, condition.node_set, "group"))
    if (active.node(node)) support.entries.push_back(node * components_ + condition.component);
  if (condition.relative)
    for (const Index entry : support.entries)
      support.start.push_back(start.empty() ? 0.0 : start[static_cast<std::size_t>(entry)]);
  // Entries that are held have no equation; later conditions may hold the same one.
  for (const Index entry : support.entries) supported_[static_cast<std::size_t>(entry)] = 1;
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
    const auto at = static_cast<std::size_t>(entry);
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
  Unit unit{pressure.value, {}};
  integrate(mesh, kind, active, find(mesh.surfaces, pressure.surface, "surface"),
            [&](Index node, double, const mesh::Point& normal) {
              for (int i = 0; i < components_; ++i)
                unit.force.emplace_back(node * components_ + i, -normal[static_cast<std::size_t>(i)]);
            });
  merge(unit.force);
  units_.push_back(std::move(unit));
}

void Loads::add_surface(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                        const Traction& traction) {
  const mesh::Surface& surface = find(mesh.surfaces, traction.surface, "surface");
  // For each direction the nodal forces of a unit traction, which the load multiplies.
  for (int i = 0; i < components_; ++i) {
    Unit unit{traction.value[static_cast<std::size_t>(i)], {}};
    integrate(mesh, kind, active, surface, [&](Index node, double area, const mesh::Point&) {
      unit.force.emplace_back(node * components_ + i, area);
    });
    merge(unit.force);
    units_.push_back(std::move(unit));
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
    for (const auto& [entry, value] : unit.force) force[static_cast<std::size_t>(entry)] += factor * value;
  }
}

void Loads::prescribe(double time, std::span<double> displacement) const {
  for (const Support& support : supports_) {
    const double value = support.value.value(time);
    for (std::size_t i = 0; i < support.entries.size(); ++i)
      displacement[static_cast<std::size_t>(support.entries[i])] =
          support.start.empty() ? value : support.start[i] + value;
  }
}

void Loads::prescribe_rate(double time, std::span<double> velocity) const {
  for (const Support& support : supports_) {
    const double rate = support.value.derivative(time);
    for (Index entry : support.entries) velocity[static_cast<std::size_t>(entry)] = rate;
  }
}

}  // namespace solidus::mechanics
