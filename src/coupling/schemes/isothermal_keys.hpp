/// The isothermal split (coupling/isothermal_split.hpp) as the key scheme knows it.
#pragma once

#include "coupling/isothermal_split.hpp"
#include "coupling/schemes/sequential.hpp"

namespace solidus::coupling {

struct IsothermalScheme : SequentialScheme {
  static constexpr std::string_view name = "isothermal";
  static constexpr std::string_view doc =
      "mechanical phase at fixed temperature, thermal phase at fixed configuration";
  static void keys(Section<IsothermalScheme>& s) { declare(s); }

  SchemeTraits traits() const {
    return {.mapping = mechanics::Mapping::isothermal,
            .leaves_stepping = true,
            .printed_forms = true,
            .needs_weak_coupling = true};
  }
  std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext& c) const {
    return std::make_unique<IsothermalSplit>(phases, options_in(c));
  }
};

}  // namespace solidus::coupling
