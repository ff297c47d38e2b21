/// Nodes without an equation for their temperature: those where it is prescribed, and those of bodies that
/// have left.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "heat/loads/named_group.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "heat/loads/thermal_state.hpp"
#include "linear/active_set.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

class PrescribedNodes {
 public:
  /// Throws InputError for a condition that names no group of nodes of the mesh.
  PrescribedNodes(const mesh::Mesh& mesh, const linear::ActiveSet& active,
                  const std::vector<PrescribedTemperature>& conditions);

  /// Whether a prescribed temperature varies with position.
  bool placed() const;
  /// Throws InputError where a function of position has no value that is allowed. Not collective.
  void set_time(double time);
  /// Writes the prescribed temperatures of the time set, ghosts too.
  void prescribe(std::span<double> temperature) const;
  /// [local node]: one where the temperature is prescribed, or stays because the bodies there have been
  /// removed.
  const std::vector<char>& fixed() const { return fixed_; }
  Index n_owned() const { return n_owned_; }  ///< nodes of this process
  /// The range of the temperatures of the time set on this process [K]; +∞ and −∞ where there is none.
  TemperatureRange range() const;
  /// Sums the reactions [owned node] of each prescribed temperature: heat into the body by it. Collective.
  std::vector<NamedPower> reaction_powers(std::span<const double> reactions) const;

 private:
  struct Prescribed {
    std::string name;
    PlaceFunction value;
    std::vector<Index> nodes;  ///< local; of the condition that holds
    std::vector<Position> x;   ///< of the nodes, where the value varies with position
    std::vector<double> now;   ///< [K], one a node
  };

  std::vector<Prescribed> prescribed_;
  std::vector<char> fixed_;
  Index n_owned_;
};

}  // namespace solidus::heat
