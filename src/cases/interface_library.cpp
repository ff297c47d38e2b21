/// Cards of interfaces are scored by materials and roles; the best one is taken.
#include "cases/interface_library.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "cases/case_keys.hpp"
#include "cases/case_materials.hpp"
#include "cases/roles.hpp"
#include "input/document.hpp"
#include "input/keys.hpp"

namespace solidus::cases {

namespace {

namespace fs = std::filesystem;

Section<InterfaceSide> side_keys(const char* name) {
  Section<InterfaceSide> s(name, "One side of the pair that the card is for.");
  s.key("materials", &InterfaceSide::materials)
      .or_one()
      .initially(Value::list())
      .doc("Names of materials, with * for any characters; empty: all.");
  s.key("roles", &InterfaceSide::roles)
      .or_one()
      .initially(Value::list())
      .choices({"casting", "riser", "mould", "core", "chill", "sleeve", "die", "insulation"})
      .doc("Roles of bodies; empty: all.");
  return s;
}

/// Keys of a published value of a conductance, by which a card says where it comes from.
Section<PublishedConductance> published_keys() {
  using P = PublishedConductance;
  Section<P> s("published", "A conductance in print.");
  s.key("by", &P::by).doc("Authors, journal and year.");
  s.key("what", &P::what).doc("Metal, mould and method.");
  s.quantity("lowest", &P::lowest, "W/m2/K").positive().doc("The lowest value given there.");
  s.quantity("highest", &P::highest, "W/m2/K").positive().doc("The highest value given there.");
  return s;
}

/// Keys of a card of the library of interface laws.
const Section<InterfaceCard>& card_keys() {
  static const Section<InterfaceCard> declaration = [] {
    using C = InterfaceCard;
    Section<C> s("", "A card of the library of interface laws.");
    s.key("title", &C::title).doc("What it is for, one line.");
    s.section("one", &C::one, side_keys("one"));
    s.section("other", &C::other, side_keys("other"));
    s.key("by_name_alone", &C::by_name_alone)
        .initially(false)
        .doc("It is taken only where a case names it: the process decides, not the materials.");
    s.section("heat", &C::heat, contact_heat_keys());
    s.key("source", &C::source).doc("Where the numbers come from.");
    s.key("range", &C::range).doc("Between what the conductance lies in practice.");
    s.key("estimate", &C::estimate).initially(false).doc("The numbers were not checked against the source.");
    s.sections("published", &C::published, published_keys());
    s.section("spread", &C::spread,
              contact_spread_keys("spread", "How far the heat transfer may lie from that of the card."));
    return s;
  }();
  return declaration;
}

/// Returns how well a side fits; nothing if it does not.
std::optional<int> score(const InterfaceSide& side, const InterfacePartner& partner) {
  // The longest pattern that matches the material counts, so that a card for one alloy precedes one for all
  // of its kind; a role that matches counts more than any pattern.
  const std::string material = fs::path(partner.material).stem().string();
  int best = side.materials.empty() ? 0 : -1;
  for (const std::string& pattern : side.materials)
    if (matches(pattern, material)) best = std::max(best, static_cast<int>(pattern.size()));
  if (best < 0) return {};
  if (side.roles.empty()) return best;
  constexpr int k_role = 20;
  // Gating is metal like the part that it leads to.
  const Role role = partner.role == Role::gating ? Role::casting : partner.role;
  if (std::find(side.roles.begin(), side.roles.end(), name(role)) == side.roles.end()) return {};
  return best + k_role;
}

}  // namespace

/// A star stands for any characters: it is tried for every number of them.
bool matches(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern.front() != '*')
    return !text.empty() && text.front() == pattern.front() && matches(pattern.substr(1), text.substr(1));
  for (std::size_t skipped = 0; skipped <= text.size(); ++skipped)
    if (matches(pattern.substr(1), text.substr(skipped))) return true;
  return false;
}

/// Folders of interfaces are next to those of materials, in the same order.
std::vector<fs::path> interface_folders() {
  std::vector<fs::path> folders;
  for (const fs::path& materials : material_folders()) {
    const fs::path folder = (materials / "..").lexically_normal() / "interfaces";
    std::error_code error;
    if (fs::is_directory(folder, error)) folders.push_back(folder);
  }
  return folders;
}

std::vector<InterfaceCard> interface_cards() {
  std::map<std::string, InterfaceCard> cards;
  // The first folder with a card of that name has it, so that the user's go before the program's.
  for (const fs::path& folder : interface_folders())
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") continue;
      const std::string name = entry.path().stem().string();
      if (cards.contains(name)) continue;
      InterfaceCard card = card_keys().read(load_document(entry.path()));
      card.name = name;
      check_spreads(card.spread, name);
      cards.emplace(name, std::move(card));
    }
  std::vector<InterfaceCard> list;
  for (auto& [name, card] : cards) list.push_back(std::move(card));
  return list;
}

const InterfaceCard* best_card(const std::vector<InterfaceCard>& cards, const InterfacePartner& a,
                               const InterfacePartner& b) {
  const InterfaceCard* best = nullptr;
  int most = -1;
  // The card that fits both bodies most closely, in either order.
  for (const InterfaceCard& card : cards) {
    if (card.by_name_alone) continue;
    for (const bool swapped : {false, true}) {
      const std::optional<int> one = score(card.one, swapped ? b : a),
                               other = score(card.other, swapped ? a : b);
      if (one && other && *one + *other > most) most = *one + *other, best = &card;
    }
  }
  return best;
}

}  // namespace solidus::cases
