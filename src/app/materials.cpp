/// The verb `materials`: the library, or one material with its sources.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "app/material_tables.hpp"
#include "app/verbs.hpp"
#include "case/case_materials.hpp"
#include "input/units.hpp"
#include "material/designations.hpp"
#include "material/laws/hardening_law.hpp"
#include "material/laws/kinematic_law.hpp"
#include "material/laws/liquid_law.hpp"
#include "material/laws/rate_law.hpp"
#include "material/library.hpp"
#include "results/output_error.hpp"

namespace solidus::app {

namespace {

using material::Material;

std::string celsius(double kelvin) {
  return fmt::format("{:.6g} degC", units::to_display(kelvin, "K", "degC"));
}

/// Stresses are printed in MPa, numbers without a unit as they are.
struct Shown {
  std::string unit;
  double scale = 1;
  explicit Shown(const std::string& si) : unit(si == "Pa" ? "MPa" : si == "1" ? "" : si) {
    if (si == "Pa") scale = 1e-6;
  }
};

std::string property(const std::string& name, const Table& table, const std::string& si_unit) {
  const Shown shown(si_unit);
  const std::string space = shown.unit.empty() ? "" : " ";
  if (table.constant())
    return fmt::format("  {:<29} {:.6g}{}{}\n", name, shown.scale * table.y()[0], space, shown.unit);
  std::string out =
      fmt::format("  {:<29} of temperature{}\n", name, shown.unit.empty() ? "" : " [" + shown.unit + "]");
  for (std::size_t i = 0; i < table.x().size(); ++i)
    out += fmt::format("  {:<29} {:>12}  {:.6g}\n", "", celsius(table.x()[i]), shown.scale * table.y()[i]);
  return out;
}

/// Measured curves, one a row.
std::string flow_curves(const material::FlowCurves& curves) {
  std::string out = fmt::format("  {:<29} stress [MPa] over plastic strain\n  {:<29} {:>12} ",
                                "plasticity.flow_curve", "", "");
  for (const double strain : curves.strains()) out += fmt::format(" {:>7.4g}", strain);
  for (std::size_t row = 0; row < curves.temperatures().size(); ++row) {
    out += fmt::format("\n  {:<29} {:>12} ", "", celsius(curves.temperatures()[row]));
    for (std::size_t i = 0; i < curves.strains().size(); ++i)
      out += fmt::format(" {:>7.4g}", 1e-6 * curves.stresses()[row * curves.strains().size() + i]);
  }
  return out + "\n";
}

std::string plasticity(const material::Flow& flow) {
  return fmt::format("  {:<29} isotropic hardening {}, kinematic hardening {}, rate dependence {}\n",
                     "plasticity", material::hardening_law(flow.isotropic).name(),
                     material::kinematic_law(flow.kinematic).name(),
                     material::rate_law(flow.rate_dependence).name());
}

std::string describe(const Material& m) {
  std::string out = fmt::format("{}: {}\n", m.name, m.title);
  out += property("density", Table(m.density), "kg/m3");
  const bool curves = m.flow && !m.flow->curves.empty();
  for (const material::Property& p : m.properties())
    if (!curves || p.table != &m.flow->flow_stress) out += property(p.name, *p.table, p.unit);
  if (m.mechanical())
    out += fmt::format("  {:<29} {}\n", "expansion_reference", celsius(m.expansion_reference));
  if (m.flow) out += plasticity(*m.flow);
  if (curves) out += flow_curves(m.flow->curves);
  if (m.mechanical() && m.solidification()) {
    const material::LiquidLaw& liquid = material::liquid_law(m.liquid_model);
    out += fmt::format("  {:<29} {}\n", "liquid_model", liquid.name());
    for (std::size_t i = 0; i < liquid.parameters().size(); ++i)
      out += property(liquid.parameters()[i].key, Table(m.liquid_numbers[i]), liquid.parameters()[i].unit);
  }
  for (const auto& change : m.phase_changes)
    out += fmt::format("  {:<29} {} to {}, latent heat {:.6g} J/kg, volume change {:.3g}{}\n", change.name,
                       celsius(change.fraction.solidus()), celsius(change.fraction.liquidus()),
                       change.latent_heat, change.volume_change,
                       change.solidification ? ", solidification" : "");
  out += "Sources and validity\n";
  for (const auto& note : m.notes)
    out +=
        fmt::format("  {:<29} {}{}\n", note.property, note.source.empty() ? "no source given" : note.source,
                    note.valid_to > note.valid_from
                        ? fmt::format(" ({} to {})", celsius(note.valid_from), celsius(note.valid_to))
                        : "");
  return out;
}

/// How far the values may be off, a line a property that has a spread.
std::string spreads(const material::MaterialSpreads& of) {
  std::string out;
  for (const material::VariedProperty& row : material::varied_properties()) {
    const std::optional<Spread>& spread = of.*row.spread;
    if (!spread) continue;
    const std::string origin = !spread->estimate        ? spread->source
                               : spread->source.empty() ? "estimate"
                                                        : "estimate: " + spread->source;
    out += fmt::format("  {:<29} {:<15} {}\n", row.key, spread_text(*spread), origin);
  }
  return out.empty() ? "" : "Spread: half the width that holds 95 %\n" + out;
}

}  // namespace

ExitCode materials(const std::string& name, const std::string& output) {
  const auto folders = model::material_folders();
  if (!name.empty()) {
    const Material material = material::find_material(name, folders);
    std::string out = describe(material) + spreads(material::find_spreads(name, folders));
    if (const auto known_as = material::designations(name, folders); !known_as.empty())
      out += fmt::format("Also named {}\n", fmt::join(known_as, ", "));
    if (!output.empty()) {
      results::on_first_process([&] { write_material_tables(material, output); });
      out += fmt::format("Tables in {}\n", output);
    }
    print(out);
    return k_done;
  }
  if (!output.empty())
    throw InputError({}, "-o needs the name of a material", "solidus materials NAME -o FOLDER");
  std::string out;
  for (const std::string& each : material::material_names(folders))
    out += fmt::format("{:<28} {}\n", each, material::find_material(each, folders).title);
  print(out.empty() ? "The material library is empty.\n" : out);
  return k_done;
}

}  // namespace solidus::app
