/// Hot tears by the strain that mush takes in a coupled run.
///
/// *Rappaz, Drezet, Gremaud.* The drop of the melt's pressure at the root (hot_tearing.hpp) with the strain
/// rate, gradient and rate of cooling of each element, means over the time in which its solid fraction goes
/// from coherency to the root:
///
///   strained_tendency = Δp(ε̇, G, Ṫ, λ₂)/Δp_c,   ε̇ = ε/t
///
/// ε the largest principal value of the sum of the increments of the strain deviator, t that time; λ₂ of the
/// time since the element began to freeze. From one on a pore opens between the grains. Where grains bridge
/// before the network is coherent (alloys with much eutectic) no strain is taken and shrinkage alone lowers
/// the pressure.
///
/// *Won, Yeo, Seol, Oh.* The strain ε_B taken in the brittle range of solid fractions (casting.brittle_range,
/// from which melt no longer comes to a crack, to where nothing is liquid) over the critical one
///
///   cracking_index = ε_B/ε_c,   ε_c = φ/(ε̇^m ΔT_B^n),   ε̇ = ε_B/t_B
///
/// ΔT_B [K] the width of the range by the card's curve, t_B [s] the time in it. Fitted to tests of carbon
/// steels in which a solidifying shell is bent or drawn, φ = 0.02821, m = 0.3131, n = 0.8638.
///
/// Sources: M. Rappaz, J.-M. Drezet, M. Gremaud, Metall. Mater. Trans. A 30 (1999) 449–455. Y. M. Won,
/// T.-J. Yeo, D. J. Seol, K. H. Oh, A new criterion for internal crack formation in continuously cast steels,
/// Metall. Mater. Trans. B 31 (2000) 779–794.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/element_strain.hpp"
#include "criteria/hot_tearing.hpp"
#include "material/material.hpp"

namespace solidus::criteria {

/// ε_c of Won, Yeo, Seol and Oh.
/// @param rate  [1/s], above zero
/// @param width  ΔT_B [K], above zero
/// @pre casting.crack_strain
double critical_crack_strain(const material::Casting& casting, double rate, double width);

class MushStrain : public Criterion {
 public:
  /// @param mesh       the active elements
  /// @param whole      all elements, in the same blocks: columns and fields are theirs
  /// @param materials  one per body of the mesh; kept by reference, as the meshes are
  MushStrain(const mesh::Mesh& mesh, const mesh::Mesh& whole, AnalysisKind kind,
             const std::vector<material::Material>& materials);

  /// Whether one of the materials says something of either.
  static bool has_something_to_say(const std::vector<material::Material>& materials);

  CriterionRecord initial(const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override;
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  /// Largest values, and the shares of the volume beyond the thresholds.
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;
  std::size_t bytes() const override;

 private:
  struct OfBlock {
    ElementStrain strain;
    const mesh::ElementBlock* block;
    const material::Material* material;
    std::optional<TearingLaw> tearing;
    double root = 1;           ///< solid fraction at which grains bridge
    double brittle_width = 0;  ///< ΔT_B [K]
    std::size_t first = 0;     ///< element in columns of cells
    std::vector<Index> nodes;  ///< each once
  };
  static constexpr std::size_t k_fields = 2;
  std::array<double, k_fields> values_of(const OfBlock& block, std::span<const double> row) const;

  const mesh::Mesh &mesh_, &whole_;
  std::vector<OfBlock> blocks_;                      ///< those that freeze over a range
  std::vector<const quantities::Quantity*> fields_;  ///< those that the materials say something of
  std::vector<std::size_t> which_;                   ///< their places in fields::k_of_mush_strain
};

}  // namespace solidus::criteria
