/// Strain told apart by the state of the metal in which it was taken, strain in the brittle range, and
/// distortion (docs/theory/melt.md).
///
/// An element is melt as long as its solid fraction is below the coherency fraction f_c. A step that begins
/// as melt leaves no strain in the solid, so the mean strain splits without rest,
///
///   ε = ε_c + (ε − ε_c),   ε_c the strain at coherency
///
///   strain_in_liquid        √(2/3 dev ε_c : dev ε_c)
///   strain_since_coherency  √(2/3 dev (ε − ε_c) : dev (ε − ε_c))
///   brittle_strain          the largest principal value of Σ χ dev Δε, χ the share of a step in which the
///                           solid fraction runs through the brittle range
///   distortion              the displacement since coherency without the best rigid motion of each body [m];
///                           a node is coherent from the moment, on a straight line through the step, at
///                           which all its elements are (coupling/coherency.hpp); until the end of that
///                           step it moves at the rate of the next one
///
/// Strains are measured by their deviators: thermal strain and the shrinkage of freezing are volumetric, so a
/// body that shrinks freely has none. Metal that melts again forgets. The solid fraction is the mean over the
/// element of that of its nodes at t_n, with which the law works too
/// (mechanics/state/phase_fields.hpp, 4.81).
///
/// Strain in the brittle range as a measure of hot tearing: W. S. Pellini, Strain theory of hot tearing,
/// Foundry 80 (1952) 125–199. The range: Y. M. Won, T.-J. Yeo, D. J. Seol, K. H. Oh, A new criterion for
/// internal crack formation in continuously cast steels, Metall. Mater. Trans. B 31 (2000) 779–794.
#pragma once

#include "criteria/criterion.hpp"
#include "criteria/element_strain.hpp"
#include "criteria/rigid_fit.hpp"
#include "material/material.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

class StrainCriteria : public Criterion {
 public:
  /// @param mesh         the active elements
  /// @param whole        all elements, in the same blocks, which are active as a whole or not at all: columns
  ///                     and fields are theirs. The same object where no body grows.
  /// @param materials    one per body of the mesh; kept by reference, as the meshes are
  /// @param temperature  of bodies without a thermal phase [K], [local node]; empty: there is one
  /// Collective.
  StrainCriteria(const mesh::Mesh& mesh, const mesh::Mesh& whole, AnalysisKind kind,
                 const std::vector<material::Material>& materials, std::vector<double> temperature = {});

  /// Nothing strained so far. Nodes and elements that never melt stay so.
  CriterionRecord initial(const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override;
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  /// The largest strain in the brittle range.
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;
  std::size_t bytes() const override;

 private:
  struct OfBlock {
    ElementStrain strain;
    const mesh::ElementBlock* block;
    const material::Casting* casting;
    const material::PhaseChange* freezing;  ///< null: always solid
    std::vector<Index> nodes;               ///< of a block that freezes, each once
    std::size_t first;                      ///< element in columns of cells
    std::span<const Index> nodes_of(Index element) const {
      return {block->element(element), as_size(mesh::node_count(block->shape))};
    }
  };
  std::span<const double> temperature(const CriterionInput& moment) const;
  void follow_displacement(const CriterionInput& old, const CriterionInput& next,
                           const std::vector<double>& soft, CriterionRecord& record) const;
  void begin_elements(std::span<const double> displacement, CriterionRecord& record) const;
  double solid_fraction(const material::PhaseChange& freezing, const CriterionInput& moment,
                        std::size_t node) const;

  const mesh::Mesh &mesh_, &whole_;
  std::size_t components_;
  std::vector<double> temperature_;
  std::vector<OfBlock> blocks_;
  std::vector<int> body_of_node_;  ///< [local node]: the first one that can melt, else the first one
  parallel::GhostExchange ghosts_;
  RigidFit rigid_;
};

}  // namespace solidus::criteria
