/// Steps of the loading are taken one after the other, halved where the law asks for it; each leaves a
/// record.
#include "point/point_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "material/hardening.hpp"
#include "numbers/types.hpp"

namespace solidus::point {

namespace {

using material::Flow;
using material::Viscoplastic;

constexpr int k_max_cuts = 10;

/// w, the factor of the yield stress in a degenerated liquid.
double strength(const MaterialPoint& point, double temperature) {
  const auto p = point.law().properties_at(temperature, point.strain_reference());
  return point.law().shear(p.elastic, 1.0).strength;  // the same for every step
}

/// Makes the record of a state: stress, strain and the quantities that follow from them.
MaterialPointRecord record_of(const MaterialPoint& point, const MaterialPointState& state) {
  const material::Material& material = point.law().material();
  // Properties at the temperature of the state, from which strains and strengths follow.
  const auto p = point.law().properties_at(state.temperature, point.strain_reference());
  MaterialPointRecord r;
  r.time = state.time;
  r.temperature = state.temperature;
  r.strain = state.strain;
  r.stress = state.stress;
  r.plastic_strain = state.history.plastic_strain;
  r.viscous_strain = state.history.viscous_strain;
  r.equivalent_plastic = state.history.hardening;
  r.thermal_strain = p.elastic.thermal_strain / 3;
  r.solid_fraction = p.elastic.solid_fraction;
  const Stored stored = point.stored(state);
  r.internal_energy = stored.energy;
  r.entropy = stored.entropy;
  // Without plastic flow the remaining entries are zero.
  if (!material.flow) return r;
  const Flow& flow = *material.flow;
  const double xi = state.history.hardening;
  r.flow_stress =
      strength(point, state.temperature) *
      (p.flow.flow_stress + material::hardening_stress(flow.isotropic, flow.curves, p.flow, xi).stress);
  r.back_stress = (-2.0 / 3 * p.flow.kinematic_modulus) * state.history.back_strain;
  r.isotropic_energy = material::hardening_energy(flow.isotropic, flow.curves, p.flow, xi);
  r.kinematic_energy =
      p.flow.kinematic_modulus / 3 * dot(state.history.back_strain, state.history.back_strain);
  return r;
}

/// The rates of the step and the sums over time: the work by the trapezoidal rule, what is dissipated by the
/// rate at the end of the step, as the law has it.
MaterialPointRecord record_of(const MaterialPoint& point, const StepResult& step,
                              const MaterialPointRecord& first, const MaterialPointRecord& before) {
  MaterialPointRecord r = record_of(point, step.state);
  r.internal_energy -= first.internal_energy;
  r.entropy -= first.entropy;
  r.viscous_dissipation = step.response.viscous_dissipation;
  r.plastic_dissipation = step.response.plastic_dissipation;
  r.plastic_power = step.response.plastic_power;
  r.work = before.work + 0.5 * dot(before.stress + r.stress, r.strain - before.strain);
  r.dissipated = before.dissipated + step.response.dissipation * (r.time - before.time);
  r.heat = r.internal_energy - r.work;
  if (const auto& flow = point.law().material().flow)
    r.thermal_dissipation = -std::sqrt(2.0 / 3) * strength(point, r.temperature) * r.temperature *
                            flow->flow_stress.derivative(r.temperature) * step.response.flow_increment /
                            step.effective_step;  // 2.120
  r.residuals = step.residuals;
  r.iterations = static_cast<int>(step.residuals.size()) - 1;
  return r;
}

std::string failure(const MaterialPoint& point, const MaterialPointRecord& last, const Segment& segment,
                    std::size_t number, const StepResult& step) {
  // The cause that the numbers point to, from the law itself to the way of loading.
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
  if (!step.complaint.empty())
    text += "\n  The law: " + step.complaint + ".";
  else if (last.solid_fraction == 0 || step.response.twice_shear == 0)
    text += "\n  The liquid carries no shear: leave shear stresses at zero, or prescribe strains.";
  else if (point.law().material().flow && stress_controlled)
    text +=
        "\n  A stress that the material cannot carry has no answer: prescribe the strain instead, or give "
        "the material hardening or rate dependence.";
  else
    text += "\n  Take more steps.";
  return text;
}

/// One step of the loading, halved where it must be.
bool march(MaterialPoint& point, const Path& path, double start, double dt, const MaterialPointRecord& first,
           std::vector<MaterialPointRecord>& records, StepResult& step) {
  // Parts of the step, halved after each failure.
  double done = 0, part = dt;
  int cuts = 0;
  while (done < dt) {
    const bool last = part >= dt - done;
    const double size = last ? dt - done : part;
    // The target of the part lies on the path of the whole segment.
    step = point.attempt(path.at(start + done + size), size);
    if (!step.converged) {
      if (++cuts > k_max_cuts) return false;
      part = 0.5 * size;
      continue;
    }
    MaterialPointRecord record = record_of(point, step, first, records.back());
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
  MaterialPoint point(material, program.options);
  History history;
  // The first record gives the origin of the energies.
  const MaterialPointRecord first = record_of(point, point.state());
  history.records.push_back(first);
  history.records.back().internal_energy = history.records.back().entropy = 0;  // counted from here
  // Each segment starts from the state that the last one left; energies count from the first state.
  for (std::size_t i = 0; i < program.segments.size(); ++i) {
    const Segment& segment = program.segments[i];
    const Path path(segment, point.state().strain, point.state().stress, point.state().temperature);
    point.restart();
    double start = 0;
    StepResult step;
    // Steps of the segment, each of which may be cut on its way.
    for (const double dt : path.steps()) {
      if (!march(point, path, start, dt, first, history.records, step)) {
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
