/// Thermo-mechanical bodies driven by the splits, and what every step reports of the first law.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "admissible_ambient.hpp"
#include "coupling/block_iterative.hpp"
#include "coupling/double_pass.hpp"
#include "coupling/internal_energy.hpp"
#include "coupling/isentropic_split.hpp"
#include "coupling/isothermal_split.hpp"
#include "coupling/simultaneous.hpp"
#include "mechanics_bodies.hpp"

namespace solidus::verification {

/// Input of a coupled run. `form` absent: deformation exchanges nothing with heat.
struct Coupled {
  mesh::Mesh mesh;
  AnalysisKind kind = AnalysisKind::plane_strain;
  std::vector<material::Material> materials;  ///< one per body
  std::vector<double> start;                  ///< [K], one per body
  mechanics::MechanicalConditions mechanical;
  heat::ThermalConditions thermal;
  std::optional<contact::ContactParameters> contact;
  std::optional<mechanics::StructuralForm> form;
  mechanics::Mapping mapping = mechanics::Mapping::isothermal;  ///< which makes the split
  heat::HeatIntegration integration = heat::HeatIntegration::closed;
  std::optional<mechanics::DynamicsOptions> dynamics;  ///< absent: no inertia
  double mechanics_tolerance = 1e-11;                  ///< of Newton's method
  mechanics::Simplices simplices = mechanics::Simplices::automatic;
  mechanics::Stabilisation stabilisation = mechanics::Stabilisation::orthogonal;
  heat::SensibleForm sensible = heat::SensibleForm::enthalpy;
  std::optional<heat::ThermalStepping> stepping;  ///< of the thermal phase of a split; absent: backward Euler
  coupling::SimultaneousOptions simultaneous;     ///< with Mapping::simultaneous
  bool double_pass = false;                       ///< with either mapping of a split
  coupling::PhaseOrder order = coupling::PhaseOrder::mechanics_first;  ///< of the sequential splits
  double gap_tolerance = 1;                                            ///< of them with heat first
  /// The same of the sequential splits and of the double pass.
  coupling::ThermalFlow thermal_flow = coupling::ThermalFlow::kept;
  /// Present: passes of `mapping` in alternation until they agree.
  std::optional<coupling::IterationOptions> iteration;
  /// Θ_a of 𝓛; absent: as the conditions say, where they are admissible (admissible_ambient.hpp).
  std::optional<double> ambient;

  /// Every node of a group at rest in a direction, or as the table says.
  void hold(const std::string& group, int component, Table value = 0.0) {
    mechanical.displacements.push_back({group, component, std::move(value)});
  }
};

struct CoupledRun {
  std::vector<coupling::EnergyAudit> steps;
  std::vector<coupling::StabilityAudit> stability;  ///< zero without an ambient temperature
  std::vector<int> iterations;                      ///< between the phases, of every step
  coupling::State end;

  double exchanged() const {
    double sum = 0;
    for (const auto& step : steps) sum += step.heat_exchanged;
    return sum;
  }
  /// The defects of all steps added up, with their signs [J].
  double defect() const {
    double sum = 0;
    for (const auto& step : steps) sum += step.defect();
    return sum;
  }
  /// The largest of a single step [J].
  double worst_defect() const {
    double worst = 0;
    for (const auto& step : steps) worst = std::max(worst, std::abs(step.defect()));
    return worst;
  }
};

/// The phases of a body and the scheme that drives them. Their criteria are at round-off, so that what is
/// seen is the scheme's. Keeps references to the body.
class Assembly {
 public:
  /// @param end  of the run that is to come [s]
  Assembly(const Coupled& c, double end)
      : ambient_(c.ambient ? c.ambient
                           : admissible_ambient(c.thermal, c.mechanical, c.contact, c.start, end)),
        falls_(c.form && c.mapping == mechanics::Mapping::isentropic && !c.iteration && !c.dynamics &&
               !c.double_pass) {
    std::vector<linear::Contribution*> mechanical, thermal;
    if (c.contact) {
      std::vector<double> moduli;
      for (const auto& m : c.materials) moduli.push_back(m.young_modulus.max_value());
      pair_.emplace(c.mesh, c.kind, *c.contact, moduli);
      mechanical.push_back(&pair_->parts().forces.term());
      if (pair_->parts().heat.term() != nullptr) thermal.push_back(pair_->parts().heat.term());
    }
    std::vector<double> initial(c.mesh.x.size());
    for (const mesh::ElementBlock& block : c.mesh.blocks)
      for (const Index node : block.nodes)
        initial[static_cast<std::size_t>(node)] = c.start[static_cast<std::size_t>(block.body)];

    mechanics::MechanicsOptions mechanics_options = test::strict();
    mechanics_options.newton.max_iterations = 60;
    mechanics_options.newton.tolerance = c.mechanics_tolerance;
    mechanics_options.mapping = c.mapping;
    mechanics_options.dynamics = c.dynamics;
    mechanics_options.simplices = c.simplices;
    mechanics_options.stabilisation = c.stabilisation;
    mechanics_options.symmetric = !pair_ || pair_->parts().forces.symmetric();
    mechanics_.emplace(c.mesh, c.kind, c.materials, initial, c.mechanical, mechanics_options, mechanical);
    if (c.form)
      thermal.push_back(
          &structural_.emplace(*mechanics_, *c.form, c.integration == heat::HeatIntegration::closed));

    heat::HeatOptions heat_options;
    heat_options.integration = c.integration;
    heat_options.sensible = c.sensible;
    heat_options.stepping = c.stepping;
    heat_options.tolerance = 1e-12;
    heat_options.solver = linear::SolverKind::direct;
    heat_options.symmetric = !pair_ || pair_->parts().heat.symmetric();
    heat_.emplace(c.mesh, c.kind, c.materials, c.thermal, heat_options, thermal);

    coupling::Phases& phases = phases_;
    phases.heat = &*heat_;
    phases.mechanics = &*mechanics_;
    phases.structural = structural_ ? &*structural_ : nullptr;
    phases.ambient_temperature = ambient_;
    if (pair_) phases.contacts = {&*pair_};
    if (c.iteration)
      scheme_ = std::make_unique<coupling::BlockIterative>(phases, *c.iteration);
    else if (c.double_pass)
      scheme_ = std::make_unique<coupling::DoublePass>(phases, c.thermal_flow);
    else if (c.mapping == mechanics::Mapping::isentropic)
      scheme_ = std::make_unique<coupling::IsentropicSplit>(
          phases, coupling::SequentialOptions{
                      .order = c.order, .flow = c.thermal_flow, .gap_tolerance = c.gap_tolerance});
    else if (c.mapping == mechanics::Mapping::simultaneous)
      scheme_ = std::make_unique<coupling::SimultaneousScheme>(phases, c.simultaneous);
    else
      scheme_ = std::make_unique<coupling::IsothermalSplit>(
          phases, coupling::SequentialOptions{
                      .order = c.order, .flow = c.thermal_flow, .gap_tolerance = c.gap_tolerance});

    start_.heat = heat_->states().initial(c.start);
    start_.mechanics = mechanics_->initial_state();
  }

  const coupling::State& start() const { return start_; }
  const heat::ThermalPhase& heat() const { return *heat_; }
  const mechanics::MechanicalPhase& mechanics() const { return *mechanics_; }
  coupling::CouplingScheme& scheme() { return *scheme_; }
  const coupling::Phases& phases() const { return phases_; }

  /// A step of the scheme from `old` to `trial`. Where the conditions are admissible, every quasi-static step
  /// of the isentropic split is checked not to raise 𝓛 and to make entropy.
  coupling::StepEffort advance(const coupling::State& old, coupling::State& trial, double time, double dt) {
    trial = old;
    trial.time = time;
    const coupling::StepEffort effort = scheme_->advance(old, trial, time, dt);
    if (falls_ && ambient_) {
      const coupling::StabilityAudit& l = effort.stability;
      EXPECT_LE(l.increment(), l.tolerance) << "step of " << dt << " s to " << time << " s";
      EXPECT_GE(l.entropy + effort.energy.inelastic_entropy - effort.energy.entropy_in,
                -l.tolerance / *ambient_)
          << "step of " << dt << " s to " << time << " s";
    }
    return effort;
  }

 private:
  std::optional<double> ambient_;
  bool falls_;
  std::optional<contact::ContactPair> pair_;
  std::optional<mechanics::MechanicalPhase> mechanics_;
  std::optional<mechanics::StructuralHeat> structural_;
  std::optional<heat::ThermalPhase> heat_;
  coupling::Phases phases_;
  std::unique_ptr<coupling::CouplingScheme> scheme_;
  coupling::State start_;
};

/// Equal steps from zero to `end`. `watch` sees the state after every step and, if it takes it, the step's
/// effort.
template <class Watch = void (*)(const coupling::State&)>
CoupledRun march(
    const Coupled& c, double end, int n_steps, Watch watch = [](const coupling::State&) {}) {
  Assembly assembly(c, end);
  CoupledRun run;
  run.end = assembly.start();
  assembly.scheme().synchronise(run.end);
  for (int n = 1; n <= n_steps; ++n) {
    coupling::State trial;
    const coupling::StepEffort effort = assembly.advance(run.end, trial, end * n / n_steps, end / n_steps);
    run.steps.push_back(effort.energy);
    run.stability.push_back(effort.stability);
    run.iterations.push_back(effort.coupling_iterations);
    run.end = std::move(trial);
    if constexpr (std::is_invocable_v<Watch, const coupling::State&, const coupling::StepEffort&>)
      watch(run.end, effort);
    else
      watch(run.end);
  }
  return run;
}

}  // namespace solidus::verification
