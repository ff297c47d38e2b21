/// Rows of the overview from bodies, contacts, conditions and pours.
#include "check/case_overview.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "cases/interface_library.hpp"
#include "check/coupling_estimate.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "numbers/index_casts.hpp"
#include "setup/body_input.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/scheme_input.hpp"

namespace solidus::check {

namespace {

results::BodyOverview body_overview(const cases::BodySpec& spec, const BodyMeasures& m,
                                    const setup::InitialTemperatureRange& start, double density) {
  results::BodyOverview body;
  // What the file says of the body, what the mesh measures of it, and the range in which it starts.
  body.name = spec.name;
  body.material = std::filesystem::path(spec.material).stem().string();
  body.low = m.low;
  body.high = m.high;
  body.volume = m.volume;
  body.mass = density * m.volume;
  body.skin = m.skin;
  body.start_low = start.low;
  body.start_high = start.high;
  body.shortest_edge = m.shortest_edge;
  body.longest_edge = m.longest_edge;
  body.nodes = m.nodes;
  body.elements = m.elements;
  body.only_conducts = cases::only_conducts(spec);
  body.stages = spec.stages;
  return body;
}

std::string name_of(const cases::CaseSpec& spec, int body) {
  return body >= 0 ? spec.bodies[as_size(body)].name : body == setup::k_several_bodies ? "several" : "";
}

/// "1000 W/m2/K", "50 to 80 W/m2/K".
std::string values(const Function& f, const char* unit, double factor = 1, double offset = 0) {
  if (f.place != nullptr) return fmt::format("by place [{}]", unit);
  const double low = f.table.min_value() * factor + offset, high = f.table.max_value() * factor + offset;
  return low == high ? fmt::format("{:.4g} {}", low, unit)
                     : fmt::format("{:.4g} to {:.4g} {}", low, high, unit);
}

std::string celsius(const Function& f) {
  return values(f, "degC", 1, -k_zero_celsius);
}

constexpr double k_touches = 1e-8;  // [m]

/// The name of a card of the library, with the range that its conductance has in practice.
std::string card_text(const std::string& law) {
  for (const cases::InterfaceCard& card : cases::interface_cards())
    if (card.name == law && !card.range.empty()) return fmt::format("{}: {}", law, card.range);
  return law;
}

/// @param heat  with the conductivities of its bodies, which the case may leave to them
std::string law_text(const cases::ContactSpec& contact, const contact::HeatTransferSpec& heat,
                     const setup::ContactMeasures& m, double temperature) {
  const contact::HeatTransferLaw law(heat);
  const double pressure = contact.wet ? contact.atmosphere : 0.0;
  const double start = m.largest_start;
  const double closed = law.at(0, pressure, temperature).value, gap = std::max(start, 1e-4);
  std::string text = fmt::format("{:.4g} W/m2/K closed", closed);
  const double open = law.at(-gap, 0, temperature).value;
  if (std::abs(open - closed) > 0.01 * closed)
    text += fmt::format(", {:.3g} over a gap of {:.2g} mm", open, 1e3 * gap);
  if (law.radiation_factor() > 0) text += ", radiation";
  if (!contact.law.empty()) text += fmt::format(" ({})", card_text(contact.law));
  return text;
}

/// "air", "air [shake_out]".
std::string with_stages(const std::string& name, const std::vector<std::string>& stages) {
  return stages.empty() ? name : fmt::format("{} [{}]", name, fmt::join(stages, ", "));
}

results::SkinOverview contact_overview(const cases::CaseSpec& spec, const setup::Assembly& a,
                                       const cases::ContactSpec& contact, const setup::ContactMeasures& m) {
  results::SkinOverview skin;
  // The contact is told from its slave surface, which its pressures belong to; the master side is
  // in a column of its own.
  skin.name = with_stages(contact.name, contact.stages);
  skin.surface = m.slave;
  skin.body = name_of(spec, m.slave_body);
  skin.faces =
      "on " + m.master + (m.master_body == -1 ? " (tool)" : " (" + name_of(spec, m.master_body) + ")");
  skin.area = m.area;
  skin.paired = m.paired;
  // Gaps exist only where something was paired; they count as closed where they are below what the
  // search for contacts takes as touching.
  if (m.paired > 0) {
    skin.least_gap = m.least_gap;
    skin.largest_gap = m.largest_gap;
    skin.touches = std::max(std::abs(m.least_start), std::abs(m.largest_start)) < k_touches;
  }
  // The law is told at the mean of the hottest and the coldest start.
  double hot = 0, cold = 1e300;
  for (const setup::InitialTemperatureRange& r : a.start)
    hot = std::max(hot, r.high), cold = std::min(cold, r.low);
  if (!spec.has_heat()) return skin;
  // Contacts of the first stage have a pair that knows its conductance; others have none yet, and
  // are told by their file alone.
  const auto pair =
      std::ranges::find_if(a.contacts, [&](const auto& c) { return c->parts().spec.name == contact.name; });
  const bool conducts = pair != a.contacts.end() && (*pair)->parts().spec.heat.has_value();
  skin.law = conducts ? law_text(contact, *(*pair)->parts().spec.heat, m, (hot + cold) / 2) : "no heat";
  return skin;
}

results::SkinOverview condition_overview(const cases::CaseSpec& spec, const cases::ThermalConditionSpec& c,
                                         const setup::SurfaceMeasures& m) {
  // One row of the table that check prints: where the condition acts, what faces it there, and its value in
  // the unit that a user knows.
  using Kind = cases::ThermalConditionSpec::Kind;
  // Area and paired area are one, since a condition acts on its whole surface.
  results::SkinOverview skin;
  skin.name = with_stages(c.name, c.stages);
  skin.surface = c.group;
  skin.body = name_of(spec, m.body);
  skin.area = skin.paired = m.area;
  // Each kind has its own words for what it exchanges with, and one number or a range for how much.
  switch (c.kind) {
    case Kind::film:
      skin.faces = "in " + celsius(c.ambient);
      skin.law = values(c.coefficient, "W/m2/K");
      break;
    case Kind::radiation:
      skin.faces = c.sees == cases::ThermalConditionSpec::Sees::enclosure
                       ? "enclosure, in " + celsius(c.ambient)
                       : "in " + celsius(c.ambient);
      skin.law = "emissivity " + values(c.emissivity, "");
      break;
    case Kind::flux:
      skin.faces = "heat";
      skin.law = values(c.flux, "W/m2");
      break;
    case Kind::temperature:
      skin.faces = "held";
      skin.law = celsius(c.temperature);
      break;
    case Kind::source:
      skin.faces = "source";
      skin.law = values(c.power, "W/m3");
      break;
    case Kind::exothermic:
      skin.faces = "burns";
      skin.law = fmt::format("{:.4g} J/m3 in {:.4g} s from {:.0f} degC", c.heat, c.duration,
                             units::to_display(c.ignition, "K", "degC"));
      break;
  }
  return skin;
}

results::PourOverview pour_overview(const cases::CaseSpec& spec, const setup::Assembly& a, const Pour& pour,
                                    const BodyMeasures& body) {
  results::PourOverview p;
  const material::Material& metal = a.materials[pour.body];
  // Temperatures first: they are known also where no estimate of the freezing is possible.
  p.body = spec.bodies[pour.body].name;
  p.pouring = a.start[pour.body].high;
  p.liquidus = metal.solidification()->fraction.liquidus();
  p.solidus = metal.solidification()->fraction.solidus();
  p.no_estimate = pour.no_estimate;
  if (!p.no_estimate.empty()) return p;
  // The modulus is volume over cooled area; the numbers of Biot and Fourier are formed with it and with the
  // properties at the solidus.
  p.modulus = body.volume / pour.cooled_area;
  p.local_modulus = pour.local_modulus;
  p.depth = pour.depth;
  // How many elements lie from the cooled skin to the deepest place says whether the mesh can
  // follow the freezing.
  p.elements_across = pour.depth / body.mean_edge;
  const double k = metal.conductivity.value(p.solidus);
  p.biot = pour.conductance * p.modulus / k;
  p.fourier = k / (metal.density * metal.specific_heat.value(p.solidus)) * spec.time.end.value_or(0) /
              (p.modulus * p.modulus);
  p.freezing_time = pour.freezing.time;
  p.governed_by = pour.freezing.governed_by;
  p.mould_reach = pour.freezing.mould_reach;
  return p;
}

}  // namespace

results::Overview overview(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m) {
  results::Overview o;
  o.kind = spec.analysis.kind;
  // A row each for bodies, contacts, cooled faces and pours, then effort and lag of the time step.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    o.bodies.push_back(body_overview(spec.bodies[b], m.bodies[b], a.start[b], a.materials[b].density));
  for (std::size_t c = 0; c < spec.contacts.size(); ++c)
    o.skins.push_back(contact_overview(spec, a, spec.contacts[c], m.contacts[c]));
  for (std::size_t c = 0; c < spec.thermal_conditions.size(); ++c)
    o.skins.push_back(condition_overview(spec, spec.thermal_conditions[c], m.surfaces[c]));
  // Gravity matters to stresses alone: heat without flow does not know it.
  if (spec.has_mechanics() && spec.analysis.gravity != 0) o.gravity = setup::gravity(spec.analysis);
  for (const Pour& pour : m.pours) o.pours.push_back(pour_overview(spec, a, pour, m.bodies[pour.body]));
  o.effort = {m.effort.steps, m.effort.steps_known, m.effort.seconds, m.effort.bytes};
  const bool keeps = setup::keeps_strain(spec, a.materials, a.start);
  // The lag is that of the one-way exchange of deformation and heat; a step that adapts has no one
  // value for it.
  if (setup::lags_a_step(spec, keeps)) {
    o.lag = spec.time.adaptive ? 0.0 : spec.time.step.value_or(0);
    o.end = spec.time.end.value_or(0);
  }
  if (spec.exchanges_heat())
    o.heat_lag = heat_lag(spec, coupling_estimates(spec, a.materials, a.mesh, a.start), keeps);
  return o;
}

}  // namespace solidus::check
