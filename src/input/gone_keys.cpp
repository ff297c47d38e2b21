/// The list of keys that are gone, by section.
#include "input/gone_keys.hpp"

#include <array>

namespace solidus {

namespace {

constexpr std::string_view k_stress_instead =
    "[body.initial_stress] with the file of another run, or a [[stage]] before the one that matters";

constexpr std::array k_missing = {
    MissingKey{"heat", "exact_conductivity", "is gone",
               "leave it out: conduction is that of the conductivity's integral over the temperature, whose "
               "tangent is exact"},
    MissingKey{"body", "residual_stress", "is not there", k_stress_instead},
    MissingKey{"body", "prestress", "is not there", k_stress_instead},
};

}  // namespace

std::optional<MissingKey> missing_key(std::string_view section, std::string_view key) {
  for (const MissingKey& missing : k_missing)
    if (missing.section == section && missing.key == key) return missing;
  return std::nullopt;
}

}  // namespace solidus
