/// Pools of melt that are cut off from feeding, in which a casting freezes last (docs/theory/criteria.md).
///
/// Melt is where the solid fraction lies below a limit, beyond which feeding through the mushy zone ends. A
/// pool is a connected part of it, over the elements of all bodies that can melt. Pools keep their numbers
/// from step to step: of the parts of a pool that splits the largest keeps the number, every other one that
/// holds a whole element of melt is a new pool with the old one as its parent; smaller crumbs are none. Where
/// pools meet (metal melts again) the largest keeps its number. A pool is closed off from the moment it holds
/// no node of the feeders; without feeders, from the moment it split off. Melt of a body that leaves ends
/// with it and has not frozen.
#pragma once

#include <vector>

#include "criteria/connectivity.hpp"
#include "criteria/criterion.hpp"
#include "criteria/freezing_levels.hpp"
#include "heat/storage/nodal_enthalpy.hpp"

namespace solidus::criteria {

struct PoolOptions {
  double limit = 0.7;                ///< solid fraction, above 0 and at most 1
  std::vector<std::string> feeders;  ///< groups of the mesh (Mesh::node_sets)
  std::vector<char> bodies = {};     ///< [body] that are followed; empty: all that can melt
};

/// A row of the table "pools" of the record.
struct Pool {
  int number = 0, parent = 0;  ///< from one; parent zero: there from the start
  double born = 0;             ///< [s]
  double closed_off = -1;      ///< since when [s]; −1: it is not
  double frozen = -1;          ///< when the last node passed the limit [s]; −1: it has not
  int into = 0;                ///< the pool that it joined, else zero; k_left: it left with its body
  double volume = 0;           ///< that its nodes hold [m³]
  double largest = 0;          ///< the largest volume it had as a closed-off pool [m³]
  double solid_fraction = 0;   ///< mean over it
  double temperature = 0;      ///< of its hottest node [K]; frozen: of the last node
  mesh::Point where = {};      ///< place of that node [m]
  bool ended = false;          ///< in the step just taken
  bool present() const { return frozen < 0 && into == 0; }
  static constexpr int k_left = -1;
};

class Pools : public Criterion {
 public:
  /// Throws InputError for a feeder that is no group of the mesh.
  Pools(const mesh::Mesh& mesh, const heat::NodalEnthalpy& storage, PoolOptions options = {});

  CriterionRecord initial(const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  /// liquid_pool (number, 0: none), pool_volume [m³] and feeding_zone (number of the pool that a node was in
  /// last).
  std::span<const quantities::Quantity* const> fields() const override;
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  /// Returns the number of pools that were cut off, and when and where the largest of them froze.
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;

  static constexpr const char* k_name = "pools";
  static std::vector<Pool> pools(const CriterionRecord& record);

 private:
  /// Volume around an owned node of the active bodies that can melt [m³].
  double volume(std::size_t node) const;
  /// When a node of a pool passed the limit in a step [s]: its solid fraction grows evenly until it is solid.
  double passed_at(std::size_t node, const CriterionInput& old, const CriterionInput& next) const;
  /// Brings the record to `next`; `old` is null at the start.
  void track(const CriterionInput* old, const CriterionInput& next, CriterionRecord& record) const;

  const mesh::Mesh& mesh_;
  const heat::NodalEnthalpy& storage_;
  PoolOptions options_;
  std::vector<char> followed_;          ///< [body]
  std::vector<char> feeder_;            ///< [local node]
  std::vector<int> body_;               ///< [owned node]: that of which it holds most among them, else −1
  std::vector<FreezingLevels> levels_;  ///< per body
  double whole_ = 0;                    ///< over all processes [m³]
  parallel::GhostExchange ghosts_;
  Connectivity connectivity_;
};

}  // namespace solidus::criteria
