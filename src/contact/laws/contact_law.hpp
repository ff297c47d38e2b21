/// A law of heat through the closed interface, h(t_N, Θ_g), as a plug-in: a struct like PowerContact
/// (laws/power_contact.hpp).
///
///   struct Bedding {
///     static constexpr std::string_view name = "bedding", doc = "…";
///     double pressure = 0;  // [Pa]
///     static void keys(Section<Bedding>& s) { s.quantity("bedding_pressure", &Bedding::pressure, "Pa")…; }
///     template <class T> T conductance(const T& pressure) const;
///   };
///   const AddContactLaw<Bedding> k_bedding;   // at namespace scope: adds "bedding" to the key
///
/// Optional members, in addition to those of laws/conductance.hpp:
///
///   static constexpr bool beside_gas = false;  // or a function: h is all of it. Absent: it adds to what a
///   gap
///                                              // of zero conducts, and h(0) = 0
///   std::optional<double> without_pressure() const;  // for gap laws that start where contact ends; absent:
///                                                    // h(0) of a law that is all of it, else nothing
///   Separation separation(double pressure) const;    // of the mean planes of rough surfaces
///   double slave_resistance(double pressure, double temperature) const;  // s of 3.45 where it is the law's
///   Law swapped() const;                             // of such a law: slave and master exchanged
///   bool needs_conductivity() const;                 // of the bodies, which it has not been given
///   void take_conductivity(Table mean);              // k̄ [W/(m K)] of the temperature
///   std::optional<Objection> objection(bool gas_between) const;  // gas_between: separation() will be asked
///
/// Validity: h >= 0 and finite for t_N >= 0 and Θ_g >= 0.
#pragma once

#include "contact/laws/conductance.hpp"
#include "input/kinds.hpp"

namespace solidus::contact {

/// Distance of the mean planes of rough surfaces.
struct Separation {
  double value = 0;  ///< Y [m]
  double slope = 0;  ///< ∂Y/∂t_N [m/Pa]
};

class ContactLaw : public ConductanceLaw {
 public:
  /// Whether its conductance is added to that of the gas in the gap.
  virtual bool beside_gas() const = 0;
  virtual std::optional<double> without_pressure() const = 0;
  virtual bool rough() const = 0;  ///< it has a separation
  virtual Separation separation(double pressure) const = 0;
  /// s of HeatTransferSpec::slave_resistance if the law determines it, otherwise nothing.
  virtual std::optional<double> slave_resistance(double pressure, double temperature) const = 0;
  /// The law with slave and master exchanged; null: the law is symmetric.
  virtual std::shared_ptr<const ContactLaw> swapped() const = 0;
  /// Whether the law depends on the mean conductivity of the bodies, and the law with this mean: k̄ [W/(m K)]
  /// of the temperature [K].
  virtual bool needs_conductivity() const = 0;
  virtual std::shared_ptr<const ContactLaw> with_conductivity(Table mean) const = 0;
  /// The law ready for use. Throws InputError for parameters that are not valid.
  /// @param gas_fills_roughness  the law of the gap includes the gas in the roughness
  /// @param tables               of [[contact.heat.at]]
  virtual std::shared_ptr<const ContactLaw> ready(bool gas_fills_roughness, std::vector<TableAt> tables,
                                                  const SourceLocation& where) const = 0;
};

template <class Law>
class ContactLawOf final : public ConductanceLawOf<ContactLaw, Law> {
 public:
  using ConductanceLawOf<ContactLaw, Law>::data;

  bool beside_gas() const override {
    if constexpr (requires { data.beside_gas(); })
      return data.beside_gas();
    else if constexpr (requires { Law::beside_gas; })
      return Law::beside_gas;
    else
      return true;
  }
  std::optional<double> without_pressure() const override {
    if constexpr (requires { data.without_pressure(); }) return data.without_pressure();
    if (beside_gas()) return std::nullopt;
    const std::vector<double> temperatures = this->temperatures();
    return this->at(0, temperatures.empty() ? 300.0 : temperatures.front()).value;
  }
  bool rough() const override { return k_rough; }
  Separation separation(double pressure) const override {
    if constexpr (k_rough)
      return data.separation(pressure);
    else
      return {};
  }
  std::optional<double> slave_resistance(double pressure, double temperature) const override {
    if constexpr (requires { data.slave_resistance(pressure, temperature); })
      return data.slave_resistance(pressure, temperature);
    else
      return std::nullopt;
  }
  std::shared_ptr<const ContactLaw> swapped() const override {
    if constexpr (requires { data.swapped(); }) {
      auto law = std::make_shared<ContactLawOf>(*this);
      law->data = data.swapped();
      return law;
    } else {
      return nullptr;
    }
  }
  bool needs_conductivity() const override {
    if constexpr (requires { data.needs_conductivity(); })
      return data.needs_conductivity();
    else
      return false;
  }
  std::shared_ptr<const ContactLaw> with_conductivity(Table mean) const override {
    auto law = std::make_shared<ContactLawOf>(*this);
    if constexpr (requires { law->data.take_conductivity(mean); })
      law->data.take_conductivity(std::move(mean));
    return law;
  }
  std::shared_ptr<const ContactLaw> ready(bool gas_fills_roughness, std::vector<TableAt> tables,
                                          const SourceLocation& where) const override {
    auto law = std::make_shared<ContactLawOf>(*this);
    std::optional<Objection> wrong = law->take(std::move(tables), "contact_law", "contact_conductance");
    if (!wrong) wrong = law->objection();
    if constexpr (requires { law->data.objection(true); })
      if (!wrong) wrong = law->data.objection(gas_fills_roughness);
    if (wrong) throw InputError(where, wrong->found, wrong->allowed);
    return law;
  }

 private:
  static constexpr bool k_rough = requires(const Law law) { law.separation(1.0); };
};

/// A law with its parameters, for HeatTransferSpec.
template <class Law>
std::shared_ptr<const ContactLaw> contact_law(Law data) {
  auto law = std::make_shared<ContactLawOf<Law>>();
  law->data = std::move(data);
  return law;
}

/// All laws of the closed interface, built in and added; the key contact_law.
Kinds<ContactLaw>& contact_laws();

/// Registers a law at the start of the program, as an object at namespace scope.
template <class Law>
struct AddContactLaw {
  AddContactLaw() { contact_laws().add(kind_of<ContactLaw, ContactLawOf<Law>>()); }
};

}  // namespace solidus::contact
