/// A conductance h(x, Θ_g) with its derivatives, x the pressure [Pa] or the gap [m]: the common part of the
/// laws of the closed interface (laws/contact_law.hpp) and of the gap (laws/gap_law.hpp).
///
/// A law is a struct with `name`, `doc`, `keys` and one of
///
///   template <class T> T conductance(const T& x) const;                        // h [W/(m² K)]
///   template <class T> T conductance(const T& x, const T& temperature) const;  // derivatives by AD
///   LawConductance at(double x, double temperature) const;                     // derivatives in closed form
///
/// Optional members:
///
///   bool of_temperature() const;                // of a law with at(): h changes with Θ_g; absent: no
///   std::optional<Objection> objection() const; // what is wrong with its numbers together
///   std::vector<Remark> remarks(std::string_view contact) const;  // what `solidus check` should say
///   std::optional<Objection> take(std::vector<TableAt> tables);   // tables of [[contact.heat.at]]
///   std::vector<double> temperatures() const;                     // those of its tables [K]
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "numbers/jet.hpp"
#include "numbers/table.hpp"
#include "system/errors.hpp"
#include "system/objection.hpp"

namespace solidus::contact {

struct LawConductance {
  double value = 0;           ///< h [W/(m² K)]
  double slope = 0;           ///< ∂h/∂x; zero at x = 0 where it has no bound
  double by_temperature = 0;  ///< ∂h/∂Θ_g [W/(m² K²)]
  double mixed = 0;           ///< ∂²h/∂x∂Θ_g
};

/// The warning of `solidus check` about unusual values of a law.
struct Remark {
  bool error = false;  ///< the case must not run
  std::string found, usual;
};

/// A table of [[contact.heat.at]].
struct TableAt {
  double temperature = 0;  ///< [K]
  Table table;
};

class ConductanceLaw {
 public:
  virtual ~ConductanceLaw() = default;
  virtual std::string_view name() const = 0;
  /// @param x  pressure [Pa] or gap [m], >= 0
  virtual LawConductance at(double x, double temperature) const = 0;
  virtual bool of_temperature() const = 0;
  /// The temperatures at which closed and open interface are compared; empty: any one does [K].
  virtual std::vector<double> temperatures() const = 0;
  virtual std::vector<Remark> remarks(std::string_view contact) const = 0;
};

namespace detail {

template <class Law>
inline constexpr bool k_closed_form = requires(const Law law) {
  law.at(1.0, 1.0);
};
template <class Law>
inline constexpr bool k_takes_temperature = requires(const Law law) {
  law.conductance(1.0, 1.0);
};

inline double bounded(double derivative) {
  return std::isfinite(derivative) ? derivative : 0;
}

template <class Law>
LawConductance conductance_of(const Law& law, double x, double temperature) {
  using J = Jet<double>;
  if constexpr (k_closed_form<Law>) {
    return law.at(x, temperature);
  } else if constexpr (k_takes_temperature<Law>) {
    const Jet<J> h = law.conductance(Jet<J>(J::variable(x)), Jet<J>(J(temperature), J(1.0), J(0.0)));
    return {h.v.v, bounded(h.v.d), h.d.v, bounded(h.d.d)};
  } else {
    const J h = law.conductance(J::variable(x));
    return {h.v, bounded(h.d), 0, 0};
  }
}

}  // namespace detail

/// The common part of the adapters of both kinds of law.
/// @tparam Interface  ContactLaw or GapLaw
template <class Interface, class Law>
class ConductanceLawOf : public Interface {
 public:
  Law data;

  std::string_view name() const override { return Law::name; }
  LawConductance at(double x, double temperature) const override {
    return detail::conductance_of(data, x, temperature);
  }
  bool of_temperature() const override {
    if constexpr (requires { data.of_temperature(); })
      return data.of_temperature();
    else
      return detail::k_takes_temperature<Law>;
  }
  std::vector<double> temperatures() const override {
    if constexpr (requires { data.temperatures(); })
      return data.temperatures();
    else if constexpr (detail::k_takes_temperature<Law>)
      return {300, 600, 900, 1200, 1500, 1800, 2100};
    else
      return {};
  }
  std::vector<Remark> remarks(std::string_view contact) const override {
    if constexpr (requires { data.remarks(contact); })
      return data.remarks(contact);
    else
      return {};
  }

 protected:
  /// @param law_key, table_key  for messages: "gap_law", "gap_conductance"
  std::optional<Objection> take(std::vector<TableAt> tables, const char* law_key, const char* table_key) {
    if constexpr (requires { data.take(tables); })
      return data.take(std::move(tables));
    else if (!tables.empty())
      return Objection{
          std::string("[[contact.heat.at]] has '") + table_key + "', which needs " + law_key + " = \"table\"",
          "one of them"};
    return std::nullopt;
  }
  std::optional<Objection> objection() const {
    if constexpr (requires { data.objection(); })
      return data.objection();
    else
      return std::nullopt;
  }
};

}  // namespace solidus::contact
