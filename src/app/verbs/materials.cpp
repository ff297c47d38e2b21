/// The verb `materials`: the library, or one material with its sources.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "app/case_arguments.hpp"
#include "app/material_import.hpp"
#include "app/material_tables.hpp"
#include "app/verb.hpp"
#include "cases/case_materials.hpp"
#include "input/units.hpp"
#include "material/cards/designations.hpp"
#include "material/cards/library.hpp"
#include "material/laws/hardening_law.hpp"
#include "material/laws/kinematic_law.hpp"
#include "material/laws/liquid_law.hpp"
#include "material/laws/rate_law.hpp"
#include "results/output/output_error.hpp"

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
  // A material as text: constants and tables with their units, then laws, phase changes, and the source and
  // validity of each.
  std::string out = fmt::format("{}: {}\n", m.name, m.title);
  out += property("density", Table(m.density), "kg/m3");
  // With flow curves the flow stress is told by them alone.
  const bool curves = m.flow && !m.flow->curves.empty();
  for (const material::Property& p : m.properties())
    if (!curves || p.table != &m.flow->flow_stress) out += property(p.name, *p.table, p.unit);
  if (m.mechanical())
    out += fmt::format("  {:<29} {}\n", "expansion_reference", celsius(m.expansion_reference));
  if (m.flow) out += plasticity(*m.flow);
  if (curves) out += flow_curves(m.flow->curves);
  // The law of the melt matters only where the material has one for the solid.
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
  // Where every number comes from, and over which temperatures it was measured.
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
    const std::optional<material::Spread>& spread = of.*row.spread;
    if (!spread) continue;
    const std::string origin = !spread->estimate        ? spread->source
                               : spread->source.empty() ? "estimate"
                                                        : "estimate: " + spread->source;
    out += fmt::format("  {:<29} {:<15} {}\n", row.key, material::spread_text(*spread), origin);
  }
  return out.empty() ? "" : "Spread: half the width that holds 95 %\n" + out;
}

CLI::App* add_material_import(CLI::App& materials, MaterialImportArguments& arguments) {
  CLI::App* verb = materials.add_subcommand(
      "import",
      "Make a material card from a table of Thermo-Calc, JMatPro or pycalphad's Scheil (CSV or JSON)");
  verb->add_option("FILE", arguments.file, "The table")->required();
  verb->add_option("-o,--output", arguments.output, "The material file to write; default: print it");
  verb->add_option("--like", arguments.like, "A card for what the table lacks");
  verb->add_option("--title", arguments.title, "What the material is, in one line");
  verb->add_option("--source", arguments.source, "Where the table comes from; default: its name");
  verb->add_option("--latent-heat", arguments.latent_heat,
                   "For example \"390 kJ/kg\", for tables without enthalpy");
  verb->add_option("--volume-change", arguments.volume_change, "On freezing, for example -0.045");
  verb->add_option("--molar-mass", arguments.molar_mass, "For example \"27.1 g/mol\", for columns per mole");
  verb->add_option("--column", arguments.columns,
                   "Which column holds what: QUANTITY=HEADER or QUANTITY=HEADER:UNIT, "
                   "for example \"enthalpy=HMR:J/mol\"")
      ->allow_extra_args(false);
  return verb;
}

CLI::App* add_solidification(CLI::App& materials, SolidificationArguments& arguments) {
  CLI::App* verb = materials.add_subcommand(
      "scheil", "Print the solid fraction of an alloy by Scheil's equation or the lever rule");
  verb->add_option("ALLOY", arguments.alloy, "Weight per cent, for example Al-9Si-3Cu-0.3Mg")->required();
  verb->add_flag("--lever", arguments.lever, "The lever rule: full diffusion in the solid");
  verb->add_option("--system", arguments.system, "A file with the liquidus; default: that of the library");
  verb->add_option("--tolerance", arguments.tolerance,
                   "Of the straight lines between the points; default 0.002");
  verb->add_option("-o,--output", arguments.output, "A file; default: print it");
  return verb;
}

/// @param name   a material of the library or a file; empty: the list
/// @param output a folder for its tables (CSV); empty: none
ExitCode list_materials(const std::string& name, const std::string& output) {
  const auto folders = cases::material_folders();
  // One material in full, or the names of all.
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

class Materials final : public Verb {
 public:
  explicit Materials(CLI::App& program)
      : Verb(program, "materials", "List the material library, or print one material") {
    command().add_option("NAME", name_, "A material of the library, or a material file");
    command()
        .add_option("-o,--output", output_, "Folder for tables of the properties and the flow curves (CSV)")
        ->type_name("FOLDER");
    import_ = add_material_import(command(), imported_);
    scheil_ = add_solidification(command(), freezing_);
  }
  ExitCode run() override {
    if (import_->parsed()) return import_material(imported_);
    if (scheil_->parsed()) return solidification_path(freezing_);
    return list_materials(name_, output_);
  }

 private:
  std::string name_, output_;
  MaterialImportArguments imported_;
  SolidificationArguments freezing_;
  CLI::App *import_ = nullptr, *scheil_ = nullptr;
};

}  // namespace

std::unique_ptr<Verb> materials_verb(CLI::App& program) {
  return std::make_unique<Materials>(program);
}

}  // namespace solidus::app
