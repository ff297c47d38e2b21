/// A card is loaded in steps: find the file, join it with the card that it is like, assign by the declared
/// keys, build the material, and check what keys alone cannot.
#include "material/cards/library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "input/document.hpp"
#include "material/added_property.hpp"
#include "material/cards/designations.hpp"
#include "material/cards/external_keys.hpp"
#include "material/cards/granular_keys.hpp"
#include "material/elasticity.hpp"
#include "material/laws/fraction_law.hpp"
#include "material/laws/liquid_law.hpp"

namespace solidus::material {
namespace {

namespace fs = std::filesystem;

/// The change of volume that a file gives or that comes of its [graphite].
double volume_change_of(const Material& material, const PhaseChangeData& data) {
  if (!data.graphite) return data.volume_change;
  if (!material.graphite)
    throw InputError(data.where,
                     "the phase change '" + data.name + "' is graphite, and there is no [graphite]",
                     "carbon and silicon there, or volume_change here without graphite = true");
  if (data.volume_change != 0)
    throw InputError(data.where, "the volume_change of '" + data.name + "' comes of [graphite]",
                     "leave one of them out");
  return material.graphite->volume_change();
}

void add_phase_change(Material& material, const PhaseChangeData& data) {
  // Names are unique, and one change at most is the solidification.
  for (const PhaseChange& other : material.phase_changes) {
    if (other.name == data.name)
      throw InputError(data.where, "there are two phase changes named '" + data.name + "'");
    if (other.solidification && data.solidification)
      throw InputError(
          data.where,
          "the phase changes '" + other.name + "' and '" + data.name + "' are both the solidification",
          "at most one has solidification = true");
  }
  // The law of the fraction throws where its parameters do not make a curve; the message gets its
  // place here.
  try {
    material.phase_changes.push_back({data.name, data.fraction.law->curve(), data.latent_heat,
                                      volume_change_of(material, data), data.solidification, data.graphite});
  } catch (const std::invalid_argument& error) {
    throw InputError(data.fraction.where,
                     "the fraction of the phase change '" + data.name + "': " + error.what());
  }
  material.notes.push_back({data.name, data.source, 0, 0});
}

/// False for a key of a kind that the table does not have.
bool belongs(const Key& key, const Value& table) {
  if (key.when_key.empty()) return true;
  const Value* kind = table.find(key.when_key);
  if (kind == nullptr || !kind->is_text()) return true;
  return std::find(key.when_values.begin(), key.when_values.end(), kind->text()) != key.when_values.end();
}

/// Sections of which one is the law of the solid.
constexpr std::array<std::string_view, 3> k_laws{"plasticity", "external", "granular"};
bool is_law(std::string_view key) {
  return std::find(k_laws.begin(), k_laws.end(), key) != k_laws.end();
}
bool gives_another_law(const Value& given, std::string_view key) {
  return std::any_of(k_laws.begin(), k_laws.end(), [&](std::string_view law) {
    return law != key && given.find(std::string(law)) != nullptr;
  });
}

/// The keys of `base` that `own` lacks, added to it; in sections too, unless they are written { inline }.
void inherit(Value& own, const Value& base, const SectionInfo& keys) {
  const Value given = own;  // the kinds that the file itself has chosen
  for (const auto& entry : base.entries()) {
    const Key* key = keys.find(entry.key);
    if (is_law(entry.key) && gives_another_law(given, entry.key)) continue;
    if (entry.key == "designations") continue;  // a material that is like another has not its name
    Value* mine = own.find(entry.key);
    if (mine == nullptr) {
      if (key == nullptr || belongs(*key, given)) own.set(entry.key, entry.value);
    } else if (key != nullptr && key->kind == Key::Kind::section && mine->is_table() &&
               !mine->written_inline && entry.value.is_table()) {
      inherit(*mine, entry.value, *key->section);
    }
  }
}

bool names_a_file(const std::string& reference) {
  return fs::path(reference).extension() == ".toml";
}

fs::path locate(const std::string& reference, std::span<const fs::path> library,
                const SourceLocation& where) {
  std::error_code unreadable;
  // A file counts from the one that names it; a name is looked for in the folders, one after the other.
  if (names_a_file(reference)) {
    const fs::path file = fs::path(where.file).parent_path() / reference;
    if (!fs::exists(file, unreadable))
      throw InputError(where, "there is no material file '" + file.string() + "'");
    return file;
  }
  for (const fs::path& place : library)
    if (const fs::path file = place / (reference + ".toml"); fs::exists(file, unreadable)) return file;
  throw InputError(where, "there is no material '" + reference + "'",
                   materials_meant(reference, material_names(library), library));
}

/// The document of a file with the values that it inherits.
Value load_with_base(const fs::path& file, std::span<const fs::path> library, int depth) {
  Value document = load_document(file);
  const Value* like = document.find("like");
  if (like == nullptr || !like->is_text() || like->text().empty()) return document;
  if (depth == 0)
    throw InputError(like->where, "the material is like one that is like another, and so on without end");
  const fs::path base = locate(like->text(), library, like->where);
  inherit(document, load_with_base(base, library, depth - 1), material_section().info());
  return document;
}

// A model of the liquid brings its own parameters, in its own order.
void add_liquid_model(Material& m, const MaterialData& data) {
  m.liquid_model = data.liquid_model;
  const auto parameters = liquid_law(m.liquid_model).parameters();
  // Each parameter is given, or has a default, or is missing.
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto given = data.liquid_numbers.find(parameters[i].key);
    if (given != data.liquid_numbers.end()) {
      m.liquid_numbers[i] = given->second.table.value(0);
      m.notes.push_back(note_of(parameters[i].key, given->second));
    } else if (parameters[i].optional) {
      m.liquid_numbers[i] = parameters[i].left_out;
    } else {
      throw InputError(data.where, fmt::format("the key '{}' is missing", parameters[i].key),
                       fmt::format("liquid_model = \"{}\" needs it", liquid_law(m.liquid_model).name()));
    }
  }
}

void check_liquid_model(const Material& m, const MaterialData& data) {
  if (m.liquid_model == LiquidModel::maxwell) return;
  // The models that carry stress in the mush need to know how much of it is solid, and a rate.
  const LiquidLaw& law = liquid_law(m.liquid_model);
  if (m.solidification() == nullptr)
    throw InputError(data.where,
                     fmt::format("liquid_model = \"{}\", but '{}' does not solidify", law.name(), m.name),
                     "a [[phase_change]] with solidification = true");
  if (law.needs_rate() && (!m.flow || m.flow->rate_independent()))
    throw InputError(
        data.where,
        fmt::format("liquid_model = \"{}\", but the flow of '{}' does not depend on the rate: the liquid "
                    "would have no viscosity",
                    law.name(), m.name),
        "[plasticity] with rate_dependence = \"perzyna\"");
}

/// C_v = C_p − 9 α² k Θ must be positive, α the slope of the expansion: no material stores less at fixed
/// strain than nothing. A change of volume in a narrow range belongs to a phase change, whose straining is
/// held in a step.
void check_heat_of_expansion(const Material& m, const MaterialData& data) {
  if (!m.mechanical() || m.specific_heat_at == SpecificHeatAt::constant_strain) return;
  const PhaseChange* const freezing = m.solidification();
  std::vector<double> points{k_zero_celsius + 20, freezing != nullptr ? freezing->fraction.solidus() : 0.0};
  for (const Table* table : {&m.young_modulus, &m.poisson_ratio, &m.expansion, &m.specific_heat})
    points.insert(points.end(), table->x().begin(), table->x().end());
  for (const double at : points) {
    if (!(at > 0)) continue;
    for (const double temperature : {at * (1 - 1e-9), at * (1 + 1e-9)}) {
      const auto p = properties_at(m, temperature, temperature, PhaseState<double>{1.0, 0.0});
      const double slope = expansion_slope(m, temperature);
      const double expansion = p.bulk * slope * slope * temperature / m.density,
                   measured = m.specific_heat.value(temperature);
      if (expansion < measured) continue;
      throw InputError(
          data.where,
          fmt::format(
              "the specific heat of '{}', at constant pressure as the key has it, {:.4g} J/kg/K at {:.4g} "
              "degC, is less than what expansion "
              "against its stiffness takes up there, {:.4g} J/kg/K (9 alpha^2 k T/rho)",
              m.name, measured, temperature - k_zero_celsius, expansion),
          "usual are 1 to 8 %: look at the units of expansion and young_modulus; a change of volume in a "
          "narrow "
          "range of temperature is a [[phase_change]] with a volume_change, no steep piece of expansion; "
          "what is "
          "nearly incompressible takes specific_heat_at = \"constant_strain\"");
    }
  }
}

void add_casting(Material& m, const MaterialData& data) {
  // The ranges of the solid fraction must follow each other: coherency, then the brittle range.
  const Casting& casting = data.casting;
  if (!(casting.brittle_range[0] < casting.brittle_range[1]))
    throw InputError(data.where, "the brittle_range of '" + m.name + "' does not rise",
                     "two solid fractions, the lower one first");
  if (casting.coherency_fraction > casting.brittle_range[0])
    throw InputError(data.where,
                     "the brittle_range of '" + m.name +
                         "' begins below its coherency_fraction: what is not "
                         "coherent takes no strain",
                     "coherency_fraction at most the first number of brittle_range");
  m.casting = casting;
  if (!casting.source.empty()) m.notes.push_back({"casting", casting.source, 0, 0});
}

// Adds the properties of the card that their users declare, with the note of each.
void add_added(Material& m, const MaterialData& data) {
  for (const AddedProperty& property : added_properties())
    if (const auto given = data.added.find(std::string(property.key)); given != data.added.end()) {
      m.added.emplace(given->first, GivenProperty{std::string(property.unit), given->second.table});
      m.notes.push_back(note_of(given->first, given->second));
    }
}

}  // namespace

PropertyNote note_of(std::string property, const Function& f) {
  return {std::move(property), f.source, f.valid ? (*f.valid)[0] : 0, f.valid ? (*f.valid)[1] : 0};
}

Table mean_expansion(const Table& instantaneous, double reference) {
  // Mean and instantaneous coefficients are the same where the coefficient does not change.
  if (instantaneous.constant()) return instantaneous;
  constexpr double k_close = 5, k_widest = 4000;  // [K]
  const std::span<const double> given = instantaneous.x();
  // Points of the mean: those of the table, and others so close that straight lines between them
  // do.
  std::vector<double> x{given.begin(), given.end()};
  for (std::size_t i = 1; i < given.size(); ++i) {
    const double width = given[i] - given[i - 1];
    const int n = static_cast<int>(std::ceil(width / k_close));
    for (int k = 1; k < n; ++k) x.push_back(given[i - 1] + width * k / n);
  }
  // A mean goes on changing where the coefficient itself stays what it is.
  if (instantaneous.extrapolation() != Extrapolation::error)
    for (double beyond = k_close; beyond < k_widest; beyond *= 1.3) {
      x.push_back(given.back() + beyond);
      if (given.front() - beyond > 0) x.push_back(given.front() - beyond);
    }
  std::sort(x.begin(), x.end());
  // At the reference temperature itself the mean is the limit, which is the coefficient there.
  std::vector<double> y;
  for (const double t : x)
    y.push_back(std::abs(t - reference) < 1e-6 * k_close
                    ? instantaneous.value(t)
                    : instantaneous.integral(reference, t) / (t - reference));
  return Table(std::move(x), std::move(y), instantaneous.extrapolation());
}

Material make_material(std::string name, const MaterialData& data) {
  // Names and what does not depend on other properties come first. A note is made of each table: where it
  // comes from and where it holds.
  Material m;
  m.name = std::move(name);
  m.title = data.title.empty() ? m.name : data.title;
  m.expansion_reference = data.expansion_reference;
  add_liquid_model(m, data);
  const auto note = [&m](const char* property, const Function& f) {
    m.notes.push_back(note_of(property, f));
    return f.table;
  };
  m.density = note("density", data.density).value(0);
  m.conductivity = note("conductivity", data.conductivity);
  m.specific_heat = note("specific_heat", data.specific_heat);
  m.specific_heat_at = data.specific_heat_at;
  m.graphite = data.graphite;
  m.gas = data.gas;
  for (const PhaseChangeData& change : data.phase_changes) add_phase_change(m, change);

  // Elastic properties come all or not at all: a material without them conducts heat only.
  const bool elastic[] = {data.young_modulus.has_value(), data.poisson_ratio.has_value(),
                          data.expansion.has_value()};
  if (std::count(std::begin(elastic), std::end(elastic), true) % 3 != 0)
    throw InputError(
        data.where, "the mechanical properties of '" + m.name + "' are incomplete",
        "young_modulus, poisson_ratio and expansion belong together; without all three the material conducts "
        "heat only");
  if (data.young_modulus) {
    m.young_modulus = note("young_modulus", *data.young_modulus);
    m.poisson_ratio = note("poisson_ratio", *data.poisson_ratio);
    m.expansion = note("expansion", *data.expansion);
    // Instantaneous coefficients are integrated to mean ones, which the program computes with.
    if (data.expansion_as == ExpansionAs::instantaneous)
      m.expansion = mean_expansion(m.expansion, m.expansion_reference);
  }
  // A melt has the viscosity of its card, or that which the program chooses.
  if (data.twice_shear_viscosity)
    m.liquid_viscosity = note("twice_shear_viscosity", *data.twice_shear_viscosity);
  else if (data.young_modulus && m.chooses_viscosity())
    m.notes.push_back(
        {"twice_shear_viscosity", "not given: chosen by the program for the body and the step", 0, 0});
  // Flow, criteria, gas, graphite, local properties and a law from outside follow, and at last the model of
  // the liquid is checked against all of them.
  if (data.plasticity) add_flow(m, *data.plasticity);
  add_casting(m, data);
  add_added(m, data);
  if (m.gas && !m.gas->source.empty()) m.notes.push_back({"gas", m.gas->source, 0, 0});
  if (m.graphite && !m.graphite->source.empty()) m.notes.push_back({"graphite", m.graphite->source, 0, 0});
  for (const LocalLaw& law : data.local_laws) {
    check_local_law(law);
    m.notes.push_back({"local", law.source, 0, 0});
  }
  if (data.external) add_external(m, *data.external);
  if (data.granular) add_granular(m, *data.granular);
  check_liquid_model(m, data);
  check_heat_of_expansion(m, data);
  return m;
}

namespace {

/// What a file says of a material: the material, and how well it is known.
struct Card {
  Material material;
  MaterialSpreads spreads;
  std::vector<LocalLaw> local_laws;
};

Card load_card(const fs::path& file, std::span<const fs::path> library) {
  constexpr int deepest = 8;  // more generations than anyone needs: a circle
  const Value document = load_with_base(file, library, deepest);
  MaterialData data = material_section().read(document);
  Material material = make_material(file.stem().string(), data);
  check_spreads(data.spread, material, file.string());
  return {std::move(material), std::move(data.spread), std::move(data.local_laws)};
}

}  // namespace

Material load_material(const fs::path& file, std::span<const fs::path> library) {
  return load_card(file, library).material;
}

MaterialSpreads find_spreads(const std::string& reference, std::span<const fs::path> library,
                             const SourceLocation& where) {
  return load_card(locate(reference, library, where), library).spreads;
}

std::vector<LocalLaw> find_local_laws(const std::string& reference, std::span<const fs::path> library,
                                      const SourceLocation& where) {
  return load_card(locate(reference, library, where), library).local_laws;
}

Material find_material(const std::string& reference, std::span<const fs::path> library,
                       const SourceLocation& where) {
  return load_material(locate(reference, library, where), library);
}

std::vector<std::string> material_names(std::span<const fs::path> library) {
  std::vector<std::string> names;
  for (const fs::path& folder : library) {
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(folder, unreadable))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<LeftRange> left_ranges(const Material& material, double coldest, double hottest) {
  std::vector<LeftRange> left;
  const std::vector<Property> properties = material.properties();
  const auto refused = [&](const std::string& name) {
    return std::any_of(properties.begin(), properties.end(), [&](const Property& p) {
      return name == p.name && (p.table->outside(coldest) || p.table->outside(hottest));
    });
  };
  // A table that refuses temperatures beyond its ends is named once, by its own range and not by that of its
  // source.
  for (const Property& p : properties)
    if (refused(p.name)) left.push_back({p.name, p.table->x().front(), p.table->x().back(), true});
  for (const PropertyNote& note : material.notes) {
    const bool stated = note.valid_to > note.valid_from;
    if (stated && (coldest < note.valid_from || hottest > note.valid_to) && !refused(note.property))
      left.push_back({note.property, note.valid_from, note.valid_to, false});
  }
  return left;
}

}  // namespace solidus::material
