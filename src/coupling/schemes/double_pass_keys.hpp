/// The double pass (coupling/double_pass.hpp) as the key scheme knows it.
#pragma once

#include "coupling/add_scheme.hpp"
#include "coupling/double_pass.hpp"
#include "coupling/schemes/thermal_flow_key.hpp"

namespace solidus::coupling {

struct DoublePassScheme {
  static constexpr std::string_view name = "double_pass";
  static constexpr std::string_view doc =
      "split of second order: half a mechanical phase, thermal phase, half a mechanical phase (4.21)";

  enum class Passes { isentropic, isothermal };
  Passes passes = Passes::isentropic;
  ThermalFlow flow = ThermalFlow::kept;

  static void keys(Section<DoublePassScheme>& s) {
    s.choice("passes", &DoublePassScheme::passes,
             {{"isentropic", Passes::isentropic, "the mechanical phase holds the entropy of every point"},
              {"isothermal", Passes::isothermal,
               "it holds the temperature that follows from its own deformation, found in a few iterations; "
               "for weak coupling only"}})
        .initially("isentropic")
        .doc("Which split the double pass is made of.");
    declare_thermal_flow(s, &DoublePassScheme::flow);
  }
  SchemeTraits traits() const {
    const bool isothermal = passes == Passes::isothermal;
    return {.mapping = isothermal ? mechanics::Mapping::isothermal : mechanics::Mapping::isentropic,
            .second_order = true,
            .needs_weak_coupling = isothermal,
            .effort = isothermal ? 6.0 : 2.0};
  }
  std::optional<Objection> objection(const SchemeContext& c) const {
    if (c.as_printed)
      return Objection{
          "printed forms of sensible heat go with backward Euler, the double pass has two stages",
          "as_printed = false, or scheme = \"isentropic\" or \"isothermal\""};
    if (c.slides_in_heat)
      return Objection{
          "thermal_return_mapping: the double pass counts the heat of friction of its first half twice and "
          "knows no slip that its thermal phase finds",
          "scheme = \"isentropic\", \"isothermal\" or \"simultaneous\", or no such key"};
    return std::nullopt;
  }
  std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext&) const {
    return std::make_unique<DoublePass>(phases, flow);
  }
};

}  // namespace solidus::coupling
