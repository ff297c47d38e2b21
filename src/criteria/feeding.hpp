/// Feeding with heat alone: where the metal that shrinks takes its volume from (docs/theory/feeding.md).
///
/// Metal is balanced around each node (feeding_nodes.hpp): it fills the room that is not empty, V_i F_i, with
/// n_i = F_i/v_i (metal_volume.hpp). Until its last melt freezes it stays full:
///
///   - a node of a pool, metal below coherency that is connected, takes what it needs from the pool;
///   - mush beyond coherency is fed through its dendrites (mush_flow.hpp) and gets pores where melt does not
///     come through, or where no pool is connected;
///   - a pool sinks at its surface that is open to the atmosphere: a pipe. Without one it draws in the skin
///     that is still soft: a sink. Behind a coherent skin it leaves a cavity below its highest point. All
///     three empty from the top down (feeding_levels.hpp).
///
/// Gas that does not stay in solution takes room of its own (gas_law.hpp): melt has to give way to it, and
/// mush that shrinks draws its pores larger before others open. Graphite that expands feeds, but for the
/// share that the wall of the mould gives way to. Solid metal contracts at the expense of the outside. So at
/// all times
///
///   pipe + sink + cavity + pores + gas − wall + outside = contraction of melt, of freezing and of solid
///
/// whose left side is a sum over the state and whose right side is summed over the steps, metal that moves
/// from v_i to v_j included. Metal is neither lost nor made.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "criteria/connectivity.hpp"
#include "criteria/criterion.hpp"
#include "criteria/feeding_graph.hpp"
#include "criteria/feeding_nodes.hpp"
#include "criteria/mush_flow.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

struct DrainedNode;
struct PoolLevel;

/// Volumes of a run so far [m³], in two dimensions per depth or revolution.
struct FeedingTotals {
  double room = 0;                                                ///< of the castings as poured
  double melt = 0, freezing = 0, solid = 0;                       ///< contractions
  double pipe = 0, sink = 0, cavity = 0, pores = 0, outside = 0;  ///< what they took their volume from
  double gas = 0;                                                 ///< pores of gas
  double wall = 0;  ///< by which the wall of the mould has given way: the castings hold more by it
  /// The difference of both sides of the balance, as a share of the room.
  double defect() const {
    const double taken = pipe + sink + cavity + pores + gas - wall + outside;
    return room > 0 ? (taken - melt - freezing - solid) / room : 0;
  }
};

/// A hole that is connected.
struct FeedingHole {
  enum class Kind { pipe, cavity, sink };
  Kind kind = Kind::pipe;
  double volume = 0;    ///< [m³]
  mesh::Point where{};  ///< of a pipe its lowest place, of others their middle [m]
  double depth = 0;     ///< of a pipe from its highest to its lowest place [m]
  double left = 0;      ///< of a pipe from there to the lowest place of its body [m]
  int body = -1;        ///< that has its lowest place, of others the node that lost most
};

struct CriterionContext;  // criteria/criterion_kind.hpp

class Feeding : public Criterion {
 public:
  static constexpr const char* k_name = "feeding";
  /// @param storage  of the thermal phase; kept by reference, as the mesh is
  Feeding(const mesh::Mesh& mesh, AnalysisKind kind, const heat::NodalEnthalpy& storage,
          const FeedingOptions& options);
  /// Whether a run follows it: with heat alone, where the case does not switch it off, and where metal
  /// changes its volume.
  static bool follows(const CriterionContext& c);
  /// Whether a material that is followed changes its volume; else there is nothing to feed.
  static bool has_shrinkage(const std::vector<material::Material>& materials,
                            const std::vector<char>& followed);

  CriterionRecord initial(const CriterionInput& start) const override;
  CriterionRecord restart(const CriterionRecord& before, const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override;
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;
  std::size_t bytes() const override;

  static FeedingTotals totals(const CriterionRecord& record);

 private:
  struct Step;
  double room(std::size_t node) const;
  std::vector<double> most_wall(const FeedingOptions& options) const;
  bool has_gas() const {
    return std::ranges::any_of(gas_, [](const std::optional<GasLaw>& law) { return law.has_value(); });
  }
  const MetalVolume& metal_of(std::size_t node) const { return *metals_[as_size(body_[node])]; }
  void measure(const CriterionInput& old, const CriterionInput& next, Step& step) const;
  void blow(std::size_t node, Step& step) const;
  double wall_yields(std::size_t node, const CriterionInput& old, const CriterionInput& next,
                     const Step& step) const;
  /// A line through the present gas of a node.
  struct GasLine {
    double pressure = 0, slope = 0;  ///< of the melt [Pa], of the share of the room [1/Pa]
  };
  GasLine gas_line(const Step& step, std::size_t node) const;
  static void grow_gas(Step& step, std::size_t node, const GasLine& line, double pressure);
  void draw_gas(Step& step, std::size_t node) const;
  double most_drop(const Step& step, std::size_t node) const;
  void open_in_mush(Step& step, std::size_t node, double metal, double drop) const;
  void feed(Step& step) const;
  void leave_out_absent(Step& step) const;
  void find_pools(Step& step) const;
  bool asks_in_mush(const Step& step) const;
  void feed_mush(Step& step) const;
  struct PoolStock {
    std::vector<double> asked;      ///< by the mush of each region [m³]
    std::vector<double> has;        ///< each pool [m³]
    std::vector<double> region_of;  ///< each pool; −1: none
  };
  static PoolStock stock_of_pools(const Step& step, const std::vector<int>& region, std::size_t n_regions);
  void share_among_pools(Step& step, const std::vector<double>& from_pool, const std::vector<int>& region,
                         std::size_t n_regions) const;
  static void open_pores(Step& step, std::size_t node, double metal);
  /// The share of a room that can leave a node.
  static double movable(const Step& step, std::size_t node);
  static double reached_at_first(const Step& step, std::size_t node);
  void drain(Step& step) const;
  static void leave_unfed(Step& step, std::vector<double> missing);
  void refill(Step& step) const;
  std::vector<double> drain_from(Step& step, std::vector<double>& reached, const std::vector<double>& asked,
                                 bool at_surface) const;
  bool spread(const Step& step, const std::vector<PoolLevel>& level, std::vector<double>& reached) const;
  static void empty(Step& step, const DrainedNode& d, double gain, bool at_surface);
  void commit(Step& step, FeedingTotals& totals) const;
  /// Pipes, cavities and sinks, the largest first of each kind, without those that are next to nothing.
  std::vector<FeedingHole> holes(const CriterionRecord& record) const;
  /// The height of the lowest place of a body [m].
  double lowest_of(int body) const;
  CriterionResult densest_pores(const CriterionRecord& record) const;

  const mesh::Mesh& mesh_;
  const heat::NodalEnthalpy& storage_;
  std::vector<char> followed_;  ///< [body]
  Upward up_;
  parallel::GhostExchange ghosts_;
  Connectivity connectivity_;
  FeedingGraph graph_;
  std::vector<std::optional<MetalVolume>> metals_;  ///< [body], of those that are followed
  std::vector<MushLaw> laws_;                       ///< [body]
  std::vector<std::optional<GasLaw>> gas_;          ///< [body]
  double rigidity_;                                 ///< of the mould
  /// The room that the wall gives way to at most, as a share of that of a body, [body]; empty: no limit.
  std::vector<double> most_wall_;
  std::vector<int> body_;  ///< [local node]: that of which it holds most among them, else −1
};

}  // namespace solidus::criteria
