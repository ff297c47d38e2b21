/// The common description of the isentropic and the isothermal split: both solve the phases one after the
/// other, in an order (sequential_split.hpp).
#pragma once

#include "coupling/add_scheme.hpp"
#include "coupling/schemes/thermal_flow_key.hpp"
#include "coupling/sequential_split.hpp"

namespace solidus::coupling {

struct SequentialScheme {
  std::optional<PhaseOrder> order;  ///< absent: order_in() chooses
  ThermalFlow flow = ThermalFlow::kept;
  std::optional<double> gap_tolerance;  ///< absent: k_gap_tolerance

  static constexpr double k_gap_tolerance = 0.02;

  /// As the case says, or heat first unless friction between bodies that neither melt nor yield or with its
  /// printed thermal phase, inertia or a printed form of structural heat forbids it.
  PhaseOrder order_in(const SchemeContext& c) const {
    if (order) return *order;
    return (c.rubs && !c.keeps_strain) || c.slides_in_heat || c.as_printed || c.printed_form() || c.inertia
               ? PhaseOrder::mechanics_first
               : PhaseOrder::heat_first;
  }
  SequentialOptions options_in(const SchemeContext& c) const {
    return {.order = order_in(c), .flow = flow, .gap_tolerance = gap_tolerance.value_or(k_gap_tolerance)};
  }
  bool lags_a_step(const SchemeContext& c) const {
    return !c.inertia && order_in(c) == PhaseOrder::mechanics_first;
  }
  std::optional<Objection> objection(const SchemeContext& c) const {
    if (order == PhaseOrder::heat_first && c.printed_form())
      return Objection{"printed forms of structural heat count from a mechanical phase that comes first",
                       "order = \"mechanics_first\", or structural_heating \"energy\" or \"entropy\""};
    if (gap_tolerance && order_in(c) == PhaseOrder::mechanics_first)
      return Objection{"gap_tolerance belongs to steps that conduct heat before they solve deformation",
                       "order = \"heat_first\", or no gap_tolerance"};
    if (c.slides_in_heat && order_in(c) == PhaseOrder::heat_first)
      return Objection{
          "thermal_return_mapping with heat first: slip would be found again where no heat flows, at the "
          "temperature of an interface that keeps the heat of its friction",
          "order = \"mechanics_first\", thermal_return_mapping = false, or a scheme whose fields agree"};
    return std::nullopt;
  }

 protected:
  template <class Scheme>
  static void declare(Section<Scheme>& s) {
    s.choice(
         "order", static_cast<std::optional<PhaseOrder> Scheme::*>(&SequentialScheme::order),
         {{"automatic", std::nullopt,
           "heat_first; but mechanics_first with inertia, with thermal_return_mapping, with printed forms of "
           "structural heat, and with friction where nothing gets hot enough to melt and nothing yields "
           "while temperatures differ (the heat of friction is then conducted in the step that makes it)"},
          {"heat_first", PhaseOrder::heat_first,
           "displacements and stresses belong to the temperatures of the step's end; the heat of deformation "
           "and friction is conducted in the next step"},
          {"mechanics_first", PhaseOrder::mechanics_first,
           "as printed (4.40 - 4.54): displacements and stresses belong to the temperatures of the step's "
           "start"}})
        .initially("automatic")
        .doc("Which phase of the isentropic and of the isothermal split comes first in a step.");
    declare_thermal_flow(s, &SequentialScheme::flow);
    s.key("gap_tolerance", static_cast<std::optional<double> Scheme::*>(&SequentialScheme::gap_tolerance))
        .range(0.0, 1.0)
        .doc(
            "With heat first: fraction of the heat through interfaces that may be wrong because the gaps "
            "differ from those extrapolated from the step before. Where the fraction is larger, the step is "
            "solved again, with the mean of the gaps at its start and end, three times at most. Without it "
            "0.02; 1: no step is solved again, and heat passes through the gaps of the step's start.");
  }
};

}  // namespace solidus::coupling
