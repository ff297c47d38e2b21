/// Makes the flow data of a material from the keys of [plasticity], with the checks that concern several
/// keys.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "input/units.hpp"
#include "material/cards/flow_keys.hpp"
#include "material/cards/library.hpp"
#include "material/laws/hardening_law.hpp"
#include "material/laws/kinematic_law.hpp"
#include "material/laws/rate_law.hpp"

namespace solidus::material {
namespace {

constexpr double k_largest_yield_strain = 0.1;  ///< a yield stress above this part of E is a slip of units

std::string celsius(double kelvin) {
  return fmt::format("{:.6g} degC", units::to_display(kelvin, "K", "degC"));
}

std::string megapascal(double pascal) {
  return fmt::format("{:.6g} MPa", 1e-6 * pascal);
}

/// The points of both tables: between them both are lines.
std::vector<double> joint_points(const Table& a, const Table& b) {
  std::vector<double> x(a.x().begin(), a.x().end());
  x.insert(x.end(), b.x().begin(), b.x().end());
  std::sort(x.begin(), x.end());
  return x;
}

/// A line continued far enough turns negative or exceeds what was measured; the flow rule cannot use that.
void refuse_linear_continuation(const Function& f, const std::string& property) {
  if (f.table.extrapolation() == Extrapolation::linear)
    throw InputError(f.where, fmt::format("'{}' cannot be continued linearly", property),
                     "extrapolation = \"constant\" or \"error\"");
}

/// 2.121. @param where the place of a point of the table
template <class Place>
void check_thermal_softening(const Table& flow_stress, const FlowData& data, Place where) {
  if (data.allow_thermal_hardening) return;
  for (std::size_t i = 1; i < flow_stress.x().size(); ++i)
    if (flow_stress.y()[i] > flow_stress.y()[i - 1])
      throw InputError(
          where(i),
          fmt::format("the flow stress at zero plastic strain rises with temperature, from {} at {} to {} at "
                      "{}: plastic flow there would take entropy away (2.120, 2.121)",
                      megapascal(flow_stress.y()[i - 1]), celsius(flow_stress.x()[i - 1]),
                      megapascal(flow_stress.y()[i]), celsius(flow_stress.x()[i])),
          "a flow stress that falls or stays level, or allow_thermal_hardening = true");
}

void check_yield_strain(const Table& flow_stress, const Material& material, const SourceLocation& where) {
  for (const double theta : joint_points(flow_stress, material.young_modulus)) {
    const double sigma = flow_stress.value(theta), modulus = material.young_modulus.value(theta);
    if (sigma > k_largest_yield_strain * modulus)
      throw InputError(where,
                       fmt::format("the flow stress at {} is {}, more than a tenth of Young's modulus ({})",
                                   celsius(theta), megapascal(sigma), megapascal(modulus)),
                       "no metal is so strong: is a unit wrong?");
  }
}

void check_curve(const FlowCurveData& data) {
  // A curve is a plain table of its own points: neither an extrapolation nor a range of validity
  // has a meaning here, because the law levels off by itself.
  const Function& stress = data.stress;
  const std::string which = fmt::format("the flow curve at {}", celsius(data.temperature));
  if (stress.table.extrapolation() != Extrapolation::constant)
    throw InputError(stress.where, which + " has an extrapolation", "none: it stays level beyond its points");
  if (stress.valid)
    throw InputError(stress.where, which + " has a range of strains in 'valid'",
                     "none: a flow curve holds for its points");
  // It starts at the flow stress and does not fall: softening would localise in one row of
  // elements, so that the answer would hang on the mesh.
  const auto strain = stress.table.x(), sigma = stress.table.y();
  if (strain.front() != 0)
    throw InputError(stress.where, fmt::format("{} starts at the plastic strain {}", which, strain.front()),
                     "a first point [0, flow stress]");
  for (std::size_t i = 1; i < sigma.size(); ++i)
    if (sigma[i] < sigma[i - 1])
      throw InputError(stress.where,
                       fmt::format("{} falls from {} at the plastic strain {} to {} at {}", which,
                                   megapascal(sigma[i - 1]), strain[i - 1], megapascal(sigma[i]), strain[i]),
                       "a curve that rises or stays level: softening is not supported (the strain would "
                       "gather in one row of elements)");
}

/// The curves in order of temperature, each checked.
std::vector<FlowCurveData> checked_curves(const FlowData& data) {
  // Curves may come in any order; each temperature once.
  if (data.curves.empty())
    throw InputError(data.where, "isotropic_hardening = \"table\" has no flow curves",
                     "at least one [[plasticity.flow_curve]]");
  std::vector<FlowCurveData> curves = data.curves;
  std::stable_sort(curves.begin(), curves.end(), [](const FlowCurveData& a, const FlowCurveData& b) {
    return a.temperature < b.temperature;
  });
  for (std::size_t i = 0; i < curves.size(); ++i) {
    check_curve(curves[i]);
    if (i > 0 && curves[i].temperature == curves[i - 1].temperature)
      throw InputError(curves[i].where, "there are two flow curves at " + celsius(curves[i].temperature));
  }
  return curves;
}

void add_curves(Material& material, Flow& flow, const FlowData& data) {
  // All curves become one table over the union of their strains.
  const std::vector<FlowCurveData> given = checked_curves(data);
  std::vector<FlowCurve> curves;
  std::vector<double> temperatures, at_zero;
  PropertyNote note{"plasticity.flow_curve", "", given.front().temperature, given.back().temperature};
  // The flow stress at zero strain is a table over temperature of its own, of which thermal softening is
  // asked.
  for (const FlowCurveData& curve : given) {
    const auto strain = curve.stress.table.x(), sigma = curve.stress.table.y();
    curves.push_back({curve.temperature, {strain.begin(), strain.end()}, {sigma.begin(), sigma.end()}});
    temperatures.push_back(curve.temperature);
    at_zero.push_back(sigma.front());
    if (const std::string& source = curve.stress.source; note.source.find(source) == std::string::npos)
      note.source += (note.source.empty() ? "" : "; ") + source;
  }
  flow.curves = FlowCurves::merged(std::move(curves));
  flow.flow_stress = Table(std::move(temperatures), std::move(at_zero));
  material.notes.push_back(std::move(note));
  check_thermal_softening(flow.flow_stress, data, [&](std::size_t i) { return given[i].stress.where; });
  check_yield_strain(flow.flow_stress, material, data.where);
}

Table read_property(Material& material, const std::string& property, const Function& f) {
  refuse_linear_continuation(f, property);
  material.notes.push_back(note_of(property, f));
  return f.table;
}

/// Reads the parameters of a law into its tables.
/// @return which of them the file gives
template <class Law, std::size_t n>
std::array<bool, n> add_parameters(Material& m, const FlowData& data, const char* chosen_by, const Law& law,
                                   std::array<Table, n>& tables) {
  std::array<bool, n> given_ones{};
  const auto parameters = law.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string key = parameters[i].key;
    const auto given = data.parameters.find(key);
    given_ones[i] = given != data.parameters.end();
    if (given_ones[i])
      tables[i] = read_property(m, "plasticity." + key, given->second);
    else if (parameters[i].optional)
      tables[i] = parameters[i].left_out;
    else
      throw InputError(data.where, fmt::format("the key '{}' is missing in [plasticity]", key),
                       fmt::format("{} = \"{}\" needs it", chosen_by, law.name()));
  }
  return given_ones;
}

// Measured curves carry their own flow stress; all other laws take it from the key.
void add_isotropic(Material& m, Flow& flow, const FlowData& data) {
  flow.isotropic = data.isotropic;
  if (data.isotropic == IsotropicHardening::table) return add_curves(m, flow, data);

  // Measured curves aside, the law has its flow stress and parameters, which may object to one another.
  flow.flow_stress = read_property(m, "plasticity.flow_stress", data.flow_stress);
  check_thermal_softening(flow.flow_stress, data, [&](std::size_t) { return data.flow_stress.where; });
  check_yield_strain(flow.flow_stress, m, data.flow_stress.where);
  const HardeningLaw& law = hardening_law(data.isotropic);
  add_parameters(m, data, "isotropic_hardening", law, flow.hardening);
  if (const auto objection = law.objection(flow.flow_stress, flow.hardening))
    throw InputError(data.parameters.at(law.parameters()[objection->parameter].key).where, objection->found,
                     objection->allowed);
}

void add_kinematic(Material& m, Flow& flow, const FlowData& data) {
  flow.kinematic = data.kinematic;
  if (data.kinematic == KinematicHardening::none) return;
  flow.kinematic_modulus = read_property(m, "plasticity.kinematic_modulus", data.kinematic_modulus);
  add_parameters(m, data, "kinematic_hardening", kinematic_law(data.kinematic), flow.recall);
}

void add_rate(Material& m, Flow& flow, const FlowData& data) {
  const RateLaw& law = rate_law(data.rate_dependence);
  flow.rate_dependence = data.rate_dependence;
  // A law may complete what is not given, or say which key is missing.
  const GivenRates given = add_parameters(m, data, "rate_dependence", law, flow.rate);
  const RateCompletion completed = law.complete(flow.rate, given, m);
  if (completed.blamed) {
    const auto place = data.parameters.find(law.parameters()[*completed.blamed].key);
    throw InputError(place == data.parameters.end() ? data.where : place->second.where, completed.text,
                     completed.allowed);
  }
  if (completed.left_out)
    m.notes.push_back(
        {std::string("plasticity.") + law.parameters()[*completed.left_out].key, completed.text, 0, 0});
}

}  // namespace

void add_flow(Material& material, const FlowData& data) {
  if (!material.mechanical())
    throw InputError(data.where, "'" + material.name + "' has plasticity but no elastic properties",
                     "young_modulus, poisson_ratio and expansion");
  Flow flow;
  add_isotropic(material, flow, data);
  add_kinematic(material, flow, data);
  add_rate(material, flow, data);
  if (data.taylor_quinney)
    flow.heat_share = read_property(material, "plasticity.taylor_quinney", *data.taylor_quinney);
  material.flow = std::move(flow);
}

}  // namespace solidus::material
