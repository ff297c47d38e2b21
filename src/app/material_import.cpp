/// The verbs `materials import` and `materials scheil`.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "app/case_arguments.hpp"
#include "app/material_import.hpp"
#include "cases/case_materials.hpp"
#include "input/column_table.hpp"
#include "input/units.hpp"
#include "material/cards/card_import.hpp"
#include "material/cards/library.hpp"
#include "material/liquidus_system.hpp"
#include "results/output/output_error.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

/// A quantity of the command line; empty: none.
std::optional<double> quantity(const std::string& text, const char* unit, const char* option) {
  if (text.empty()) return std::nullopt;
  try {
    return units::parse_quantity(text, unit);
  } catch (const std::invalid_argument& error) {
    throw InputError({}, fmt::format("{} {}: {}", option, text, error.what()));
  }
}

std::map<std::string, std::string> columns_of(const std::vector<std::string>& given) {
  std::map<std::string, std::string> columns;
  for (const std::string& text : given) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({}, fmt::format("--column {}: there is no '='", text),
                       "--column QUANTITY=HEADER, or QUANTITY=HEADER:UNIT, with QUANTITY " +
                           one_of(material::import_quantities()));
    columns[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return columns;
}

void write_text(const fs::path& file, const std::string& text) {
  results::on_first_process([&] {
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out) throw results::OutputError(file.string(), "cannot write");
  });
}

}  // namespace

ExitCode import_material(const MaterialImportArguments& arguments) {
  // Options come first, with their units converted, and the material that the new card is like.
  const auto folders = cases::material_folders();
  material::ImportOptions options;
  options.columns = columns_of(arguments.columns);
  options.title = arguments.title;
  options.source = arguments.source;
  options.like = arguments.like;
  options.latent_heat = quantity(arguments.latent_heat, "J/kg", "--latent-heat");
  options.volume_change = quantity(arguments.volume_change, "1", "--volume-change");
  options.molar_mass = quantity(arguments.molar_mass, "kg/mol", "--molar-mass");
  std::optional<material::Material> base;
  if (!arguments.like.empty()) base = material::find_material(arguments.like, folders);

  // The card goes to the terminal, or to a file, which is then read as a run would read it: what is wrong
  // with it is reported now.
  const material::ImportedCard card =
      material::import_card(read_column_table(arguments.file), options, base ? &*base : nullptr);
  const std::string text = to_toml(card.document);
  if (arguments.output.empty()) {
    std::string said;
    for (const std::string& remark : card.remarks) said += "# " + remark + "\n";
    print(said + text);
    return k_done;
  }
  write_text(arguments.output, text);
  const material::Material check =
      material::load_material(arguments.output, folders);  // as a run will read it
  std::string said = fmt::format("Written to {}: freezes from {:.6g} to {:.6g} degC\n", arguments.output,
                                 units::to_display(check.solidification()->fraction.liquidus(), "K", "degC"),
                                 units::to_display(check.solidification()->fraction.solidus(), "K", "degC"));
  for (const std::string& remark : card.remarks) said += "  " + remark + "\n";
  print(said);
  return k_done;
}

ExitCode solidification_path(const SolidificationArguments& arguments) {
  // The system of the solvent is looked up in the library, or read from a file; it has to be that of the
  // alloy.
  const material::Composition alloy = material::parse_composition(arguments.alloy);
  const material::LiquidusSystem system =
      arguments.system.empty() ? material::find_liquidus_system(alloy.solvent, cases::material_folders())
                               : material::load_liquidus_system(arguments.system);
  if (system.solvent != alloy.solvent)
    throw InputError(system.where,
                     fmt::format("the system is of {}, the alloy of {}", system.solvent, alloy.solvent));
  if (!(arguments.tolerance > 0 && arguments.tolerance <= 0.1))
    throw InputError({}, fmt::format("--tolerance {}", arguments.tolerance), "above 0 and at most 0.1");
  const auto rule =
      arguments.lever ? material::SolidificationRule::lever_rule : material::SolidificationRule::scheil;
  const material::SolidificationPath path =
      material::solidification_path(system, alloy, rule, arguments.tolerance);
  const auto celsius = [](double t) { return units::to_display(t, "K", "degC"); };

  // The text can be put into a card as it is: remarks are comments, temperatures rise as the key asks.
  std::string text =
      fmt::format("# {} by {}: liquidus {:.1f} degC, {:.1f} % primary solid down to {:.1f} degC, ",
                  arguments.alloy, arguments.lever ? "the lever rule" : "Scheil's equation",
                  celsius(path.liquidus), 100 * path.primary_fraction, celsius(path.primary_end));
  text += path.last_fraction > 0
              ? fmt::format("the last {:.2f} % at {:.1f} degC\n", 100 * path.last_fraction, celsius(path.end))
              : fmt::format("solid at {:.1f} degC\n", celsius(path.end));
  for (const std::string& remark : path.remarks) text += "# " + remark + "\n";
  text += "[phase_change.fraction]\nkind = \"table\"\ntemperatures = [";
  for (auto p = path.points.rbegin(); p != path.points.rend(); ++p)
    text += fmt::format("{}\"{:.2f} degC\"", p == path.points.rbegin() ? "" : ", ", celsius(p->first));
  text += "]\nfractions = [";
  for (auto p = path.points.rbegin(); p != path.points.rend(); ++p)
    text += fmt::format("{}{:.5g}", p == path.points.rbegin() ? "" : ", ", p->second);
  text += "]\n";
  if (arguments.output.empty()) {
    print(text);
  } else {
    write_text(arguments.output, text);
    print(fmt::format("Written to {}\n", arguments.output));
  }
  return k_done;
}

}  // namespace solidus::app
