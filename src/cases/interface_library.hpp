/// The library of interface laws: the heat transfer from a metal to the material it is cast in, by pair of
/// materials and roles (interfaces/*.toml, docs/guide/interfaces.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"

namespace solidus::cases {

/// One side of the pair that a card is for; empty lists fit everything.
struct InterfaceSide {
  std::vector<std::string> materials;  ///< names, with * for any characters: "aluminium*"
  std::vector<std::string> roles;      ///< "casting", ...
};

/// A published conductance: measured, fitted to measured curves or recommended, with the place in print.
struct PublishedConductance {
  std::string by, what;            ///< authors, journal and year; metal, mould and method
  double lowest = 0, highest = 0;  ///< [W/(m² K)]
};

struct InterfaceCard {
  std::string name;  ///< of the file, without ".toml"
  std::string title;
  InterfaceSide one, other;
  /// Only by its name, since process or coating decide it and not the materials.
  bool by_name_alone = false;
  contact::HeatTransferSpec heat;
  std::string source, range;  ///< origin of the numbers, and range of the conductance
  bool estimate = false;      ///< not checked against the source
  std::vector<PublishedConductance> published;
  ContactSpreads spread;  ///< how far the law may be off
};

/// Next to the folders of materials: `interfaces` in place of `materials`.
std::vector<std::filesystem::path> interface_folders();

/// All cards, sorted by name; of equal names that of the first folder. Throws InputError for a wrong card.
std::vector<InterfaceCard> interface_cards();

/// One side of an interface that a card is searched for.
struct InterfacePartner {
  std::string material;  ///< name in the library, or a file
  Role role = Role::casting;
};

/// The card that fits a pair best, either way round: with the most letters in its patterns, a role counting
/// as twenty. Null where none fits.
const InterfaceCard* best_card(const std::vector<InterfaceCard>& cards, const InterfacePartner& a,
                               const InterfacePartner& b);

/// Whether `*` in a pattern can be filled so that it is the text.
bool matches(std::string_view pattern, std::string_view text);

}  // namespace solidus::cases
