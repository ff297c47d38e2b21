/// The place of a parameter among those of a law of isotropic hardening, by its key: a test that does not
/// name the law's type is not compiled again when the law changes.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "material/laws/hardening_law.hpp"

namespace solidus::material::test {

inline std::size_t hardening_parameter(IsotropicHardening kind, std::string_view key) {
  const auto parameters = hardening_law(kind).parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].key == key) return i;
  throw std::logic_error("no parameter " + std::string(key));
}

}  // namespace solidus::material::test
