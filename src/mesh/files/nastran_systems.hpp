/// Coordinate systems of Nastran (CORD1R, CORD2R and their kin), which may be given in each other.
#pragma once

#include <functional>
#include <map>
#include <optional>

#include "mesh/files/nastran_cards.hpp"
#include "mesh/local_system.hpp"

namespace solidus::mesh {

class NastranSystems {
 public:
  /// Keeps the entry of a system. Returns whether it is one.
  bool take(const NastranCard& card);

  /// The system of a number; 0 is the global one. Lengths are those of the file.
  /// @param grid  gives the global place of a node, for systems that nodes span
  /// Throws InputError where there is none, where its points lie on one line, and where systems are given in
  /// each other in a circle.
  const LocalSystem& find(GlobalIndex number, const NastranCard& user,
                          const std::function<Point(GlobalIndex, const NastranCard&)>& grid);

 private:
  struct Given {
    NastranCard card;
    Coordinates coordinates = Coordinates::rectangular;
    bool by_nodes = false;
    std::size_t first = 0;  ///< field of its number
    bool being_found = false;
    std::optional<LocalSystem> system;
  };
  std::map<GlobalIndex, Given> given_;
};

}  // namespace solidus::mesh
