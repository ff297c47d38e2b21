/// Means of a contact pair around its nodes.
#include <algorithm>
#include <array>
#include <limits>

#include "contact/contact_report.hpp"
#include "contact/heat/heat_measures.hpp"
#include "contact/surfaces/rotation.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

/// Values of points that have a partner, on both sides: opening, pressure, conductance, heat in all and by
/// friction, status, the three components of the traction, and what was sunk in.
constexpr std::size_t k_met = 10;
/// Number of fields that are means over all points, on the slave: slip, ζ_c, μ, dissipation, wear, Θ_c.
constexpr std::size_t k_kept = 6;

/// Weighted sums around the owned nodes, and averages.
template <std::size_t n_values>
class NodalAverage {
 public:
  explicit NodalAverage(std::size_t n_nodes) : weight_(n_nodes, 0), sum_(n_nodes) {}
  void add(Index node, double weight, const std::array<double, n_values>& values) {
    const auto i = as_size(node);
    if (i >= weight_.size()) return;
    weight_[i] += weight;
    for (std::size_t k = 0; k < n_values; ++k) sum_[i][k] += weight * values[k];
  }
  /// Not a number where there is none.
  std::array<double, n_values> at(Index node) const {
    const auto i = as_size(node);
    std::array<double, n_values> mean = sum_[i];
    const double w = weight_[i] > 0 ? weight_[i] : std::numeric_limits<double>::quiet_NaN();
    for (double& value : mean) value /= w;
    return mean;
  }

 private:
  std::vector<double> weight_;
  std::vector<std::array<double, n_values>> sum_;
};

/// Means around the owned nodes, and the area of each that has a partner.
struct NodalMeans {
  explicit NodalMeans(std::size_t n_nodes) : met(n_nodes), kept(n_nodes), paired_area(n_nodes, 0.0) {}
  NodalAverage<k_met> met;
  NodalAverage<k_kept> kept;
  std::vector<double> paired_area;
};

/// Means over the points that a node has a share in: of what a point meets (gap, pressure, heat, traction)
/// over the part with a partner, of what it keeps (slip, wear, temperature) over all of its area.
NodalMeans nodal_means_of(const ContactView& pair, std::span<const double> temperature) {
  const ContactKinematics& kinematics =
      pair.geometry.at(pair.end.time, pair.end.displacement, ContactKinematics::Points::own);
  const std::vector<ContactPointState>& points = pair.end.state.points;
  const std::optional<FrictionLaw>& friction = pair.law.friction;
  const bool keeps = friction || pair.has_temperature();
  const auto n = as_size(pair.geometry.mesh().n_owned_nodes);
  const std::vector<double> conductance = pair.heat != nullptr
                                              ? conductances(pair.heat->points(), temperature)
                                              : std::vector<double>(points.size(), 0.0);
  std::vector<InterfaceHeatFlux> heat(points.size());
  if (pair.heat != nullptr && !temperature.empty()) heat = surface_heat(pair.heat->points(), temperature);
  NodalMeans means(n);
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    if (!kinematics.there(p)) continue;
    const ContactPointState& state = points[as_size(p)];
    const ContactKinematics::Particle particle = kinematics.particle(p);
    // What a particle keeps belongs to the slave's nodes, whether it has a partner now or not.
    if (keeps) {
      const double mu =
          friction ? friction->coefficient().value(state.internal_variable, state.temperature).value : 0.0;
      for (std::size_t b = 0; b < particle.nodes.size(); ++b)
        means.kept.add(particle.nodes[b], particle.area * particle.share[b],
                       {state.slip, state.internal_variable, mu, state.dissipation, state.wear_depth,
                        state.temperature});
    }
    const PointMotion motion = kinematics.motion(p, state, ContactKinematics::Asked::motion);
    if (!motion.partnered) continue;
    const Point traction = times(motion.push, state.traction);
    const InterfaceHeatFlux& q = heat[as_size(p)];
    // What is met is given to the nodes of both sides. Heat is told apart by side; tractions act the same on
    // both.
    const auto meet = [&](Index node, double share, std::size_t side) {
      if (const auto i = as_size(node); i < n) means.paired_area[i] += motion.weight * share;
      means.met.add(
          node, motion.weight * share * share,
          {-state.penetration, state.pressure, conductance[as_size(p)], q.total[side], q.by_friction[side],
           static_cast<double>(state.status), traction[0], traction[1], traction[2], state.sunk});
    };
    for (std::size_t b = 0; b < particle.nodes.size(); ++b) meet(particle.nodes[b], particle.share[b], 0);
    for (auto b = as_size(motion.n_slave); b < motion.nodes.size(); ++b)
      meet(motion.nodes[b], -motion.share[b], 1);
  }
  return means;
}

/// Wear of the master is kept by nodes of its own and goes into the same fields.
void add_wear_of_master(const ContactView& pair, ContactNodalFields& fields) {
  for (const MasterWear::Depth& worn : pair.history.depths(pair.end.state)) {
    const auto place = std::lower_bound(fields.nodes.begin(), fields.nodes.end(), worn.node);
    if (place == fields.nodes.end() || *place != worn.node) continue;
    const auto k = as_size(place - fields.nodes.begin());
    fields.wear_depth[k] = worn.depth;
    fields.dissipation[k] = worn.dissipation;
  }
}

}  // namespace

ContactNodalFields nodal_fields(const ContactView& pair, std::span<const double> temperature) {
  const std::optional<FrictionLaw>& friction = pair.law.friction;
  const bool keeps = friction || pair.has_temperature();
  const NodalMeans means = nodal_means_of(pair, temperature);
  // The means are put into the fields in the order of the surface's nodes.
  ContactNodalFields fields;
  fields.nodes = pair.geometry.surface_nodes();
  for (const Index node : fields.nodes) {
    const auto m = means.met.at(node);
    fields.opening.push_back(m[0]);
    fields.overlap.push_back(m[9] - m[0]);
    fields.pressure.push_back(m[1]);
    fields.conductance.push_back(m[2]);
    fields.paired_area.push_back(means.paired_area[as_size(node)]);
    fields.heat_flux.push_back(m[3]);
    fields.frictional_heat_flux.push_back(m[4]);
    const auto k = means.kept.at(node);
    if (keeps) fields.temperature.push_back(k[5]);
    if (!friction) continue;
    fields.status.push_back(m[5]);
    fields.traction.push_back({m[6], m[7], m[8]});
    fields.slip.push_back(k[0]);
    fields.internal_variable.push_back(k[1]);
    fields.coefficient.push_back(k[2]);
    fields.dissipation.push_back(k[3]);
    fields.wear_depth.push_back(k[4]);
  }
  if (friction) add_wear_of_master(pair, fields);
  return fields;
}

}  // namespace solidus::contact
