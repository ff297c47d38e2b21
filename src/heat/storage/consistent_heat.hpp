/// The open rule next to bodies that keep their heat at the nodes (monograph 6.3).
///
/// A Gauss point has no heat content of its own, so where a material has an isothermal change nothing there
/// would tell how much is solid. Bodies of such a material store their heat at the nodes under the open rule
/// too, and the enthalpy of the nodes is the unknown (enthalpy_newton.hpp). For the other bodies this term
/// replaces the storage at the nodes by that at Gauss points,
///
///   r_i += Σ_e ∫N_i (h(Θ) − h*)/Δt dV − Σ_m w_im [h_m(Θ_i) − h*_m(Θ_i)]/Δt                          [W]
///
/// Without phase changes at one temperature both are functions of the temperature alone.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "heat/storage/nodal_enthalpy.hpp"
#include "heat/storage/point_storage.hpp"
#include "linear/contribution.hpp"

namespace solidus::heat {

/// By how much more points have taken up than nodes, on this process.
class HeatAtPoints {
 public:
  /// Keeps references.
  /// @param from  what the nodes have held at the start of the stage, [owned node] [J]
  HeatAtPoints(const std::vector<std::unique_ptr<PointStorage>>& points, const NodalEnthalpy& nodes,
               std::span<const double> from)
      : points_(points), nodes_(nodes), from_(from) {}

  /// Since the start of the stage, at a temperature [local node] [J].
  double stored(std::span<const double> temperature) const;
  /// Latent heat between two temperatures [J].
  double latent(std::span<const double> from, std::span<const double> to) const;
  EntropyChange entropy_change(std::span<const double> from, std::span<const double> to) const;  ///< [J/K]
  /// The whole content [J].
  double enthalpy(std::span<const double> temperature) const;

 private:
  const std::vector<std::unique_ptr<PointStorage>>& points_;
  const NodalEnthalpy& nodes_;
  std::span<const double> from_;
};

class ConsistentHeat final : public linear::Contribution {
 public:
  /// @param points  storage of the blocks of these bodies; must outlive this object, as the mesh must
  /// @param nodes   what the nodes hold of them
  ConsistentHeat(const mesh::Mesh& mesh, const std::vector<std::unique_ptr<PointStorage>>& points,
                 NodalEnthalpy nodes);

  /// Bodies have left or come back.
  void set_active(const linear::ActiveSet& active) { nodes_.set_active(active); }
  /// Off: a steady state stores nothing.
  void use(bool on) { on_ = on; }

  void add_to_graph(linear::NodeGraph&) const override {}
  void bind(const linear::BlockMatrix&) override {}
  void add_residual(std::span<const double> temperature, std::span<double> r) override;
  void add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) override;
  bool stores() const override { return true; }
  /// @param before  Θ_n in the first stage, that of the first one in the second [K], [local node]
  void begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> before) override;

  HeatAtPoints surplus() const { return {points_, nodes_, from_}; }
  std::size_t bytes() const { return nodes_.bytes(); }

 private:
  const std::vector<std::unique_ptr<PointStorage>>& points_;
  NodalEnthalpy nodes_;
  std::vector<double> from_;   ///< h*_m w_im summed, [owned node] [J]
  std::vector<double> local_;  ///< work, [local node]
  double dt_ = 1;
  bool on_ = true;
};

}  // namespace solidus::heat
