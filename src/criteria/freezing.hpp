/// Thermal criteria at the nodes of bodies that freeze: when and how fast, gradient, front speed, arm
/// spacing, Niyama (docs/theory/criteria.md).
///
/// A node freezes from the moment its temperature passes the liquidus (for an isothermal change: its heat
/// content leaves that of the melt) to the moment its solid fraction reaches one. Within a step temperature,
/// on an isothermal change the heat content, is taken as linear in time, so times are exact where it is.
/// Gradient G and cooling rate Ṫ are taken when the temperature passes
///
///   T_e = T_S + x (T_L − T_S),   x = 0.1
///
/// (Carlson and Beckermann 2009). G is the mean over elements of the body around the node, weighted by
/// volume:
///
///   mushy  of all of them, where the elements resolve the freezing range;
///   sharp  of those behind the front, and over the time in which it passes the node, where the temperature
///          differs more across an element behind the front than between T_e and the liquidus (pure metals
///          always).
///
/// The isotherm T_e arrives at t_e(x), so that ∇T = Ṫ ∇t_e: the front speed is v = 1/|∇t_e|, and Ṫ = |∇T| v.
/// Both take means of magnitudes, for fronts that meet are as fast as others; G, the magnitude of a mean,
/// vanishes there. The rate of a single node is not that of the isotherm: it rests while the node gives off
/// its latent heat. It stands in where t_e is the same all around.
///
/// A node that freezes before every neighbour (at the mould) has nothing behind it: it waits for its first
/// element to be passed. Metal that melts again beyond T_e forgets, and is told by its next freezing;
/// where it stays colder it keeps G and Ṫ, and the time that it was solid does not count as solidification.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/freezing_levels.hpp"
#include "criteria/hot_tearing.hpp"
#include "criteria/niyama.hpp"
#include "criteria/patches.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

struct FreezingOptions {
  double evaluation = 0.1;        ///< x, at least 0 and below 1
  std::vector<char> bodies = {};  ///< [body] that are followed; empty: all that can melt
};

class Freezing : public Criterion {
 public:
  /// @param storage  of the thermal phase; kept by reference, as the mesh is
  Freezing(const mesh::Mesh& mesh, AnalysisKind kind, const heat::NodalEnthalpy& storage,
           FreezingOptions options = {});

  CriterionRecord initial(const CriterionInput& start) const override;
  /// Keeps of bodies that are solid when others are poured where and when their last melt froze.
  CriterionRecord restart(const CriterionRecord& before, const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  /// Where and when the last melt of a body froze.
  struct LastMelt {
    int body = -1;
    double time = 0;      ///< since the body was poured [s]
    mesh::Point where{};  ///< [m]
  };
  /// Of the bodies that were solid before the last pour.
  static std::vector<LastMelt> frozen_before(const CriteriaState& state);
  /// fields::k_of_freezing; the mark for no value where the node has not frozen, or where the material does
  /// not say.
  std::span<const quantities::Quantity* const> fields() const override;
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  /// The last node to freeze, and least and greatest values of the criteria.
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;
  /// Without it nothing is reported of plate_thickness.
  void know_plates(std::span<const PlateTimes> plates) override {
    plates_.assign(plates.begin(), plates.end());
  }
  std::size_t bytes() const override;

 private:
  /// Freezing levels of a body.
  struct Levels : FreezingLevels {
    double evaluation = 0;  ///< T_e [K]
    bool at_end = false;    ///< that is where the last melt freezes
  };
  struct FreezingNode {
    Index node;
    int body;
  };
  /// A node that passed T_e in this step, at the share `at` of it.
  struct Passage {
    FreezingNode who;
    double at, rate;
  };
  struct Step;
  struct PatchGradient;

  void follow(const FreezingNode& who, const Step& step, std::span<double> history,
              std::vector<Passage>& passages) const;
  /// Gradients of a node's patch with temperatures at the share `at` of the step.
  /// @param only_behind  of the elements that the front has passed
  PatchGradient recover(const FreezingNode& who, const Step& step, double at, std::span<const double> history,
                        bool only_behind) const;
  void accumulate(const FreezingNode& who, const Step& step, std::span<double> history) const;
  void evaluate(const Passage& passage, const Step& step, std::span<double> history) const;
  void complete(const FreezingNode& who, const Step& step, std::span<double> history) const;
  /// The body by which an owned node is told: that of which it holds most; −1: none that freezes.
  int body_of(Index node, const std::vector<char>& chosen) const;
  std::vector<double> front_speeds(std::span<const double> history) const;
  static constexpr std::size_t k_fields = 14;
  std::vector<CriterionResult> shares_beyond(const CriterionRecord& record,
                                             std::span<const double> speeds) const;
  static std::array<double, k_fields> nothing_known();
  static constexpr const char* k_name = "freezing";
  static constexpr int k_row = 5;  ///< of a LastMelt in the table "frozen"
  /// All fields of a node, in their order.
  /// @param speed  of the front there
  std::array<double, k_fields> values_of(const FreezingNode& who, std::span<const double> history,
                                         double speed) const;

  const mesh::Mesh& mesh_;
  const heat::NodalEnthalpy& storage_;
  std::vector<Levels> levels_;                      ///< per body
  std::vector<std::optional<FeedingLaw>> feeding_;  ///< per body
  std::vector<std::optional<TearingLaw>> tearing_;  ///< per body
  std::vector<double> kou_;                         ///< per body: Kou's index [K]
  std::vector<double> held_;  ///< per body: strain rate of its mush, if its ends were held, over G Ṫ [m/K²]
  std::vector<PlateTimes> plates_;   ///< per body; empty: not known
  std::vector<FreezingNode> nodes_;  ///< owned
  Patches patches_;                  ///< lists of nodes within step() alone
  parallel::GhostExchange ghosts_;
};

}  // namespace solidus::criteria
