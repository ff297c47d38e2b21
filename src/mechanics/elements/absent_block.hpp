/// A mesh block that takes no part in mechanics: of a body that only conducts heat or that has been removed.
/// No stiffness, stress, history, weight or structural heat; results show zero in its elements.
#pragma once

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/coupled_kernel.hpp"

namespace solidus::mechanics {

class AbsentBlock final : public BlockKernel, public CoupledKernel {
 public:
  bool symmetric() const override { return true; }
  void bind(const linear::BlockMatrix&) override {}
  bool set_initial_stress(const StepStart&, std::span<const double>) override { return true; }
  BlockHistory initial_history() const override { return {}; }
  double prepare(const StepStart&) override { return 0; }
  double add_forces(std::span<const double>, std::span<double>) override { return 0; }
  void add_tangent(std::span<const double>, linear::BlockMatrix&) override {}
  BlockWork finish(std::span<const double>, std::span<const double>, const BlockEnd&) override { return {}; }
  FlowChange restart_flow(const StepStart&, std::span<const double>, std::span<const double>,
                          const BlockEnd&) override {
    return {};
  }
  std::shared_ptr<const StructuralPoints> held_deformation(const StepStart&) override { return {}; }
  LawFailure failure(std::span<const double>) const override { return {}; }
  FlowingVolume flowing(std::span<const double>) const override { return {}; }
  void add_nodal_volume(double, std::span<double>) const override {}

  void spread_heat_as_stored(const PackVector<Lane>&) override {}
  std::size_t bytes() const override { return 0; }

  void bind_heat(const linear::BlockMatrix&) override {}
  void add_coupling(const CoupledIterate&, linear::CoupledMatrix&) override {}
  void carry(double, const StructuralPoints*, std::span<const double>) override {}
  std::shared_ptr<const StructuralPoints> drop_carried() override { return {}; }
};

}  // namespace solidus::mechanics
