/// Heat that is made within bodies: sources of a given power, and bodies that burn.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "heat/loads/exothermic.hpp"
#include "heat/loads/named_group.hpp"
#include "heat/loads/placed_load.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "linear/active_set.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

class BodySources {
 public:
  /// @param at_nodes  [body]: whether it stores its heat at the nodes. Sources are spread over the nodes as
  ///                  heat is stored, so that a uniform one warms them alike
  /// Throws InputError for a condition that names no body of the mesh.
  BodySources(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
              std::span<const char> at_nodes, const ThermalConditions& conditions);

  /// Whether a power varies with position.
  bool placed() const;
  /// Powers are their means over the window from here on. Collective where one varies with position; throws
  /// InputError, on every process, where it has no value that is allowed.
  void set_window(const LoadWindow& window);
  /// The longest time after which a load that moves still overlaps with itself; infinite where none moves
  /// (PlacedLoad::lasting). Collective.
  double lasting(double from, double to) const;
  /// The power of the bodies that burn, constant from here on until the next call.
  /// @param state       at the start of the step, of all local nodes; empty: nothing burns
  /// @param begin, end  of the step [s]
  void set_burning(const BurningState& state, double begin, double end);
  /// Temperatures at which the nodes of bodies that burn ignite, infinite at others; at a node of several
  /// such bodies the lowest one. [local node] [K]; empty where no body burns.
  const std::vector<double>& ignition() const { return ignition_; }
  /// Subtracts the heat of the owned nodes from what leaves them [W] and adds its magnitudes to `moved`;
  /// powers() are those of this call.
  void add_residual(std::span<double> out, double& moved);
  /// Adds the heat into owned nodes to `gain`, that out of them to `loss`, both positive [W].
  void add_supply(std::span<double> gain, std::span<double> loss) const;
  /// The least and the greatest heat of a node, at most and at least zero; of this process [W].
  std::pair<double, double> heat_range() const;
  /// The powers are zero until the next add_residual().
  void clear_powers();
  /// Collective.
  std::vector<NamedPower> powers() const;

 private:
  /// The source of a body as heat into its nodes.
  struct Volume {
    std::string name;
    PlaceFunction power, factor;
    /// Volume that counts for a node [m³].
    struct Share {
      Index node;
      double weight;
    };
    std::vector<Share> shares = {};          ///< where power and factor are the same everywhere
    std::vector<double> heat = {};           ///< into the owned nodes at the time set [W]
    std::unique_ptr<PlacedLoad> load = {};   ///< where power or factor differs from place to place
    std::optional<Exothermic> burning = {};  ///< its power comes from set_burning()
    bool placed() const { return !power.uniform() || !factor.uniform(); }
    void set_window(const LoadWindow& window);
    void burn(const BurningState& state, double begin, double end);
  };
  /// The mesh in which the sources are placed.
  struct Where {
    const mesh::Mesh& mesh;
    AnalysisKind kind;
    const linear::ActiveSet& active;
    std::span<const char> at_nodes;
  };
  void add_sources(const Where& where, const std::vector<Source>& sources);
  void add_burning(const Where& where, const std::vector<Exothermic>& exothermics);
  static void add_nodal_shares(const Where& where, int body, Volume& volume);
  static void place(const Where& where, int body, Volume& volume);

  std::vector<Volume> sources_;
  std::vector<double> powers_;  ///< of this process
  std::vector<double> ignition_;
};

}  // namespace solidus::heat
