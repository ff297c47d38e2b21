/// Makes a coupling scheme from a struct that describes it (scheme_kind.hpp).
#pragma once

#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"
#include "coupling/scheme_kind.hpp"
#include "input/kinds.hpp"

namespace solidus::coupling {

template <class Scheme>
class SchemeKindOf final : public SchemeKind {
 public:
  Scheme data;

  std::string_view name() const override { return Scheme::name; }
  SchemeTraits traits() const override { return data.traits(); }
  std::optional<Objection> objection(const SchemeContext& c) const override {
    const SchemeTraits t = data.traits();
    if (c.printed_form() && !t.printed_forms)
      return Objection{
          std::string("structural_heating = \"") +
              (c.heating == mechanics::StructuralForm::literal ? "literal" : "temperature") +
              "\" counts from the end of a mechanical phase at the temperature of the step's start",
          "scheme = \"isothermal\", or structural_heating \"entropy\" or \"energy\""};
    if constexpr (requires { data.objection(c); })
      return data.objection(c);
    else
      return std::nullopt;
  }
  bool lags_a_step(const SchemeContext& c) const override {
    if constexpr (requires { data.lags_a_step(c); })
      return data.lags_a_step(c);
    else
      return false;
  }
  std::vector<std::string> advice(const Stop& stop) const override {
    if constexpr (requires { data.advice(stop); })
      return data.advice(stop);
    else
      return {};
  }
  std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext& c) const override {
    return data.make(phases, c);
  }
};

/// A scheme with its options.
template <class Scheme>
std::shared_ptr<const SchemeKind> scheme_kind(Scheme data) {
  auto kind = std::make_shared<SchemeKindOf<Scheme>>();
  kind->data = std::move(data);
  return kind;
}

/// Registers a scheme at the start of the program, as an object at namespace scope.
template <class Scheme>
struct AddScheme {
  AddScheme() { schemes().add(kind_of<SchemeKind, SchemeKindOf<Scheme>>()); }
};

}  // namespace solidus::coupling
