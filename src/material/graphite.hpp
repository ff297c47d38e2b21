/// Carbon and silicon of an iron, and the graphite that precipitates of them as it freezes: [graphite] of its
/// file (docs/theory/graphite.md).
///
/// Melt and austenite of the eutectic with graphite hold, in mass per cent,
///
///   C_E = 4.26 − 0.31 Si,   C_A = 2.08 − 0.11 Si
///
/// (after the equilibrium diagram of Fe-C-Si, R. W. Heine, The Fe-C-Si solidification diagram for cast irons,
/// AFS Trans. 94 (1986) 391–402). By the *lever* rule all carbon beyond that of austenite with C_A
/// precipitates,
///
///   g = 100 (C − C_A)/(100 − C_A),
///
/// by *Scheil's* equation primary austenite keeps what it froze with, so that the share (C/C_E)^(1/(1 − k)),
/// k = C_A/C_E, is left as eutectic, of which g is that of the melt with C_E. Primary graphite of a
/// hypereutectic melt is in both.
#pragma once

#include <string>

namespace solidus::material {

struct Graphite {
  enum class Rule { lever, scheil };
  enum class Form { flake, compacted, nodular };
  double carbon = 0, silicon = 0;  ///< [mass per cent]
  Rule rule = Rule::lever;
  Form form = Form::flake;
  double expansion = 0.032;  ///< relative volume that one mass per cent of graphite adds as it precipitates
  std::string source;

  double eutectic() const;   ///< C_E [mass per cent]
  double austenite() const;  ///< C_A [mass per cent]
  /// Graphite that precipitates until the last melt is frozen [mass per cent].
  double precipitated() const;
  /// The change of volume by it, that of a change of phase.
  double volume_change() const { return expansion * precipitated(); }
  /// The share of it that feeds in a mould of this rigidity, rigidity^n with n = 1 of flakes, 3/2 of
  /// compacted graphite and 2 of nodules. Estimates: flakes grow in touch with the melt and squeeze it
  /// through the mush, nodules within shells of austenite that press on the wall, which moves about twice as
  /// far under nodular iron as under grey iron in the same sand.
  double feeding_share(double rigidity) const;
};

}  // namespace solidus::material
