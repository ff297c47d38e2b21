#include "point/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/types.hpp"

namespace solidus::point {

namespace {

using material::Flow;
using material::Viscoplastic;

constexpr int k_max_cuts = 10;

/// What the state of the point holds beside stress and strain.
Record record_of(const MaterialPoint& point, const PointState& state) {
  const material::Material& material = point.law().material();
  const auto p = point.law().properties_at(state.temperature, point.strain_reference());
  Record r;
  r.time = state.time;
  r.temperature = state.temperature;
  r.strain = state.strain;
  r.stress = state.stress;
  r.plastic_strain = state.history.plastic_strain;
  r.viscous_strain = state.history.viscous_strain;
  r.equivalent_plastic = state.history.hardening;
  r.thermal_strain = p.elastic.thermal_strain / 3;
  r.solid_fraction = p.elastic.solid_fraction;
  if (!material.flow) return r;
  const Flow& flow = *material.flow;
  const double strength = point.law().shear(p.elastic, 1.0).strength;  // of any step
  const double xi = state.history.hardening;
  r.flow_stress = strength * (p.flow.flow_stress +
                              material::hardening_stress(flow.isotropic, flow.curves, p.flow, xi).stress);
  r.back_stress = (-2.0 / 3 * p.flow.kinematic_modulus) * state.history.back_strain;
  r.isotropic_energy = material::hardening_energy(flow.isotropic, flow.curves, p.flow, xi);
  r.kinematic_energy =
      p.flow.kinematic_modulus / 3 * dot(state.history.back_strain, state.history.back_strain);
  return r;
}

/// The rates of the step and the sums over time: the work by the trapezoidal rule, what is dissipated by the
/// rate at the end of the step, as the law has it.
Record record_of(const MaterialPoint& point, const StepResult& step, const Record& before) {
  Record r = record_of(point, step.state);
  r.viscous_dissipation = step.response.viscous_dissipation;
  r.plastic_dissipation = step.response.plastic_dissipation;
  r.plastic_power = step.response.plastic_power;
  r.work = before.work + 0.5 * dot(before.stress + r.stress, r.strain - before.strain);
  r.dissipated = before.dissipated + step.response.dissipation * (r.time - before.time);
  r.residuals = step.residuals;
  r.iterations = static_cast<int>(step.residuals.size()) - 1;
  return r;
}

std::string failure(const MaterialPoint& point, const Record& last, const Segment& segment,
                    std::size_t number, const StepResult& step) {
  bool stress_controlled = false;
  for (const ComponentRamp& ramp : segment.components)
    stress_controlled = stress_controlled || (ramp.of == Control::stress && !ramp.held());
  const auto megapascal = [](double stress) { return fmt::format("{:.4g} MPa", 1e-6 * stress); };
  std::string text = fmt::format(
      "segment {} stopped at {:.6g} s ({:.6g} degC, solid fraction {:.3g}): no equilibrium in {} iterations, "
      "{} are missing\n  von Mises stress {}, flow stress {}",
      number, last.time, last.temperature - k_zero_celsius, last.solid_fraction, step.residuals.size() - 1,
      megapascal(step.residuals.back()), megapascal(von_mises(last.stress)), megapascal(last.flow_stress));
  if (!segment.where.file.empty()) text = segment.where.text() + ": " + text;
  if (point.law().material().flow && stress_controlled)
    text +=
        "\n  A stress that the material cannot carry has no answer: prescribe the strain instead, or give "
        "the material hardening or rate dependence.";
  else if (last.solid_fraction == 0 || step.response.twice_shear == 0)
    text += "\n  The liquid carries no shear: leave shear stresses at zero, or prescribe strains.";
  else
    text += "\n  Take more steps.";
  return text;
}

/// One step of the loading, halved where it must be.
bool march(MaterialPoint& point, const Path& path, double start, double dt, std::vector<Record>& records,
           StepResult& step) {
  double done = 0, part = dt;
  int cuts = 0;
  while (done < dt) {
    const bool last = part >= dt - done;
    const double size = last ? dt - done : part;
    step = point.attempt(path.at(start + done + size), size);
    if (!step.converged) {
      if (++cuts > k_max_cuts) return false;
      part = 0.5 * size;
      continue;
    }
    Record record = record_of(point, step, records.back());
    record.cuts = cuts;
    records.push_back(std::move(record));
    point.accept(step);
    if (last) break;
    done += size;
  }
  return true;
}

}  // namespace

History run(const material::Material& material, const Program& program) {
  MaterialPoint point(material, program.temperature, program.strain_reference, program.integration);
  History history;
  history.records.push_back(record_of(point, point.state()));
  for (std::size_t i = 0; i < program.segments.size(); ++i) {
    const Segment& segment = program.segments[i];
    const Path path(segment, point.state().strain, point.state().stress, point.state().temperature);
    point.restart();
    double start = 0;
    StepResult step;
    for (const double dt : path.steps()) {
      if (!march(point, path, start, dt, history.records, step)) {
        history.finished = false;
        history.reason = failure(point, history.records.back(), segment, i + 1, step);
        return history;
      }
      start += dt;
    }
  }
  return history;
}

}  // namespace solidus::point
