/// Systems are kept as cards and found when a node asks for one, with whatever systems they are given in.
#include "mesh/files/nastran_systems.hpp"

namespace solidus::mesh {

bool NastranSystems::take(const NastranCard& card) {
  const std::string& name = card.name;
  // CORD1R to CORD2S: by three nodes or by coordinates, of three kinds.
  if (name.size() != 6 || !name.starts_with("CORD") || (name[4] != '1' && name[4] != '2')) return false;
  Given given{card, Coordinates::rectangular, name[4] == '1', 0, false, {}};
  if (name[5] == 'C')
    given.coordinates = Coordinates::cylindrical;
  else if (name[5] == 'S')
    given.coordinates = Coordinates::spherical;
  else if (name[5] != 'R')
    return false;
  // The number of the system, and from where its points are in the entry.
  const auto keep = [&](std::size_t first) {
    given.first = first;
    if (!given_.emplace(card.integer(first), given).second)
      card.fail("the coordinate system " + card.fields[first] + " is defined twice");
  };
  if (!card.has(0)) card.fail(name + " has no number");
  keep(0);
  if (given.by_nodes && card.has(4)) keep(4);  // an entry of nodes may hold two systems
  return true;
}

const LocalSystem& NastranSystems::find(GlobalIndex number, const NastranCard& user,
                                        const std::function<Point(GlobalIndex, const NastranCard&)>& grid) {
  static const LocalSystem k_global{};
  if (number == 0) return k_global;
  const auto found = given_.find(number);
  if (found == given_.end())
    user.fail(user.name + ": there is no coordinate system " + std::to_string(number),
              "CORD1R, CORD1C, CORD1S, CORD2R, CORD2C or CORD2S of this number");
  Given& given = found->second;
  if (given.system) return *given.system;
  // A system that is needed to find itself would never end.
  if (given.being_found) given.card.fail(given.card.name + ": the system is given in itself");
  given.being_found = true;
  // Its three points: places of nodes, or coordinates in another system, which is found first.
  std::array<Point, 3> points{};
  if (given.by_nodes) {
    for (std::size_t k = 0; k < 3; ++k) points[k] = grid(given.card.integer(given.first + 1 + k), given.card);
  } else {
    const LocalSystem& in = find(given.card.integer(1), given.card, grid);
    for (std::size_t k = 0; k < 3; ++k)
      points[k] =
          in.global({given.card.real(2 + 3 * k), given.card.real(3 + 3 * k), given.card.real(4 + 3 * k)});
  }
  // The second point lies on the third axis, the third one in the plane of the first and the third axis.
  const auto axes = axes_along(difference(points[1], points[0]), difference(points[2], points[0]));
  if (!axes) given.card.fail(given.card.name + ": the three points of the system lie on one line");
  const auto& [z, x, y] = *axes;
  given.system = LocalSystem{points[0], {x, y, z}, given.coordinates};
  return *given.system;
}

}  // namespace solidus::mesh
