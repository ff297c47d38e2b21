/// A law of heat sources that no file of the sources names: power that decays, as that of curing binders and
/// of hydration does.
///
///   R = R_0 exp(−t/τ)                                                                    [W/m³]
#include <fmt/format.h>

#include "cases/source_law.hpp"

namespace solidus::cases {
namespace {

struct Decaying {
  static constexpr std::string_view name = "decaying", doc = "`initial_power` that decays with `lifetime`";
  double initial = 0;   ///< R_0 [W/m³]
  double lifetime = 0;  ///< τ [s]

  static void keys(Section<Decaying>& s) {
    s.quantity("initial_power", &Decaying::initial, "W/m3").doc("Heat per volume and time at the start.");
    s.quantity("lifetime", &Decaying::lifetime, "s")
        .positive()
        .doc("Time in which the power falls to its e-th part.");
  }
  std::string power() const { return fmt::format("{:.17g} * exp(-t/{:.17g})", initial, lifetime); }
};

const AddSourceLaw<Decaying> k_decaying;

}  // namespace
}  // namespace solidus::cases
