/// Contact that beds in under pressure and conducts less when hot, a law that the sources do not have:
///
///   h = h_1 + (h_2 − h_1) t_N/(t_N + p_0) (1 − (Θ_g − 300 K)/5000 K)
///
/// Symbols: t_N pressure, p_0 [Pa], h_1, h_2 [W/(m² K)], Θ_g temperature [K]. Validity: t_N >= 0.
#pragma once

#include "contact/laws/contact_law.hpp"

namespace solidus::test {

struct BeddingContact {
  static constexpr std::string_view name = "bedding", doc = "from loose to bedded with the pressure";
  double loose = 0, bedded = 0, pressure = 0;

  static void keys(Section<BeddingContact>& s) {
    s.quantity("loose", &BeddingContact::loose, "W/m2/K").positive().doc("h_1.");
    s.quantity("bedded", &BeddingContact::bedded, "W/m2/K").positive().doc("h_2.");
    s.quantity("bedding_pressure", &BeddingContact::pressure, "Pa").positive().doc("p_0.");
  }
  static constexpr bool beside_gas = false;
  template <class T>
  T conductance(const T& p, const T& temperature) const {
    return T(loose) + T(bedded - loose) * (p / (p + T(pressure))) * (T(1.06) - temperature * T(2e-4));
  }
};

inline const contact::AddContactLaw<BeddingContact> k_bedding_contact;

}  // namespace solidus::test
