/// Common base of all element kernels: on top of the points and their record the parts of the tangent that
/// are shared, the message of a step that failed and the volume that flows.
#pragma once

#include <fmt/format.h>

#include <limits>
#include <string>

#include "mechanics/elements/element_matrix.hpp"
#include "mechanics/elements/flow_directions.hpp"
#include "mechanics/elements/point_restart.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

template <class Law, int n_nodes, AnalysisKind kind, bool b_bar, int n_extra = 0>
class PointBlock : public PointRestart<Law, n_nodes, kind, b_bar, n_extra> {
  using Base = PointRestart<Law, n_nodes, kind, b_bar, n_extra>;

 public:
  using typename Base::Operator, typename Base::Properties, typename Base::Response, typename Base::Vectors;
  using Matrix = ElementMatrix<n_nodes, Operator::dim>;

  PointBlock(const mesh::Mesh& mesh, const mesh::ElementBlock& block, const material::Material& material)
      : Base(mesh, block, material), block_(block) {}

  std::size_t bytes() const override { return Base::bytes() + directions_.bytes(); }

 protected:
  using Base::counted, Base::effective_, Base::gather, Base::geometry_, Base::index, Base::law_,
      Base::properties_, Base::start_state, Base::update;

  void begin_step(const StepStart& start) {
    Base::begin_step(start);
    directions_.begin();
  }

  /// Adds a point of strain `strain` to the volume that flows.
  void add_flowing(Index batch, int q, const Sym<Lane>& strain, FlowingVolume& volume) const {
    const Lane share = counted(batch) * geometry_.weight_at(batch, q);
    volume.all += sum(share);
    if constexpr (RankOneTangent<Response>) {
      const Response response = update(batch, q, strain);
      volume.flowing += sum(select(response.flow_increment > Lane(0.0), share, Lane(0.0)));
    }
  }

  /// The first element of a batch whose law finds no state at these strains, with its inputs.
  LawFailure failure_at(Index batch, int q, const Sym<Lane>& strain) const {
    std::array<std::string, k_lanes> why;
    if constexpr (KeepsStateInPlace<Law>) {
      Workspace<Law> space(law_);
      space.failures = why.data();
      update(batch, q, strain, space);
    }
    for (int lane = 0; lane < k_lanes && batch * k_lanes + lane < geometry_.n_elements; ++lane) {
      const auto p =
          element_of<typename Law::template Properties<double>>(properties_[index(batch, q)], lane);
      const auto strain_of_one = element_of<Sym<double>>(strain, lane);
      if (!std::isfinite(norm(strain_of_one))) continue;  // that is not the law's fault
      const std::string start = failed_start(batch, q, lane, p, strain_of_one, why);
      if (start.empty()) continue;
      const double temperature = temperature_at(geometry_, batch, q, this->temperature_)[lane];
      return {fmt::format("element {}: temperature {:.6g} K, solid fraction {:.4g}, strain {}, {}",
                          block_.input_element[as_size(batch * k_lanes + lane)], temperature,
                          elastic_part(law_, p).solid_fraction, text(strain_of_one), start),
              temperature};
    }
    return {};
  }

  /// The state from which the law of an element found none, in words; empty if it found one.
  /// @param why  what a law whose state lies in place says itself, of each lane
  template <class PropertiesOfOne>
  std::string failed_start(Index batch, int q, int lane, const PropertiesOfOne& p, const Sym<double>& strain,
                           const std::array<std::string, k_lanes>& why) const {
    if constexpr (KeepsStateInPlace<Law>) {
      return why[as_size(lane)];
    } else {
      const auto start = element_of<typename Law::template State<double>>(start_state(batch, q), lane);
      if (law_.update(p, start, strain, effective_).status == material::Status::converged) return {};
      return "at the start of the step " + text(start);
    }
  }

  /// factor left ⊗ right; without a skew part left = share right.
  static void add_rank_one(const Operator& b, const Sym<Lane>& left, const Sym<Lane>& right, Lane factor,
                           Lane share, Matrix& symmetric, std::optional<Matrix>& skew) {
    Vectors of_right{};
    b.add_force(right, of_right);
    if (!skew) {
      add_product(of_right, factor * share, symmetric);
      return;
    }
    Vectors of_left{};
    b.add_force(left, of_left);
    add_product(of_left, of_right, factor, symmetric, *skew);
  }

  /// The part left ⊗ right of the tangent where metal flows, with the directions of FlowDirections.
  void add_flow(const Operator& b, Index batch, int q, const Response& response, Lane weight,
                Matrix& symmetric, std::optional<Matrix>& skew) requires RankOneTangent<Response> {
    const LaneMask flows = response.flow_increment > Lane(0.0);
    if (!any(flows)) return;
    const Sym<Lane>& n = response.right;  // of unit length
    const Lane c = dot(response.left, n);
    if (!follows_directions_) {
      add_rank_one(b, response.left, n, weight, c, symmetric, skew);
      return;
    }
    const Sym<Lane> m =
        directions_.at(index(batch, q), properties_.size(), response.relative_norm * n, flows, [&] {
          return isothermal_law(law_).loading(
              isothermal_part(law_, properties_[index(batch, q)]), start_state(batch, q),
              b.strain(gather(this->old_displacement_, batch)), effective_.dt);
        });
    Vectors of_left{}, of_right{};
    b.add_force(n, of_right);
    if (skew) {
      b.add_force(response.left + c * (m - n), of_left);
      add_product(of_left, of_right, weight, symmetric, *skew);
    } else {
      b.add_force(m, of_left);
      add_symmetric_product(of_left, of_right, weight * c, symmetric);
    }
  }

  /// Sets the forces to NaN, which Newton's iteration treats as a step that is too long.
  static void invalidate(Vectors& f) {
    for (auto& node : f)
      for (Lane& value : node) value = Lane(std::numeric_limits<double>::quiet_NaN());
  }

  static Lane squares(const Vectors& f) {
    Lane s(0.0);
    for (const auto& node : f)
      for (const Lane& value : node) s += value * value;
    return s;
  }

  const mesh::ElementBlock& block_;
  FlowDirections directions_;  ///< of the tangents since begin_step()
  /// Whether they are unknowns of their own: false for the consistent tangent.
  bool follows_directions_ = true;
};

}  // namespace solidus::mechanics
