/// The titles of charts, in one switch; a chart without a title is a warning of the compiler.
#include "quantities/column.hpp"

namespace solidus::quantities {

std::string_view name(Chart chart) {
  switch (chart) {
    case Chart::of_unit:
      return "";
    case Chart::heat:
      return "Heat";
    case Chart::mechanical_energies:
      return "Mechanical energies";
    case Chart::energy_imbalance:
      return "Energy imbalance";
    case Chart::stability:
      return "Functional 𝓛 of stability";
    case Chart::stability_of_phases:
      return "Change of 𝓛 in a step, by phase";
    case Chart::entropy:
      return "Entropy";
    case Chart::step:
      return "Step";
    case Chart::iterations:
      return "Iterations per step";
    case Chart::seconds:
      return "Computing time per step";
    case Chart::freezing_of_shots:
      return "From the pour to the last melt";
    case Chart::die_of_shots:
      return "The die when a shot begins";
  }
  return {};
}

}  // namespace solidus::quantities
