/// What a mechanical pass has found at each point is handed to the heat term here; after the thermal phase
/// the temperatures and slips that it has found go back into the history of the points.
#include "contact/heat/heat.hpp"

#include <cmath>

#include "contact/heat/heat_measures.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::contact {

namespace {

/// The nodal form needs shape functions that are nowhere below zero.
bool is_nodal(const ContactParameters& spec, const PairSurfaces& surfaces) {
  return spec.nodal_heat && surfaces.linear();
}

}  // namespace

void InterfaceSums::add(const InterfaceSums& other, double factor) {
  for (double InterfaceSums::*part :
       {&InterfaceSums::dissipated, &InterfaceSums::stored, &InterfaceSums::hardening, &InterfaceSums::energy,
        &InterfaceSums::entropy, &InterfaceSums::mechanical_energy, &InterfaceSums::mechanical_entropy,
        &InterfaceSums::plastic_entropy})
    this->*part += factor * other.*part;
}

ContactHeat::ContactHeat(const ContactGeometry& geometry, AnalysisKind kind, const ContactParameters& spec,
                         const PairSurfaces& surfaces, const PointLaw& law, const PartnerList& partners)
    : geometry_(geometry),
      spec_(spec),
      point_law_(law),
      law_(*spec.heat),
      points_({.dimension = geometry.mesh().dimension,
               .partners = partners,
               .law = law_,
               .nodal = is_nodal(spec, surfaces),
               .curvature = slave_curvatures(geometry, kind, surfaces.slave),
               .master_curvature = master_curvatures(geometry.mesh(), kind, surfaces)}),
      term_(geometry.mesh(), geometry.graph(), points_) {}

void ContactHeat::clear(std::size_t n_points) {
  taken_.clear();
  taken_.reserve(n_points);
  before_.clear();
  before_.reserve(n_points);
}

void ContactHeat::add(const ContactStep& step, const ContactPointState& from, const ContactPointState& now,
                      const PointForces& forces) {
  before_.push_back(now.temperature);
  taken_.push_back(point(step, from, now, forces));
  if (predicted_.empty()) return;
  const std::array<double, 2>& counted = predicted_[taken_.size() - 1];
  taken_.back().step.dissipation -= counted[0];
  taken_.back().step.structural_entropy -= counted[1];
}

void ContactHeat::place() {
  points_.place(std::move(taken_));
  taken_.clear();
}

void ContactHeat::restore(const ContactStep& step, std::span<const ContactPointState> now, bool held) {
  if (held) predicted_.clear();
  std::vector<HeatPoint> points;
  for (std::size_t p = 0; p < now.size(); ++p) {
    points.push_back(point(step, held ? now[p] : step.from[p], now[p], {}));
    if (held) points.back().has_temperature = now[p].temperature > 0;  // it may store what the bodies give
  }
  points_.place(std::move(points));
}

HeatPoint ContactHeat::point(const ContactStep& step, const ContactPointState& from,
                             const ContactPointState& now, const PointForces& forces) const {
  // What heat sees of the mechanics: the gap in which melt held by the atmosphere counts as closed,
  // the pressure with its slope by penetration, and the heat made by friction.
  HeatPoint point{.penetration = seen_by_heat(now.penetration, now.pressure, now.suction),
                  .pressure = now.pressure,
                  .pressure_slope = now.pressure >= 0 ? forces.normal.tangent : 0.0,
                  .has_temperature = has_temperature() && step.dt > 0 && from.temperature > 0,
                  .step = {},
                  .joint = forces.joint};
  // 5.40 again in the thermal phase; the other schemes have solved it, or iterate to it.
  if (point_law_.friction && spec_.friction->thermal_return_mapping && step.coupled.law == nullptr &&
      step.iterate.empty() && forces.status != PointStatus::open) {
    point.friction = &*point_law_.friction;
    point.slip = {.trial = forces.trial,
                  .pressure = rubbing_pressure(now.pressure, now.molten),
                  .internal_variable = from.internal_variable,
                  .temperature = from.temperature,
                  .stiffening = point_law_.friction_stiffens ? from.stiffening : 1.0};
  }
  point.step = {step.dt, spec_.interface_heat_capacity, from.temperature, forces.friction.structural_entropy,
                forces.friction.dissipation};
  return point;
}

void ContactHeat::predict() {
  if (!has_temperature()) return;
  std::vector<HeatPoint> points = points_.list();
  predicted_.clear();
  for (HeatPoint& point : points) {
    predicted_.push_back({point.step.dissipation, point.step.structural_entropy});
    point.step.dissipation *= 2;
    point.step.structural_entropy *= 2;
  }
  points_.place(std::move(points));
}

void ContactHeat::show_whole_step() {
  std::vector<HeatPoint> points = points_.list();
  for (std::size_t p = 0; p < points.size(); ++p) {
    points[p].step.time_step *= 2;
    points[p].step.dissipation += 2 * predicted_[p][0];
    points[p].step.structural_entropy += 2 * predicted_[p][1];
  }
  points_.place(std::move(points));
  predicted_.clear();
}

void ContactHeat::reset() {
  predicted_.clear();
  points_.stages().end();
}

namespace {

/// The work of a step that neither dissipation nor heat has taken, before states change.
double hardening_of_step(const ContactGeometry& geometry, const ContactStep& step,
                         const std::vector<ContactPointState>& now) {
  double hardening = 0;
  for (std::size_t p = 0; p < now.size(); ++p) {
    const ContactPointState &from = step.from[p], &to = now[p];
    if (const auto particle = geometry.kinematics().particle(as_index(p));
        particle.counted && from.temperature > 0)
      hardening += particle.area * (to.work - from.work - to.dissipation + from.dissipation);
  }
  return hardening;
}

}  // namespace

InterfaceSums ContactHeat::commit(std::span<const double> temperature, const ContactStep& step,
                                  std::vector<ContactPointState>& now) {
  // The interface stores heat and entropy of its own. What the step has changed of both is summed for the
  // audit, before and after the slip of the step is taken over.
  InterfaceSums sums;
  if (!has_temperature()) return sums;
  const std::vector<double> found = interface_temperatures(points_, temperature);
  const InterfaceHeat heat = interface_heat(points_, temperature);
  sums.hardening = hardening_of_step(geometry_, step, now);
  // The slip of the step becomes that of the state, and the heat of a predicted step is shown as a whole.
  take_slip(temperature, step, now);
  if (term_.stores() && !predicted_.empty()) show_whole_step();
  points_.stages().end();
  sums.dissipated = heat.dissipated;
  sums.stored = heat.stored;
  const double capacity = spec_.interface_heat_capacity;
  const auto energy = [&](double t, double internal_variable) {
    return point_law_.friction ? interface_energy(*point_law_.friction, t, internal_variable)
                               : interface_energy(capacity, t);
  };
  const auto entropy = [&](double t, double internal_variable) {
    return point_law_.friction ? interface_entropy(*point_law_.friction, t, internal_variable)
                               : interface_entropy(capacity, t);
  };
  // Each point gets the temperature that was found and the entropy that its plastic slip has made.
  for (std::size_t p = 0; p < found.size(); ++p) {
    const ContactPointState& from = step.from[p];
    ContactPointState& to = now[p];
    if (!(from.temperature > 0)) continue;
    to.temperature = found[p];
    double made = 0;
    if (point_law_.friction)
      made = plastic_entropy_increment(*point_law_.friction, to.slip - from.slip,
                                       rubbing_pressure(to.pressure, to.molten), to.temperature);
    to.plastic_entropy = from.plastic_entropy + made;
    const ContactKinematics::Particle particle = geometry_.kinematics().particle(as_index(p));
    if (!particle.counted) continue;
    // Energies are those of the old state, of the state between the phases (rubbed, at the temperature
    // before), and of the new one: the differences tell the mechanical part from the whole.
    const double w = particle.weight, between = before_[p];
    const double rubbed = rubbed_variable(from, to);
    const double old_energy = energy(from.temperature, from.internal_variable);
    const double old_entropy = entropy(from.temperature, from.internal_variable);
    sums.energy += w * (energy(to.temperature, rubbed) - old_energy);
    sums.entropy += w * (entropy(to.temperature, rubbed) - old_entropy);
    sums.mechanical_energy += w * (energy(between, rubbed) - old_energy);
    sums.mechanical_entropy += w * (entropy(between, rubbed) - old_entropy);
    sums.plastic_entropy += particle.area * made;
  }
  processes::sum(std::span(reinterpret_cast<double*>(&sums), sizeof(sums) / sizeof(double)));
  return sums;
}

void ContactHeat::take_slip(std::span<const double> temperature, const ContactStep& step,
                            std::vector<ContactPointState>& now) {
  const std::vector<std::optional<FrictionResponse>> found = points_.keep_slip(temperature);
  // Slip that the thermal phase has found again replaces that of the mechanical one; the traction keeps its
  // direction.
  for (std::size_t p = 0; p < found.size(); ++p) {
    if (!found[p]) continue;
    const FrictionResponse& slip = *found[p];
    ContactPointState& to = now[p];
    to.status = slip.sticks ? PointStatus::sticks : PointStatus::slips;
    if (const double size = norm(to.traction); size > 0)
      to.traction = scale(slip.traction / size, to.traction);
    contact::take_slip(slip, step.from[p], to);
  }
}

}  // namespace solidus::contact
