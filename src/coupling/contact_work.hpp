/// Contact penalties in the first law: what their springs store, and what backward Euler loses on them.
///
/// A step does the work t_N,1 Δg on a spring that gains ½ ε_N (⟨g_1⟩² − ⟨g_0⟩²). The difference, ½ ε_N Δg² in
/// closed contact, is positive and of second order in the step: numerical dissipation, a term of its own.
#pragma once

#include <vector>

#include "coupling/phases.hpp"

namespace solidus::coupling {

class ContactWork {
 public:
  /// Begins at the present gaps of the pairs. Collective.
  explicit ContactWork(const Phases& phases);

  /// The work from the last gaps to the present ones, of a pressure that is the mean of those at both with
  /// the share of the present one; counted `factor` times. Collective.
  void add(double share = 1, double factor = 1);
  /// The next piece begins at g_0 + carried (g − g_0), g_0 where the step began: the second stage of
  /// Alexander's method. Without a call it begins at the gaps of the piece before.
  void restart(double carried);
  /// Sets the change of the springs' energy and adds what was lost. Collective.
  void book(EnergyAudit& energy) const;

 private:
  double stored() const;

  const Phases& phases_;
  std::vector<std::vector<double>> begin_, last_;  ///< penetrations [m], [pair][point]
  double stored_ = 0, work_ = 0;                   ///< [J]
};

}  // namespace solidus::coupling
