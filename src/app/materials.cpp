/// The verb `materials`: the library, or one material with its sources.
#include <fmt/format.h>

#include "app/verbs.hpp"
#include "base/units.hpp"
#include "material/library.hpp"
#include "model/case_materials.hpp"

namespace solidus::app {

namespace {

using material::Material;

std::string celsius(double kelvin) {
  return fmt::format("{:.6g} degC", units::to_display(kelvin, "K", "degC"));
}

std::string property(const std::string& name, const Table& table, const std::string& unit) {
  if (table.constant()) return fmt::format("  {:<22} {:.6g} {}\n", name, table.y()[0], unit);
  std::string out = fmt::format("  {:<22} of temperature [{}]\n", name, unit);
  for (std::size_t i = 0; i < table.x().size(); ++i)
    out += fmt::format("  {:<22} {:>12}  {:.6g}\n", "", celsius(table.x()[i]), table.y()[i]);
  return out;
}

std::string describe(const Material& m) {
  std::string out = fmt::format("{}: {}\n", m.name, m.title);
  out += property("density", Table(m.density), "kg/m3");
  out += property("conductivity", m.conductivity, "W/m/K");
  out += property("specific_heat", m.specific_heat, "J/kg/K");
  if (m.mechanical()) {
    out += property("young_modulus", m.young_modulus, "Pa");
    out += property("poisson_ratio", m.poisson_ratio, "1");
    out += property("expansion", m.expansion, "1/K");
    out += fmt::format("  {:<22} {}\n", "expansion_reference", celsius(m.expansion_reference));
    if (m.solidification()) out += property("twice_shear_viscosity", m.liquid_viscosity, "Pa s");
  }
  for (const auto& change : m.phase_changes)
    out += fmt::format("  {:<22} {} to {}, latent heat {:.6g} J/kg, volume change {:.3g}{}\n", change.name,
                       celsius(change.fraction.solidus()), celsius(change.fraction.liquidus()),
                       change.latent_heat, change.volume_change,
                       change.solidification ? ", solidification" : "");
  out += "Sources and validity\n";
  for (const auto& note : m.notes)
    out +=
        fmt::format("  {:<22} {}{}\n", note.property, note.source.empty() ? "no source given" : note.source,
                    note.valid_to > note.valid_from
                        ? fmt::format(" ({} to {})", celsius(note.valid_from), celsius(note.valid_to))
                        : "");
  return out;
}

}  // namespace

ExitCode materials(const std::string& name) {
  const auto folders = model::material_folders();
  if (!name.empty()) {
    print(describe(material::find_material(name, folders)));
    return k_done;
  }
  std::string out;
  for (const std::string& each : material::material_names(folders))
    out += fmt::format("{:<28} {}\n", each, material::find_material(each, folders).title);
  print(out.empty() ? "The material library is empty.\n" : out);
  return k_done;
}

}  // namespace solidus::app
