/// A law of heat across the open gap, h(g, Θ_g), as a plug-in: a struct like GasGap (laws/gas_gap.hpp).
///
///   struct Porous {
///     static constexpr std::string_view name = "porous", doc = "…";
///     double depth = 0;  // [m]
///     static void keys(Section<Porous>& s) { s.quantity("pore_depth", &Porous::depth, "m")…; }
///     template <class T> T conductance(const T& gap) const;
///   };
///   const AddGapLaw<Porous> k_porous;   // at namespace scope: the key gap_law knows "porous"
///
/// Optional members, besides those of laws/conductance.hpp:
///
///   static constexpr bool fills_roughness = true;  // its gas is between the asperities of rough surfaces
///   too std::optional<Objection> begin(const ContactSide& side);  // once, before all else
///
/// Validity: h >= 0 and finite for g >= 0 and Θ_g >= 0; h(0) meets the closed interface without pressure.
#pragma once

#include "contact/laws/conductance.hpp"
#include "input/kinds.hpp"

namespace solidus::contact {

/// The state of the closed interface that a law of the gap may depend on.
struct ContactSide {
  std::optional<double> conductance;  ///< without pressure [W/(m² K)]; absent: it has none of its own
  bool rough = false;                 ///< gaps are counted from mean plane to mean plane of rough surfaces
};

class GapLaw : public ConductanceLaw {
 public:
  /// Whether a gap that is counted between the mean planes of rough surfaces means something to the law.
  virtual bool fills_roughness() const = 0;
  /// The law together with that of the closed interface. Throws InputError where they make none.
  /// @param tables  of [[contact.heat.at]]
  virtual std::shared_ptr<const GapLaw> beside(const ContactSide& side, std::vector<TableAt> tables,
                                               const SourceLocation& where) const = 0;
};

template <class Law>
class GapLawOf final : public ConductanceLawOf<GapLaw, Law> {
 public:
  bool fills_roughness() const override {
    if constexpr (requires { Law::fills_roughness; })
      return Law::fills_roughness;
    else
      return false;
  }
  std::shared_ptr<const GapLaw> beside(const ContactSide& side, std::vector<TableAt> tables,
                                       const SourceLocation& where) const override {
    auto law = std::make_shared<GapLawOf>(*this);
    std::optional<Objection> wrong = law->take(std::move(tables), "gap_law", "gap_conductance");
    if constexpr (requires { law->data.begin(side); })
      if (!wrong) wrong = law->data.begin(side);
    if (!wrong) wrong = law->objection();
    if (wrong) throw InputError(where, wrong->found, wrong->allowed);
    return law;
  }
};

/// A law with its numbers, for HeatTransferSpec.
template <class Law>
std::shared_ptr<const GapLaw> gap_law(Law data) {
  auto law = std::make_shared<GapLawOf<Law>>();
  law->data = std::move(data);
  return law;
}

/// All laws of the gap, built in and added; the key gap_law.
Kinds<GapLaw>& gap_laws();

/// Adds a law while the program starts, as an object at namespace scope.
template <class Law>
struct AddGapLaw {
  AddGapLaw() { gap_laws().add(kind_of<GapLaw, GapLawOf<Law>>()); }
};

}  // namespace solidus::contact
