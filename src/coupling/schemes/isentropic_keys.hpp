/// The isentropic split (coupling/isentropic_split.hpp) as the key scheme knows it.
#pragma once

#include "coupling/isentropic_split.hpp"
#include "coupling/schemes/sequential.hpp"

namespace solidus::coupling {

struct IsentropicScheme : SequentialScheme {
  static constexpr std::string_view name = "isentropic";
  static constexpr std::string_view doc =
      "mechanical phase at fixed entropy of every point, thermal phase at fixed configuration: stable "
      "however strongly deformation and heat are coupled";
  static void keys(Section<IsentropicScheme>& s) { declare(s); }

  SchemeTraits traits() const { return {.mapping = mechanics::Mapping::isentropic, .leaves_stepping = true}; }
  std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext& c) const {
    return std::make_unique<IsentropicSplit>(phases, options_in(c));
  }
};

}  // namespace solidus::coupling
