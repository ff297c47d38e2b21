// Findings on cards of the library of interface laws that are for other bodies than those of the interface.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cases/interface_library.hpp"
#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

/// Conductances that differ by less than this factor are a choice among coatings, not another interface.
constexpr double k_alike = 3;

double closed_conductance(const contact::HeatTransferSpec& heat, double temperature) {
  constexpr double k_atmosphere = 101325;  // pressure that holds melt on its wall [Pa]
  return contact::HeatTransferLaw(contact::without_bodies(heat)).at(0, k_atmosphere, temperature).value;
}

/// Whether a side of the card is for a material or for a role of its own, not for whatever is a die or a
/// mould.
bool particular(const cases::InterfaceSide& side) {
  if (!side.materials.empty()) return true;
  constexpr std::array k_any = {"casting", "riser", "die", "mould", "core"};
  return !side.roles.empty() && std::none_of(side.roles.begin(), side.roles.end(), [&](const auto& role) {
    return std::find(k_any.begin(), k_any.end(), role) != k_any.end();
  });
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  // A law that a section names is compared with the one that the library would choose for these partners.
  // Only a particular card counts as better, and only where the conductances differ by a factor.
  const bool any = std::any_of(spec.contacts.begin(), spec.contacts.end(),
                               [](const cases::ContactSpec& contact) { return !contact.law.empty(); });
  if (!spec.has_heat() || !any) return;
  std::vector<cases::InterfaceCard> cards = cases::interface_cards();
  for (std::size_t c = 0; c < spec.contacts.size() && c < m.contacts.size(); ++c) {
    const cases::ContactSpec& contact = spec.contacts[c];
    const setup::ContactMeasures& sides = m.contacts[c];
    if (contact.law.empty() || sides.slave_body < 0 || sides.master_body < 0) continue;
    // A partner is known by its material and its role, as cards name either.
    const auto partner = [&](int b) {
      const auto body = as_size(b);
      return cases::InterfacePartner{spec.bodies[body].material,
                                     cases::role_of(spec.bodies[body], a.materials[body])};
    };
    const cases::InterfacePartner one = partner(sides.slave_body), two = partner(sides.master_body);
    // The card that the file names, and the best one without that name.
    const auto used = std::find_if(cards.begin(), cards.end(), [&](const cases::InterfaceCard& card) {
      return card.name == contact.law;
    });
    const cases::InterfaceCard* const best = cases::best_card(cards, one, two);
    if (used == cards.end() || best == nullptr || !(particular(best->one) || particular(best->other)))
      continue;
    // A card fits a pair if it would be chosen for it, by its partners, without its name.
    cases::InterfaceCard by_pair = *used;
    by_pair.by_name_alone = false;
    if (cases::best_card({by_pair}, one, two) != nullptr) continue;
    // Conductances are compared closed and at the hotter start, where they decide over the cooling.
    const double temperature =
        std::max(a.start[as_size(sides.slave_body)].high, a.start[as_size(sides.master_body)].high);
    const double h = closed_conductance(used->heat, temperature),
                 usual = closed_conductance(best->heat, temperature);
    if (h < k_alike * usual && usual < k_alike * h) continue;
    findings.push_back({false, contact.where,
                        fmt::format("the interface law '{}' ({}, {:.4g} W/m2/K) of '{}' is not for '{}' ({}) "
                                    "and '{}' ({})",
                                    used->name, used->title, h, contact.name, one.material, name(one.role),
                                    two.material, name(two.role)),
                        fmt::format("without `law` it is '{}', {:.4g} W/m2/K", best->name, usual)});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_interface_laws() {
  return {.name = "interface laws",
          .place = 20,
          .find = &find,
          .rows = {{Topic::contacts, "an interface law of other bodies",
                    fmt::format("`law` names a card that is not for these materials and roles, and whose "
                                "conductance differs by a factor of {} from that of the one that is",
                                number(k_alike))}}};
}

}  // namespace solidus::check
