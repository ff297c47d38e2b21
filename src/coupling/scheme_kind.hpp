/// A coupling scheme as a plug-in: what it is called, what it needs, what it refuses and why, and how it is
/// made. A scheme describes itself by a struct like DoublePassScheme (schemes/double_pass_keys.hpp), in its
/// own file:
///
///   struct Lagged {
///     static constexpr std::string_view name = "lagged", doc = "…";
///     static void keys(Section<Lagged>& s);                                 // of [coupling]; may be absent
///     SchemeTraits traits() const;
///     std::optional<Objection> objection(const SchemeContext& c) const;     // may be absent
///     std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext& c) const;
///   };
///   const AddScheme<Lagged> k_lagged;   // at namespace scope (add_scheme.hpp): the key scheme knows
///   "lagged"
///
/// Optional members: lags_a_step, advice (below).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/restart_data.hpp"
#include "mechanics/mechanics_options.hpp"
#include "mechanics/structural_heat.hpp"
#include "system/objection.hpp"

namespace solidus {

template <class Interface>
class Kinds;  // input/kinds.hpp
}

namespace solidus::coupling {

class CouplingScheme;
struct Phases;

/// The scheme that is stable however strong the coupling is; the one to name where another one fails.
inline constexpr std::string_view k_stable_scheme = "isentropic";

/// The rest of a case, as far as it concerns a scheme.
struct SchemeContext {
  std::optional<mechanics::StructuralForm> heating;  ///< absent: deformation exchanges no heat
  bool as_printed = false;                           ///< sensible heat in the same form
  bool inertia = false;
  bool rubs = false;            ///< there is friction
  bool slides_in_heat = false;  ///< the thermal phase returns the traction of friction too (5.40-5.51)
  /// Something that deforms melts in the run, or yields while temperatures differ: it keeps the strain that
  /// it gets at the temperature of a step, also when that was not its own. Not known before materials are
  /// read.
  bool keeps_strain = false;
  mechanics::TimeIntegration integration = mechanics::TimeIntegration::backward_euler;  ///< of flow

  /// Structural heat that counts from a mechanical phase at the temperature of the step's start.
  bool printed_form() const {
    return heating == mechanics::StructuralForm::literal || heating == mechanics::StructuralForm::temperature;
  }
};

struct SchemeTraits {
  /// The mechanical phase holds the entropy or the temperature; `simultaneous`: both fields are solved at
  /// once. Without structural heat an isentropic phase is made isothermal (CaseSpec::isentropic).
  mechanics::Mapping mapping = mechanics::Mapping::isentropic;
  bool leaves_stepping = false;  ///< the thermal phase may integrate a step by two stages of its own
  bool printed_forms = false;    ///< it has the forms `literal` and `temperature` of structural heat
  bool second_order = false;  ///< in time; the decay of the functional of stability is proved for first order
  bool needs_weak_coupling = false;  ///< else it is unstable, and shorter steps do not help
  bool iterates = false;             ///< its passes are repeated until they agree
  double effort = 1;                 ///< of a step, in passes of each phase
};

class SchemeKind {
 public:
  virtual ~SchemeKind() = default;
  virtual std::string_view name() const = 0;
  virtual SchemeTraits traits() const = 0;
  /// Returns the objection to the scheme in this case, if there is one.
  virtual std::optional<Objection> objection(const SchemeContext& c) const = 0;
  /// Whether displacements and stresses of a step belong to the temperatures at its start.
  virtual bool lags_a_step(const SchemeContext& c) const = 0;
  /// Advice where a run has stopped in the scheme.
  virtual std::vector<std::string> advice(const Stop& stop) const = 0;
  /// @param phases  must outlive the scheme
  virtual std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext& c) const = 0;
};

/// All schemes, built in and added; the key scheme of [coupling].
Kinds<SchemeKind>& schemes();
/// The scheme of a case that names none.
std::shared_ptr<const SchemeKind> default_scheme();
/// The scheme of a case of mechanics or heat alone.
std::unique_ptr<CouplingScheme> single_phase(const Phases& phases);

}  // namespace solidus::coupling
