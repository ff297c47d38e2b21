/// Contact in the first law: the energy stored by penalties and by friction's hardening, the dissipation by
/// friction, and the numerical dissipation of backward Euler on the penalty springs.
///
/// A step does the work Σ f·Δu on contact, f its forces at t_{n+1}. Without friction and sliding that is
/// t_N,1 Δg on a spring that gains ½ ε_N (⟨g_1⟩² − ⟨g_0⟩²). The difference, ½ ε_N Δg² in closed contact, is
/// positive and of second order in the step: numerical dissipation, a term of its own.
#pragma once

#include <span>

#include "coupling/phases.hpp"

namespace solidus::coupling {

class ContactWork {
 public:
  /// Begins at the present states of the pairs. Collective.
  explicit ContactWork(const Phases& phases);

  /// The work of the last pass on contact, of forces that are the mean of those at its start and end with the
  /// share of the end; counted `factor` times. Collective.
  void add(double share = 1, double factor = 1);
  /// Sets the stored and the dissipated energy and adds the numerical dissipation; the work of rigid masters
  /// is work on the bodies. Collective.
  void book(EnergyAudit& energy) const;

 private:
  struct Energy {
    double stored = 0, dissipated = 0;  ///< [J]
  };
  Energy energy() const;

  const Phases& phases_;
  Energy begin_;
  double work_ = 0;   ///< [J]
  double rigid_ = 0;  ///< the part of it that rigid masters do [J]
};

/// After mechanical booking and the thermal pass: friction's heat, and the interface's own energy (3.69) in
/// place of the hardening that the mechanical phase has stored. What the balance in entropy (5.33) takes
/// beyond the change of E_c, of second order in the step, is numerical.
/// @param mechanical  false where deformation and heat exchange nothing: then friction's heat alone
void book_interface(EnergyAudit& energy, bool mechanical);

/// Leaves the heat of the bodies alone in the first law: deformation exchanges nothing with it.
void keep_heat_alone(EnergyAudit& energy);

/// Commits the temperatures of the interfaces after a thermal pass, and books into the audit what they
/// dissipate and store, and the heat, with its entropy, from rigid masters of given temperature. Adds to
/// energy.interface. Collective.
/// @param temperature  found, [local node] [K]
/// @param into_bodies  heat of the thermal phase's contributions, those of the pairs first [J]
void commit_contact_heat(const Phases& phases, std::span<const double> temperature,
                         std::span<const double> into_bodies, EnergyAudit& energy);

}  // namespace solidus::coupling
