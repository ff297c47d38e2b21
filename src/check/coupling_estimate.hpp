/// Estimate of the stability of the isothermal split for a case, before it runs (monograph 4.2.4;
/// docs/theory/coupling_stability.md, 5).
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "material/derivatives/coupling_number.hpp"
#include "mesh/mesh.hpp"
#include "setup/initial_temperature.hpp"

namespace solidus::check {

/// Estimate of one body.
struct CouplingEstimate {
  std::string body;
  SourceLocation where;           ///< of the body in the case file
  double initial = 0, worst = 0;  ///< temperatures [K]: at the start, and where the coupling is strongest
  material::CouplingNumber at_initial, at_worst;
  bool plane = false;  ///< no strain in one direction: CouplingNumber::plane is the one that counts
  /// δ_K of the worst temperature: the quasi-static isothermal split is stable for every step below one.
  double decisive() const { return plane ? at_worst.plane : at_worst.bound; }
};

/// Estimates of a thermo-mechanical case, one per body. The range of temperatures is that of all initial,
/// ambient and prescribed ones but those of conditions that vary with position. Collective.
/// @param start  of each body; `initial` is the highest
std::vector<CouplingEstimate> coupling_estimates(const cases::CaseSpec& spec,
                                                 const std::vector<material::Material>& materials,
                                                 const mesh::Mesh& mesh,
                                                 const std::vector<setup::InitialTemperatureRange>& start);

/// The steps by which temperatures lag behind a steady change of them because the scheme conducts heat before
/// deformation has taken up its share: in a sequential split with heat first by backward Euler what δ_K
/// differs from the share of free expansion, which such a split expects, half of that by two stages, half of
/// δ_K in the double pass, zero in schemes that solve both together (docs/theory/coupling_stability.md, 9).
/// @param keeps_strain  Phases::keeps_strain
double heat_lag(const cases::CaseSpec& spec, const std::vector<CouplingEstimate>& estimates,
                bool keeps_strain);

/// "casting: delta = 0.0400 at 319.85 degC, ...".
std::string text(const CouplingEstimate& estimate);

/// Prints the expected stability at the start of a run with isothermal passes, as a warning where they will
/// be unstable. Prints nothing for other schemes.
void announce_isothermal(const cases::CaseSpec& spec, const std::vector<CouplingEstimate>& estimates);

}  // namespace solidus::check
