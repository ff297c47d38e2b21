/// The power of a heat source in a body as a plug-in: a struct that turns numbers of the case into a formula.
///
///   struct Decaying {
///     static constexpr std::string_view name = "decaying", doc = "…";
///     double initial = 0, lifetime = 0;  // [W/m³], [s]
///     static void keys(Section<Decaying>& s) { s.quantity("first_power", &Decaying::initial, "W/m3")…; }
///     std::string power() const;         // a formula of x, y, z, r [m] and t [s] for W/m³
///   };
///   const AddSourceLaw<Decaying> k_decaying;   // at namespace scope: the key `law` of sources knows
///   "decaying"
///
/// The formula is what the key `power` would hold: checks, times at which steps end, means over a step and
/// results of a source follow from it.
#pragma once

#include <string>

#include "input/kinds.hpp"

namespace solidus::cases {

struct CaseSpec;

class SourceLaw {
 public:
  virtual ~SourceLaw() = default;
  /// A formula of place and time in SI [W/m³]; empty: the case gives the power itself.
  virtual std::string power() const = 0;
};

template <class Law>
class SourceLawOf final : public SourceLaw {
 public:
  Law data;
  std::string power() const override { return data.power(); }
};

/// All laws, built in and added; the key `law` of [[thermal_condition]] with kind = "source".
Kinds<SourceLaw>& source_laws();

/// Adds a law while the program starts, as an object at namespace scope.
template <class Law>
struct AddSourceLaw {
  AddSourceLaw() { source_laws().add(kind_of<SourceLaw, SourceLawOf<Law>>()); }
};

/// Sets the power of each source whose law gives it, once the case has been read. Throws InputError for a
/// formula that is none.
void set_powers(CaseSpec& spec);

}  // namespace solidus::cases
