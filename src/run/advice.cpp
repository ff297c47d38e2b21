/// Texts for a run that stopped: the physical cause chooses them, the case fills in its keys.
#include "run/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "run/melt_watch.hpp"

namespace solidus::run {

namespace {

bool carries_loads(const cases::CaseSpec& spec) {
  return std::any_of(spec.mechanical_conditions.begin(), spec.mechanical_conditions.end(), [](const auto& c) {
    return c.on_faces() || c.kind == cases::MechanicalConditionSpec::Kind::body_force;
  });
}

/// Another solver than the iterative one that was asked for.
std::vector<std::string> solver_advice(const cases::CaseSpec& spec) {
  const bool unsymmetric = std::any_of(spec.contacts.begin(), spec.contacts.end(),
                                       [](const auto& c) { return c.friction && !c.friction->symmetric; });
  std::vector<std::string> advice;
  if (spec.mechanics.solver != linear::SolverKind::automatic &&
      spec.mechanics.solver != linear::SolverKind::direct)
    advice.emplace_back(
        fmt::format("another linear solver than the one asked for: mechanics.solver = \"direct\"{}",
                    unsymmetric ? ", because friction makes the matrix unsymmetric" : ""));
  return advice;
}

/// Advice on Newton's iteration of a body that is supported and is strong enough.
std::vector<std::string> iteration_advice(const coupling::Stop& stop, const cases::CaseSpec& spec) {
  std::vector<std::string> advice;
  // A linear solver that gave up is the first suspect.
  if (stop.failure == Failure::linear_solver) advice = solver_advice(spec);
  if (spec.dynamics) advice.emplace_back("a smaller step: with inertia a short one is an easy one");
  advice.push_back(
      fmt::format("more iterations: mechanics.max_iterations (now {}), or mechanics.tolerance "
                  "(now {:g})",
                  spec.mechanics.max_iterations, spec.mechanics.tolerance));
  // Stiff contact is the second.
  if (!spec.contacts.empty())
    advice.emplace_back(
        "a softer contact: penalty_factor in [[contact]]; look at its gap in the last fields");
  advice.emplace_back(
      "jumps in the material's tables at the temperatures of that place (`solidus materials NAME`)");
  return advice;
}

std::vector<std::string> mechanics_advice(const coupling::Stop& stop, const cases::CaseSpec& spec) {
  // Advice by what is wrong physically, the likeliest first. It names keys that the user can change.
  const char* const support =
      "a support against moving and turning, [[mechanical_condition]] with a displacement of zero, or a body "
      "below it that it touches, [[contact]]";
  // Each kind of failure has remedies of its own; supports are named with the key that makes them.
  switch (stop.diagnosis.physics) {
    case coupling::Physics::nothing_carries:
      return {support, "is gravity_direction right? Have the bodies that carried it left in this stage?"};
    case coupling::Physics::slides:
      return {
          "friction of that contact, or supports against sliding and turning: a plane of symmetry, a point",
          "is gravity_direction right?"};
    case coupling::Physics::comes_off:
      return {
          support,
          "friction of that contact, or supports on a plane of symmetry: contact pushes and does not hold",
          "loads and films on one side that bend the body off what it lies on"};
    case coupling::Physics::runs_out:
    case coupling::Physics::melt_flows:
      return {
          k_melt_remedy, "is gravity_direction right?",
          "faces of the mould as fine as those of the melt: melt flows between points of contact that are "
          "far apart",
          "a time.step that resolves the cooling of this place, so that its skin is solid before it is "
          "loaded"};
    case coupling::Physics::limit_load:
      return {
          "beyond its limit load a body that yields has no equilibrium: are loads and strength in the right "
          "unit? Hardening, rate dependence, or displacements in place of forces carry it further"};
    case coupling::Physics::law:
      return {
          "tables and parameters of that material at this temperature (`solidus materials NAME`); `solidus "
          "point` "
          "drives the law alone through such a strain",
          "loads and displacements that come within less time than the law resolves"};
    default:
      return iteration_advice(stop, spec);
  }
}

/// Advice for steps that coupling::GuardedScheme refuses.
std::vector<std::string> guard_advice(const coupling::Stop& stop, const cases::CaseSpec& spec) {
  std::vector<std::string> advice;
  // The likeliest cause first: the open rule may leave the range of temperatures at chills.
  if (spec.heat.integration == heat::HeatIntegration::open)
    advice.emplace_back(
        "the closed rule, heat.integration = \"closed\": the open one over- and undershoots at sudden "
        "chills");
  if (!spec.heat.bounds) advice.emplace_back("heat.bounds = true");
  advice.emplace_back("a heat transfer that changes less steeply with gap and pressure: [contact.heat]");
  // The scheme knows what it can do itself.
  std::ranges::move(spec.coupling.scheme->advice(stop), std::back_inserter(advice));
  if (carries_loads(spec))
    advice.emplace_back(
        "loads beyond the limit load of a body that yields: it flows on and on, and flow heats");
  return advice;
}

/// Advice where the augmentations of the Lagrangian do not end (coupling/contact_states.hpp).
std::vector<std::string> contact_advice() {
  return {"normal = \"penalty\" in that [[contact]], which needs no augmentations",
          "a larger penetration_tolerance, or a larger penalty_factor, of that contact",
          "a smaller mechanics.tolerance: augmentations cannot gain what Newton's iteration leaves"};
}

std::vector<std::string> coupling_advice(const coupling::Stop& stop, const cases::CaseSpec& spec) {
  if (stop.failure == Failure::another_solution) return guard_advice(stop, spec);
  std::vector<std::string> advice = spec.coupling.scheme->advice(stop);
  if (!spec.contacts.empty())
    advice.emplace_back("a heat transfer that changes less steeply with the gap: [contact.heat]");
  return advice;
}

std::vector<std::string> heat_advice(const coupling::Stop& stop, const cases::CaseSpec& spec) {
  // Advice for heat: temperatures below zero come of sinks or of the open rule, contacts of steep laws,
  // anything else of iterations and steep tables.
  const char* const closed =
      "the closed rule, heat.integration = \"closed\": the open one over- and undershoots at sudden chills, "
      "the "
      "more the shorter the step is";
  // Below zero kelvin the load takes more heat than there is, whatever the iteration does.
  if (stop.failure == Failure::temperature || stop.diagnosis.physics == coupling::Physics::cold_law) {
    std::vector<std::string> advice = {
        "fluxes and sources at that place: do they take more heat than there is?"};
    if (spec.heat.integration == heat::HeatIntegration::open) advice.insert(advice.begin(), closed);
    return advice;
  }
  std::vector<std::string> advice;
  if (stop.diagnosis.physics == coupling::Physics::contact_heat)
    advice.push_back(
        fmt::format("conductance and gap law of contact '{}': usual are 100 to 20000 W/m2/K, less steep in "
                    "gap and pressure",
                    stop.diagnosis.contact_name));
  advice.insert(
      advice.end(),
      {fmt::format("more iterations: heat.max_iterations (now {}), or heat.tolerance",
                   spec.heat.max_iterations),
       "films, radiation, sources or conductivities that change steeply with temperature at that place"});
  // A steady state needs something that fixes the level of temperature.
  if (spec.time.steady)
    advice.emplace_back(
        "what holds a temperature, a film, radiation or a temperature on a surface: fluxes and sources alone "
        "have a steady state only in balance");
  if (spec.heat.integration == heat::HeatIntegration::open)
    advice.emplace_back("the closed rule, heat.integration = \"closed\", converges for any step");
  return advice;
}

std::vector<std::string> advice_of(const coupling::Stop& stop, const cases::CaseSpec& spec) {
  // What the physics explains goes before what the numerics saw.
  if (stop.diagnosis.physics == coupling::Physics::nothing_carries ||
      stop.diagnosis.physics == coupling::Physics::runs_out ||
      stop.diagnosis.physics == coupling::Physics::limit_load)
    return mechanics_advice(stop, spec);
  if (stop.diagnosis.physics == coupling::Physics::cold_law) return heat_advice(stop, spec);
  // Otherwise the equations that failed tell which room of advice to open.
  switch (stop.failure) {
    case Failure::heat:
    case Failure::temperature:
      return heat_advice(stop, spec);
    case Failure::coupling:
    case Failure::divergence:
    case Failure::another_solution:
      return coupling_advice(stop, spec);
    case Failure::multipliers:
      return contact_advice();
    case Failure::equilibrium:
    case Failure::linear_solver:
    case Failure::law:
    case Failure::other:
      break;
  }
  return mechanics_advice(stop, spec);
}

/// Not where there is no equilibrium, whatever the step.
bool shorter_steps_help(coupling::Physics physics) {
  return physics != coupling::Physics::nothing_carries && physics != coupling::Physics::slides &&
         physics != coupling::Physics::limit_load;
}

/// The body for which the isothermal split is unstable, however short the step; null without one.
const check::CouplingEstimate* too_strong(std::span<const check::CouplingEstimate> couplings) {
  const auto worst = std::max_element(couplings.begin(), couplings.end(), [](const auto& a, const auto& b) {
    return a.decisive() < b.decisive();
  });
  return worst != couplings.end() && worst->decisive() >= 1 ? &*worst : nullptr;
}

}  // namespace

std::string stop_text(const coupling::Stop& stop, const cases::CaseSpec& spec, double time,
                      const std::string& checkpoint, std::span<const check::CouplingEstimate> couplings) {
  // The message of a stop: the physics first, then what the equations say, where, what was tried, and what
  // may help.
  const std::string checkpoint_line =
      checkpoint.empty() ? "" : fmt::format("  checkpoint: {} (t = {:.6g} s)\n", checkpoint, time);
  if (stop.asked)
    return fmt::format("stopped as asked at t = {:.6g} s", time) +
           (checkpoint.empty() ? ""
                               : "\n" + checkpoint_line + "  to continue: the same command with --restart");
  const std::string physics = coupling::text(stop.diagnosis);
  std::string text = fmt::format("the simulation could not go on at t = {:.6g} s\n  reason: {}\n", time,
                                 physics.empty() ? stop.reason : physics);
  // The equations' own reason, where it says more than the physics.
  if (!physics.empty() && stop.reason != stop.diagnosis.detail)
    text += fmt::format("  equations: {}\n", stop.reason);
  if (!stop.where.empty() && stop.where != stop.diagnosis.detail)
    text += fmt::format("  where: {}\n", stop.where);
  const bool steps = stop.tries > 0;  // a steady state has none
  // A steady analysis has no steps, and shorter ones are no advice where the coupling itself is unstable.
  if (steps)
    text += fmt::format("  tried: {} {}, the smallest {:.4g} s\n", stop.tries,
                        stop.tries == 1 ? "step" : "steps, each shorter", stop.smallest_step) +
            checkpoint_line;
  text += "  what may help:";
  // An unstable split is told first and instead of smaller steps, which do not help it.
  const check::CouplingEstimate* unstable = too_strong(couplings);
  if (unstable != nullptr)
    text += fmt::format(
        "\n    - the coupling is too strong for the {} split: {};\n      coupling.scheme = \"{}\" is stable "
        "for "
        "every step. Shorter steps do not help",
        spec.coupling.scheme->name(), check::text(*unstable), coupling::k_stable_scheme);
  for (const std::string& advice : advice_of(stop, spec)) text += fmt::format("\n    - {}", advice);
  if (!steps) return text;
  if (unstable == nullptr && shorter_steps_help(stop.diagnosis.physics))
    text += fmt::format("\n    - smaller steps: time.step (now {:g} s), time.min_step",
                        spec.time.step.value_or(0));
  if (checkpoint.empty()) return text;
  return text +
         "\n  The results so far are whole; after a change that leaves mesh and materials alone, the same "
         "command with --restart\n  continues from there.";
}

}  // namespace solidus::run
