/// The double pass (coupling/double_pass.hpp) as the key scheme knows it.
#pragma once

#include "coupling/add_scheme.hpp"
#include "coupling/double_pass.hpp"

namespace solidus::coupling {

struct DoublePassScheme {
  static constexpr std::string_view name = "double_pass";
  static constexpr std::string_view doc =
      "isentropic split of second order: half a mechanical phase, thermal phase, half a mechanical "
      "phase";

  SchemeTraits traits() const {
    return {.mapping = mechanics::Mapping::isentropic, .second_order = true, .effort = 2};
  }
  std::optional<Objection> objection(const SchemeContext& c) const {
    if (c.inertia)
      return Objection{"the double pass is for quasi-statics",
                       "scheme = \"isentropic\", \"simultaneous\" or \"isothermal\""};
    if (c.heating != mechanics::StructuralForm::energy)
      return Objection{"temperature x difference of entropy is of first order, the double pass of second",
                       "structural_heating = \"energy\""};
    if (c.slides_in_heat)
      return Objection{
          "thermal_return_mapping: the double pass counts the heat of friction of its first half twice and "
          "knows no slip that its thermal phase finds",
          "scheme = \"isentropic\", \"isothermal\" or \"simultaneous\", or no such key"};
    return std::nullopt;
  }
  std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext&) const {
    return std::make_unique<DoublePass>(phases);
  }
};

}  // namespace solidus::coupling
