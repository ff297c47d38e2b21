/// The closed rule's sensible heat in a printed form (sensible_form.hpp): its excess over the difference of
/// enthalpies, node by node.
///
///   r_i += Σ_m w_im (printed form − (h_1 − h_n))/Δt
#pragma once

#include <vector>

#include "heat/storage/nodal_enthalpy.hpp"
#include "heat/storage/sensible_form.hpp"
#include "linear/contribution.hpp"

namespace solidus::heat {

class PrintedHeat final : public linear::Contribution {
 public:
  /// Keeps a reference to the storage.
  PrintedHeat(const NodalEnthalpy& storage, SensibleForm form) : storage_(storage), form_(form) {}

  void add_to_graph(linear::NodeGraph&) const override {}
  void bind(const linear::BlockMatrix&) override {}
  void add_residual(std::span<const double> temperature, std::span<double> r) override;
  void add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) override;
  bool stores() const override { return true; }
  /// @param old_temperature Θ_n [K], [local node]. A single stage only.
  void begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> old_temperature) override;

 private:
  double sum(Index node, double temperature, double PrintedExcess::*part) const;

  const NodalEnthalpy& storage_;
  SensibleForm form_;
  std::vector<double> old_temperature_;  ///< [owned node]
  double dt_ = 1;
};

}  // namespace solidus::heat
