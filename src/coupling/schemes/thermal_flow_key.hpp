/// The key of a split for plastic flow in its thermal phase.
#pragma once

#include "coupling/thermal_flow.hpp"
#include "input/keys.hpp"

namespace solidus::coupling {

/// Declares this key of [coupling] for a scheme's options.
template <class Scheme, class Options>
void declare_thermal_flow(Section<Scheme>& s, ThermalFlow Options::*flow) {
  s.choice("thermal_flow", static_cast<ThermalFlow Scheme::*>(flow),
           {{"kept", ThermalFlow::kept,
             "as the mechanical phase has found it: stress and flow stay in equilibrium"},
            {"restarted", ThermalFlow::restarted,
             "as printed (4.45, 4.49, 4.54): the return mapping of solid metal is repeated from the internal "
             "variables of the step's start at the temperatures of its end, and the results show its stress "
             "and flow; liquid and mushy metal keep the flow of the mechanical phase"}})
      .initially("kept")
      .doc(
          "Plastic flow in the thermal phase of the isentropic and the isothermal split and of the double "
          "pass.");
}

}  // namespace solidus::coupling
