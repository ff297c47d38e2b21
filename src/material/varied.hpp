/// The data of a material that may be varied as a whole: a factor on a property multiplies its whole table, a
/// shift moves the temperatures of all phase changes. One row a property gives the keys of [spread] of a
/// material card, those of [vary.body.NAME] of a case, and what `solidus uncertain` may vary.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "material/material.hpp"
#include "material/spread.hpp"

namespace solidus::material {

/// Factors and shifts; as they are here they change nothing.
struct MaterialFactors {
  double density = 1, conductivity = 1, specific_heat = 1, latent_heat = 1, volume_change = 1,
         young_modulus = 1, poisson_ratio = 1, expansion = 1, strength = 1, creep_viscosity = 1,
         arm_spacing = 1, melt_viscosity = 1;
  double freezing_temperatures = 0;  ///< [K]
};

/// The spreads on a card, absent where it has none.
struct MaterialSpreads {
  std::optional<Spread> density, conductivity, specific_heat, latent_heat, volume_change, young_modulus,
      poisson_ratio, expansion, strength, creep_viscosity, arm_spacing, melt_viscosity, freezing_temperatures;
};

struct VariedProperty {
  const char* key;
  const char* name;  ///< for people, "latent heat"
  const char* doc;
  double MaterialFactors::*factor;
  std::optional<Spread> MaterialSpreads::*spread;
  bool shift;                    ///< a temperature: added, not multiplied
  Spread usual;                  ///< where the card has none
  bool (*has)(const Material&);  ///< whether the material has it
  void (*apply)(Material&, double);
};

/// In the order of the keys.
std::span<const VariedProperty> varied_properties();

/// Keys of [spread] in a material file.
Section<MaterialSpreads> material_spread_keys();

/// Changes a material. Throws InputError for what no material can be, such as a Poisson's ratio of one half.
void vary(Material& material, const MaterialFactors& factors, const SourceLocation& where);

/// The spreads on the card that find_material() reads. Throws InputError as it does.
MaterialSpreads find_spreads(const std::string& reference, std::span<const std::filesystem::path> library,
                             const SourceLocation& where = {});

/// Checks the spreads of a card: each well formed, and of a property that the card has. Those that come from
/// another card (`like`) for a property that this one has not are dropped.
/// @param file  the card itself
void check_spreads(MaterialSpreads& spreads, const Material& material, const std::string& file);

}  // namespace solidus::material
