/// Material files: TOML with a unit, a source and a validity range for every property (docs/reference from
/// the declared keys).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "input/keys.hpp"
#include "material/cards/flow_keys.hpp"
#include "material/external_law.hpp"
#include "material/granular_data.hpp"
#include "material/local_law.hpp"
#include "material/material.hpp"
#include "material/varied.hpp"

namespace solidus::material {

class FractionLaw;  // laws/fraction_law.hpp

/// The keys of [phase_change.fraction].
struct FractionData {
  std::shared_ptr<const FractionLaw> law;
  SourceLocation where;
};

/// The keys of [[phase_change]].
struct PhaseChangeData {
  std::string name;
  FractionData fraction;
  double latent_heat = 0;  ///< [J/kg]
  double volume_change = 0;
  bool graphite = false;  ///< its volume_change comes of [graphite]
  bool solidification = false;
  std::string source;
  SourceLocation where;
};

/// The meanings of the values of `expansion` in a material file. Material::expansion is always the mean.
enum class ExpansionAs {
  mean,          ///< e(Θ)/(Θ − Θ_ref), the secant of the curve of thermal strain
  instantaneous  ///< de/dΘ, its tangent
};

/// The keys of a material file, as read and in SI.
struct MaterialData {
  std::string title, like;
  std::vector<std::string> designations;
  Function density, conductivity, specific_heat;
  SpecificHeatAt specific_heat_at = SpecificHeatAt::constant_pressure;
  std::vector<PhaseChangeData> phase_changes;
  std::optional<Function> young_modulus, poisson_ratio, expansion, twice_shear_viscosity;
  ExpansionAs expansion_as = ExpansionAs::mean;
  double expansion_reference = 0;  ///< [K]
  LiquidModel liquid_model = LiquidModel::maxwell;
  std::map<std::string, Function> liquid_numbers;  ///< the parameters of the models of the liquid
  std::map<std::string, Function> added;           ///< material/added_property.hpp
  std::optional<FlowData> plasticity;
  std::optional<ExternalData> external;
  std::optional<GranularData> granular;
  Casting casting;
  std::optional<Gas> gas;
  std::optional<Graphite> graphite;
  std::vector<LocalLaw> local_laws;
  MaterialSpreads spread;
  SourceLocation where;
};

/// The declaration of the keys, for reading, `explain`, the schema and the manual.
const Section<MaterialData>& material_section();

/// Checks the values that depend on several keys and builds the material. Throws InputError with the place.
Material make_material(std::string name, const MaterialData& data);

/// The mean coefficients of expansion from a reference temperature that instantaneous ones lead to:
/// ∫_Θref^Θ α dΘ/(Θ − Θ_ref), at points so close that lines between them do.
Table mean_expansion(const Table& instantaneous, double reference);

/// Returns the note on a property for the report of a run.
PropertyNote note_of(std::string property, const Function& function);

/// Reads a material file; its name is the file's name without ".toml". A file with `like = "other"` takes
/// from the other material every key that it does not give itself; within a section ([plasticity]) too,
/// unless the key belongs to a kind (hardening = "power") that the file has changed.
/// @param library  folders where `like` finds materials by name
/// Throws InputError with file, line and column.
Material load_material(const std::filesystem::path& file,
                       std::span<const std::filesystem::path> library = {});

/// The material that the user names: a name in the library, or a file (anything with ".toml" at its end)
/// relative to the file that names it. The first folder of the library that has the name wins.
/// @param where  the place of the name in the user's input
/// Throws InputError when there is none, with the materials that the name designates ("A356") or the nearest
/// name.
Material find_material(const std::string& reference, std::span<const std::filesystem::path> library,
                       const SourceLocation& where = {});

/// All names in the library, sorted.
std::vector<std::string> material_names(std::span<const std::filesystem::path> library);

/// A property that was used at temperatures for which its data do not hold.
struct LeftRange {
  std::string property;
  double valid_from, valid_to;  ///< [K]
  bool refused;                 ///< its table has extrapolation = "error": the run must stop
};

/// The properties whose range the temperatures [coldest, hottest] of a run leave [K]: the stated validity,
/// or, where the table refuses to continue, its points.
std::vector<LeftRange> left_ranges(const Material& material, double coldest, double hottest);

}  // namespace solidus::material
