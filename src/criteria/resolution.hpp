/// How well mesh and steps resolve the heat of the freezing, from the solution itself: what the errors of the
/// answers are estimated from (results/answers/answer_errors.hpp, docs/theory/step_and_mesh.md).
///
/// Mesh: the gradient g of temperature of each element against the mean G of the elements of its body around
/// each of its nodes, weighted by volume V (the recovery of Zienkiewicz and Zhu 1987, integrated at the
/// nodes):
///
///   η² = Σ_i Σ_{e at i} V_e |g_e − G_i|² / n_e  /  Σ_e V_e |g_e|²
///      = 1 − Σ_i |Σ_e (V_e/n_e) g_e|² / Σ_e (V_e/n_e)  /  Σ_e V_e |g_e|²
///
/// the square of the relative error of the flow of heat in its energy. Of each body the mean over the time in
/// which something freezes is kept. Quantities that integrate the flow are off by a multiple of η², not of η.
///
/// Step: the length of the step in which each node became solid.
#pragma once

#include <optional>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/patches.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

class Resolution : public Criterion {
 public:
  static constexpr const char* k_name = "resolution";
  /// @param freezes  [body] that is poured; the mesh is kept by reference
  Resolution(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<char> freezes);

  CriterionRecord initial(const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override { return {}; }
  void fill(const CriterionInput&, const CriterionRecord&,
            std::span<const std::span<double>>) const override {}
  std::size_t bytes() const override { return patches_.bytes(); }

  /// What a record tells.
  struct Told {
    std::vector<double> flow_error;         ///< mean of η², [body]; zero where nothing flowed
    std::span<const double> frozen_within;  ///< [local node] [s]; zero where a node has not frozen
  };
  /// Of the criteria of a run; nothing where they have no such record.
  static std::optional<Told> told(const CriteriaState& state);

 private:
  /// η² of every body. Collective.
  std::vector<double> flow_errors(std::span<const double> temperature) const;

  const mesh::Mesh& mesh_;
  std::vector<char> freezes_;    ///< [body]
  std::vector<Index> freezing_;  ///< owned nodes of bodies that freeze
  Patches patches_;
  parallel::GhostExchange ghosts_;
};

}  // namespace solidus::criteria
