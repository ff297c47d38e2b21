/// Gas pores of a run in which feeding with heat alone is not followed: with mechanics, or switched off. The
/// melt is at the pressure of the surroundings (gas_law.hpp).
#pragma once

#include <optional>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/gas_law.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

class GasPores : public Criterion {
 public:
  /// Null where no body that is followed holds gas.
  static std::unique_ptr<GasPores> make(const mesh::Mesh& mesh, const heat::NodalEnthalpy& storage,
                                        const std::vector<char>& followed, const GasOptions& options);
  GasPores(const mesh::Mesh& mesh, const heat::NodalEnthalpy& storage,
           std::vector<std::optional<GasLaw>> laws);

  CriterionRecord initial(const CriterionInput& start) const override;
  void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) override;
  std::span<const quantities::Quantity* const> fields() const override;
  void fill(const CriterionInput& now, const CriterionRecord& record,
            std::span<const std::span<double>> values) const override;
  std::vector<CriterionResult> findings(const CriterionRecord& record) const override;

 private:
  const mesh::Mesh& mesh_;
  std::vector<std::optional<GasLaw>> laws_;  ///< [body]
  struct Node {
    Index node;
    int body;     ///< with gas, of which it holds most
    double room;  ///< [m³]
  };
  std::vector<Node> nodes_;  ///< owned
  parallel::GhostExchange ghosts_;
};

/// Volume of gas pores, the room that it is a share of, and where they are densest. Collective.
/// @param pores  share of the room [owned node]
/// @param room   [m³], [owned node]
std::vector<CriterionResult> gas_findings(const mesh::Mesh& mesh, std::span<const double> pores,
                                          std::span<const double> room);

}  // namespace solidus::criteria
