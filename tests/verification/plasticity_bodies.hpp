/// Bodies that yield, for the verification of plasticity.
#pragma once

#include <optional>

#include "mechanics_bodies.hpp"
#include "system/errors.hpp"

namespace solidus::verification {

/// Elastic and perfectly plastic, rate independent.
inline material::Material plastic_material(double young, double poisson, Table flow_stress,
                                           double expansion = 0) {
  material::Material m = test::elastic_material(young, poisson, expansion);
  m.name = "plastic";
  m.flow.emplace();
  m.flow->flow_stress = std::move(flow_stress);
  return m;
}

/// A body loaded step by step.
class March {
 public:
  explicit March(const test::Body& body)
      : body_(body), phase_(body.phase()), state_(phase_->initial_state()) {}

  /// One step to a time of the load's tables; false when it does not converge, and nothing has changed then.
  bool to(double time) {
    try {
      mechanics::MechanicalState trial = state_;
      report_ = phase_->solve(state_, trial, body_.temperature, time, time - time_);
      state_ = std::move(trial);
    } catch (const StepRejected&) {
      return false;
    }
    time_ = time;
    return true;
  }
  /// As far as it goes up to a time: the step is halved where it fails, down to a share of the time. @return
  /// the time reached
  double as_far_as(double time, double step, double smallest) {
    while (time_ < time && step >= smallest)
      if (!to(std::min(time, time_ + step))) step /= 2;
    return time_;
  }

  double time() const { return time_; }
  const mechanics::MechanicalState& state() const { return state_; }
  const mechanics::MechanicalReport& report() const { return report_; }
  std::vector<test::ElementFields> fields() const { return test::element_fields(phase_->mesh(), state_); }
  double u(Index node, int component) const {
    return state_
        .displacement[static_cast<std::size_t>(node * displacement_components(body_.kind) + component)];
  }

 private:
  const test::Body& body_;
  std::unique_ptr<mechanics::MechanicalPhase> phase_;
  mechanics::MechanicalState state_;
  mechanics::MechanicalReport report_;
  double time_ = 0;
};

/// The middle of an element.
inline mesh::Point centre(const mesh::Mesh& mesh, const mesh::ElementBlock& block, Index element) {
  mesh::Point x{};
  const int n = mesh::node_count(block.shape);
  for (int a = 0; a < n; ++a)
    for (std::size_t i = 0; i < 3; ++i)
      x[i] += mesh.x[static_cast<std::size_t>(block.element(element)[a])][i] / n;
  return x;
}

}  // namespace solidus::verification
