/// The two orders of a split, and the iteration over gaps when heat comes first: heat is conducted by gaps
/// that mechanics then changes, and is conducted again if that misplaced too much of it.
#include "coupling/sequential_split.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/gap_iteration_watch.hpp"
#include "coupling/passes.hpp"
#include "coupling/stability_audit.hpp"
#include "mechanics/mechanical_restart.hpp"
#include "system/errors.hpp"
#include "system/profile.hpp"

namespace solidus::coupling {

namespace {

/// x + dt × rate; empty where no rate is known.
std::vector<double> extrapolated(const std::vector<double>& x, const std::vector<double>& rate, double dt) {
  std::vector<double> guess(rate.size());
  for (std::size_t i = 0; i < guess.size(); ++i) guess[i] = x[i] + dt * rate[i];
  return guess;
}

std::vector<double> rate(const std::vector<double>& from, const std::vector<double>& to, double dt) {
  std::vector<double> result(to.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = (to[i] - from[i]) / dt;
  return result;
}

/// Times that heat and equilibrium of a step are solved at most until the gaps agree.
constexpr int k_most_gap_iterations = 4;

contact::GapHeat sum(const std::vector<contact::GapHeat>& pairs) {
  contact::GapHeat all;
  for (const contact::GapHeat& pair : pairs) {
    all.passed += pair.passed;
    all.misplaced += pair.misplaced;
  }
  return all;
}

/// Adds the effort of an iteration that was repeated; how hard the phase is, the harder one says.
void add_effort(const PhaseEffort& before, PhaseEffort& effort) {
  effort.iterations += before.iterations;
  effort.linear_iterations += before.linear_iterations;
  effort.seconds += before.seconds;
  effort.hardest = std::max(effort.hardest, before.hardest);
}

}  // namespace

SequentialSplit::SequentialSplit(Phases phases, mechanics::Mapping mapping, const SequentialOptions& options)
    : phases_(std::move(phases)), options_(options) {
  if (phases_.mechanics != nullptr && phases_.mechanics->bodies().options.mapping != mapping)
    throw std::invalid_argument("the mechanical phase was built for another split");
  if (phases_.mechanics == nullptr || phases_.heat == nullptr) options_.order = PhaseOrder::mechanics_first;
}

void SequentialSplit::synchronise(const State& state) {
  if (phases_.mechanics == nullptr) return;  // without deformation the gaps stay as they were made
  restore_contacts(phases_, state);
}

void SequentialSplit::forget() {
  if (phases_.mechanics != nullptr) phases_.mechanics->system().solver().forget();
  if (phases_.heat != nullptr) heat::forget(*phases_.heat);
  for (contact::ContactPair* pair : phases_.contacts) pair->parts().geometry.graph().forget();
}

StepEffort SequentialSplit::advance(const State& old, State& trial, double time, double dt) {
  return *advance_unless(old, trial, time, dt, {});
}

std::optional<StepEffort> SequentialSplit::advance_unless(const State& old, State& trial, double time,
                                                          double dt, const HeatJudge& stop) {
  std::optional<StepEffort> effort = options_.order == PhaseOrder::heat_first
                                         ? heat_first(old, trial, time, dt, stop)
                                         : mechanics_first(old, trial, time, dt);
  if (effort) summarise(phases_, trial, *effort);
  return effort;
}

StepEffort SequentialSplit::mechanics_first(const State& old, State& trial, double time, double dt) {
  StepEffort effort;
  mechanics::StepDeformation deformation;
  // Mechanics at the old temperatures, then heat with the deformation found.
  if (phases_.mechanics != nullptr)
    deformation = mechanical_phase(old, old, trial, time, dt, extrapolated(old, dt), effort);
  if (phases_.heat != nullptr)
    thermal_phase(old, old, trial, deformation,
                  {.time = time, .dt = dt, .stepping = heat::stepping(*phases_.heat)}, effort);
  // What friction and gaps exchanged is booked once both phases have been solved.
  book_interface(effort.energy, phases_.structural != nullptr);
  const profile::Part part("audit");
  effort.stability = stability_audit(phases_, old, trial, deformation, effort);
  return effort;
}

std::optional<StepEffort> SequentialSplit::heat_first(const State& old, State& trial, double time, double dt,
                                                      const HeatJudge& stop) {
  int iterations = 0;
  try {
    return conducted_first(old, trial, time, dt, stop, k_most_gap_iterations, iterations);
  } catch (const StepRejected&) {
    if (iterations < 2) throw;
  }
  // The step itself went through, with the gaps of its start; only its repetition did not.
  restore_contacts(phases_, old);
  return conducted_first(old, trial, time, dt, {}, 1, iterations);
}

/// @param most        iterations
/// @param iterations  those that were begun
std::optional<StepEffort> SequentialSplit::conducted_first(const State& old, State& trial, double time,
                                                           double dt, const HeatJudge& stop, int most,
                                                           int& iterations) {
  iterations = 1;
  // `used` are the gaps by which heat was conducted; at first those of t_n, or where they change
  // steadily the expected ones.
  State warm;
  const Gaps start = gaps();
  const Gaps expected = expected_gaps(old, time, dt, start);
  Gaps used = start;
  for (std::size_t i = 0; i < used.size() && i < old.steady_gaps.size(); ++i)
    if (old.steady_gaps[i] != 0) used[i] = expected[i];
  mechanics::StructuralLead lead;
  StepEffort effort = heat_at_rest(old, warm, time, dt, used, false, lead);
  // A step that heat alone rejects ends here, before mechanics has cost anything (decision 0039).
  if (stop && stop(warm, effort.fields.flows)) return {};
  StepEffort deformed;
  mechanics::StepDeformation deformation =
      mechanical_phase(old, warm, trial, time, dt, extrapolated(old, dt), deformed, &lead);
  GapIterationWatch watch;
  while (true) {
    // Mechanics tells the gaps of the end; in the middle of the step they are the mean of both
    // ends.
    Gaps right = middle(start, gaps());
    trial.steady_gaps = steady_gaps(start, expected, right, warm);
    deformed.gap_heat = gap_heat(used, right, warm);
    // The heat that went through gaps of another width than these decides on a further round.
    const contact::GapHeat all = sum(deformed.gap_heat);
    if (!misplaces_much(all, dt, effort) || iterations == most) break;
    const GapIterationWatch::Finding finding = watch.after(all.misplaced / all.passed);
    if (finding == GapIterationWatch::Finding::stuck) break;
    // Where rounds jump between two answers the middle of both is tried.
    if (finding == GapIterationWatch::Finding::between) right = middle(used, right);
    ++iterations;
    const PhaseEffort heat = effort.heat, mechanics = deformed.mechanics;
    // A further round starts from the contact state of t_n, with heat by the gaps that were found.
    restore_contacts(phases_, old);
    deformation.clear();  // its storage serves again
    effort = heat_at_rest(old, warm, time, dt, right, true, lead);
    // It starts from the displacement of the round before, which is nearly the answer.
    const Start before{trial.mechanics.displacement, trial.mechanics.pressure};
    deformed = {};
    deformation = mechanical_phase(old, warm, trial, time, dt, before, deformed, &lead);
    add_effort(heat, effort.heat);
    add_effort(mechanics, deformed.mechanics);
    deformed.coupling_iterations = iterations;
    used = std::move(right);
  }
  // At last the heat that deformation makes, which exchanges nothing with the surroundings.
  const contact::InterfaceSums conducted = effort.energy.interface;
  thermal_phase(old, warm, trial, deformation, {.time = time, .dt = dt, .adiabatic = true}, deformed, &lead);
  book_interface(deformed.energy, phases_.structural != nullptr);
  deformed.stability = stability_audit(phases_, warm, trial, deformation, deformed);
  effort += deformed;
  effort.energy.interface.add(conducted);
  return effort;
}

SequentialSplit::Gaps SequentialSplit::middle(const Gaps& a, const Gaps& b) {
  Gaps result;
  for (std::size_t i = 0; i < a.size(); ++i) result.push_back(contact::middle(a[i], b[i]));
  return result;
}

SequentialSplit::Gaps SequentialSplit::expected_gaps(const State& old, double time, double dt,
                                                     const Gaps& start) const {
  if (options_.gap_tolerance >= 1) return start;
  const std::vector<double> moved =
      coupling::extrapolated(old.mechanics.displacement, old.displacement_rate, dt);
  if (moved.empty()) return start;
  Gaps end;
  for (const contact::ContactPair* pair : phases_.contacts)
    end.push_back(pair->parts().gaps.ahead(moved, time));
  return middle(start, end);
}

std::vector<char> SequentialSplit::steady_gaps(const Gaps& start, const Gaps& expected, const Gaps& right,
                                               const State& warm) const {
  constexpr double k_much_nearer = 0.5;
  const std::vector<contact::GapHeat> from_start = gap_heat(start, right, warm),
                                      from_expected = gap_heat(expected, right, warm);
  std::vector<char> steady(start.size());
  for (std::size_t i = 0; i < steady.size(); ++i)
    steady[i] = from_expected[i].misplaced <= k_much_nearer * from_start[i].misplaced;
  return steady;
}

SequentialSplit::Gaps SequentialSplit::gaps() const {
  Gaps gaps;
  for (const contact::ContactPair* pair : phases_.contacts) gaps.push_back(pair->parts().gaps.now());
  return gaps;
}

std::vector<contact::GapHeat> SequentialSplit::gap_heat(const Gaps& used, const Gaps& right,
                                                        const State& warm) const {
  std::vector<contact::GapHeat> heat;
  for (std::size_t i = 0; i < used.size(); ++i)
    heat.push_back(phases_.contacts[i]->parts().gaps.heat(used[i], right[i], warm.heat.temperature));
  return heat;
}

bool SequentialSplit::misplaces_much(const contact::GapHeat& all, double dt,
                                     const StepEffort& conducted) const {
  constexpr double k_much_heat = 0.01;  // of what moved in the step: interfaces that pass less matter little
  return all.misplaced > options_.gap_tolerance * all.passed &&
         dt * all.passed > k_much_heat * conducted.energy.heat_exchanged;
}

StepEffort SequentialSplit::heat_at_rest(const State& old, State& warm, double time, double dt,
                                         const Gaps& through, bool again, mechanics::StructuralLead& lead) {
  // Heat is conducted while the bodies rest where they were at t_n, through the gaps that the caller has
  // chosen.
  StepEffort effort;
  if (phases_.structural != nullptr) phases_.structural->release();
  const mechanics::StepDeformation held = mechanics::held_deformation(
      *phases_.mechanics, old.mechanics, old.heat.temperature, plateau_share(phases_, old.heat), true);
  // A state that does not know its interface temperatures yet finds them first.
  if (interfaces_begin(phases_, old)) find_interface_temperatures(phases_, old, time - dt);
  for (contact::ContactPair* pair : phases_.contacts) pair->parts().heat.hold_deformation();
  for (std::size_t i = 0; i < through.size(); ++i) phases_.contacts[i]->parts().gaps.use(through[i]);
  thermal_pass(phases_, old, warm, held,
               {.time = time,
                .dt = dt,
                .iterate = again ? &warm.heat : nullptr,
                .stepping = heat::stepping(*phases_.heat)},
               effort);
  // The energy that expansion is expected to take is moved ahead, so that mechanics begins with it.
  lead = mechanics::expected_expansion(held, warm.heat.temperature);
  book_interface(effort.energy, phases_.structural != nullptr);
  effort.stability = stability_audit(phases_, old, warm, held, effort);
  return effort;
}

void SequentialSplit::thermal_phase(const State& old, const State& warm, State& trial,
                                    mechanics::StepDeformation& deformation, const heat::ThermalPass& pass,
                                    StepEffort& effort, const mechanics::StructuralLead* lead) {
  // With flow at the new temperature the return mapping is done again within the thermal phase.
  if (options_.flow == ThermalFlow::kept || phases_.mechanics == nullptr) {
    thermal_pass(phases_, warm, trial, deformation, pass, effort);
    return;
  }
  // The share of the plateau is that of the temperatures that mechanics has used.
  const std::vector<double> share = plateau_share(phases_, warm.heat);
  thermal_pass_with_flow(phases_, warm, trial, deformation, pass, old.mechanics,
                         {.time = pass.time,
                          .dt = pass.dt,
                          .temperature = warm.heat.temperature,
                          .plateau_share = share,
                          .lead = lead},
                         effort);
}

SequentialSplit::Start SequentialSplit::extrapolated(const State& old, double dt) {
  return {coupling::extrapolated(old.mechanics.displacement, old.displacement_rate, dt),
          coupling::extrapolated(old.mechanics.pressure, old.pressure_rate, dt)};
}

// From the temperature of t_n (4.40, 4.46), or from the one that conduction has left.
mechanics::StepDeformation SequentialSplit::mechanical_phase(const State& old, const State& warm,
                                                             State& trial, double time, double dt,
                                                             const Start& start, StepEffort& effort,
                                                             const mechanics::StructuralLead* lead) {
  ContactWork contact(phases_);
  const std::vector<double>& temperature =
      phases_.heat != nullptr ? warm.heat.temperature : phases_.temperature;
  const std::vector<double> share = plateau_share(phases_, warm.heat);
  mechanics::MechanicalReport report = mechanical_pass(phases_, {old.mechanics, warm.contacts}, trial,
                                                       {.time = time,
                                                        .dt = dt,
                                                        .temperature = temperature,
                                                        .plateau_share = share,
                                                        .lead = lead,
                                                        .guess = start.displacement,
                                                        .guessed_pressure = start.pressure},
                                                       effort);
  trial.displacement_rate = rate(old.mechanics.displacement, trial.mechanics.displacement, dt);
  trial.pressure_rate = rate(old.mechanics.pressure, trial.mechanics.pressure, dt);
  contact.add(phases_.mechanics->bodies().work_share());
  contact.book(effort.energy);
  book_excess_work(phases_, report.deformation, effort.energy);
  return std::move(report.deformation);
}

}  // namespace solidus::coupling
