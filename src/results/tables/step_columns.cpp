/// One row for each column: name, unit, when it is there, and how it is read.
#include "results/tables/step_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "coupling/energy_scale.hpp"
#include "numbers/types.hpp"

namespace solidus::results {

namespace {

coupling::ContactSummary total(const std::vector<coupling::ContactSummary>& contacts) {
  coupling::ContactSummary sum;
  for (const auto& contact : contacts) {
    sum.closed_points += contact.closed_points;
    sum.points += contact.points;
    sum.heat += contact.heat;
    sum.force += contact.force;
  }
  return sum;
}

void add_pair(const PairColumns& pair, const coupling::ContactSummary& sums, std::vector<Reading>& to) {
  const auto add = [&](const std::string& what, const char* unit, double value) {
    to.push_back({{pair.name + "_" + what, unit}, value});
  };
  // Forces, then friction, then heat, as far as the pair has them.
  add("normal_force", "N", sums.force);
  if (pair.friction) {
    add("friction_force", "N", sums.friction);
    add("sticking_fraction", "1",
        sums.closed_points > 0 ? static_cast<double>(sums.sticking_points) / sums.closed_points : 0.0);
    add("friction_dissipation", "J", sums.dissipation);
  }
  if (pair.heat) {
    add("conducted_heat", "W", sums.heat);
    if (pair.friction) add("frictional_heat", "W", sums.heat_to_slave + sums.heat_to_master);
    add("heat_to_slave", "W", sums.heat_to_slave);
    add("heat_to_master", "W", sums.heat_to_master);
  }
  // Around an axis forces balance in every radial direction, and moments altogether.
  switch (pair.kind) {
    case AnalysisKind::axisymmetric:
      add("force_z", "N", sums.resultant[1]);
      break;
    case AnalysisKind::plane_strain:
      for (std::size_t i = 0; i < 2; ++i) add(std::string("force_") + "xy"[i], "N", sums.resultant[i]);
      add("moment_z", "N m", sums.moment[2]);
      break;
    case AnalysisKind::solid:
      for (std::size_t i = 0; i < 3; ++i) add(std::string("force_") + "xyz"[i], "N", sums.resultant[i]);
      for (std::size_t i = 0; i < 3; ++i) add(std::string("moment_") + "xyz"[i], "N m", sums.moment[i]);
      break;
  }
}

/// A column of steps.csv: its head, when it is there, and its cell of a step whose contacts add up to
/// `contact`.
struct StepColumn {
  CsvColumn head;
  bool (*shown)(const StepTable& table);
  CsvCell (*cell)(const coupling::StepRecord& r, const coupling::ContactSummary& contact);
};

/// ΔS of a step or a run less what came with heat from outside: not below zero but for errors [J/K].
double entropy_production(const coupling::StabilityAudit& stability, const coupling::EnergyAudit& energy) {
  return stability.entropy + stability.frictional_entropy + energy.inelastic_entropy - energy.entropy_in;
}

CsvCell whole(int value) {
  return static_cast<std::int64_t>(value);
}

using StepOfRun = coupling::StepRecord;
using ContactSums = coupling::ContactSummary;
constexpr auto in_all_runs = [](const StepTable&) { return true; };
constexpr auto with_heat = [](const StepTable& t) { return t.heat; };
constexpr auto with_dynamics = [](const StepTable& t) { return t.dynamics; };
constexpr auto with_stability = [](const StepTable& t) { return t.stability; };
constexpr auto in_stages = [](const StepTable& t) { return t.stages; };

/// The columns of steps.csv in their order: name, unit, whether a run has it, and how its value is read from
/// the record of a step.
const std::vector<StepColumn> k_step_columns = {
    {{"time", "s"}, in_all_runs, [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.time; }},
    {{"step", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.number); }},
    {{"dt", "s"}, in_all_runs, [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.dt; }},
    {{"reason", ""}, in_all_runs, [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.reason; }},
    {{"rejected", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.rejected); }},
    {{"shortened", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.shortened); }},
    {{"rejection", ""},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.rejection; }},
    {{"temperature_error", "K"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.temperature_error; }},
    {{"displacement_error", "m"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.displacement_error; }},
    {{"stress_error", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.stress_error; }},
    {{"output", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.output ? 1 : 0); }},
    {{"heat_iterations", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.heat.iterations); }},
    {{"heat_linear_iterations", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.heat.linear_iterations); }},
    {{"heat_residual", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.heat.residual; }},
    {{"heat_seconds", "s"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.heat.seconds; }},
    {{"mechanics_iterations", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.mechanics.iterations); }},
    {{"mechanics_linear_iterations", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.mechanics.linear_iterations); }},
    {{"mechanics_residual", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.mechanics.residual; }},
    {{"mechanics_seconds", "s"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.mechanics.seconds; }},
    {{"coupling_iterations", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.coupling_iterations); }},
    {{"closed_points", "1"},
     in_all_runs,
     [](const StepOfRun&, const ContactSums& contact) -> CsvCell { return whole(contact.closed_points); }},
    {{"contact_points", "1"},
     in_all_runs,
     [](const StepOfRun&, const ContactSums& contact) -> CsvCell { return whole(contact.points); }},
    {{"solid_fraction", "1"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.solid_fraction; }},
    {{"T_min", "degC"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.min_temperature - k_zero_celsius; }},
    {{"T_max", "degC"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.max_temperature - k_zero_celsius; }},
    {{"contact_energy", "J"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.contact; }},
    {{"numerical_dissipation", "J"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.numerical; }},
    {{"work", "J"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.work; }},
    {{"viscous_dissipation", "J"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.viscous_dissipation; }},
    {{"plastic_dissipation", "J"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.plastic_dissipation; }},
    {{"plastic_work", "J"},
     in_all_runs,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.plastic_work; }},
    {{"stored_heat", "J"},
     with_heat,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.stored_heat; }},
    {{"structural_energy", "J"},
     with_heat,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.structural; }},
    {{"heat_in", "J"},
     with_heat,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.heat_in; }},
    {{"heat_exchanged", "J"},
     with_heat,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.heat_exchanged; }},
    {{"energy_defect", "J"},
     with_heat,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.defect(); }},
    {{"kinetic_energy", "J"},
     with_dynamics,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.energy.kinetic; }},
    {{"lyapunov_mechanical", "J"},
     with_stability,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.stability.mechanical; }},
    {{"lyapunov_thermal", "J"},
     with_stability,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.stability.thermal; }},
    {{"lyapunov_tolerance", "J"},
     with_stability,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.stability.tolerance; }},
    {{"entropy", "J/K"},
     with_stability,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.stability.entropy; }},
    {{"entropy_production", "J/K"},
     with_stability,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell {
       return entropy_production(r.stability, r.energy);
     }},
    {{"stage", ""}, in_stages, [](const StepOfRun& r, const ContactSums&) -> CsvCell { return r.stage; }},
    {{"cycle", "1"},
     in_stages,
     [](const StepOfRun& r, const ContactSums&) -> CsvCell { return whole(r.cycle); }},
};

}  // namespace

std::vector<CsvColumn> step_columns(StepTable table) {
  std::vector<CsvColumn> columns;
  for (const StepColumn& column : k_step_columns)
    if (column.shown(table)) columns.push_back(column.head);
  return columns;
}

std::vector<CsvCell> step_row(const coupling::StepRecord& r, StepTable table) {
  const coupling::ContactSummary contact = total(r.contacts);
  std::vector<CsvCell> cells;
  for (const StepColumn& column : k_step_columns)
    if (column.shown(table)) cells.push_back(column.cell(r, contact));
  return cells;
}

/// The columns of a channel: the mean power of the step, and its fluid at the end of it.
void GlobalHistory::add_channel(const std::string& name, std::vector<Reading>& to) const {
  heat::ChannelReading reading;
  for (const heat::ChannelReading& one : last_.channels)
    if (one.name == name) reading = one;
  const bool known = !reading.name.empty();
  to.push_back({{name + "_power", "W"}, last_.power_of(name)});
  to.push_back({{name + "_outlet", "degC"}, known ? reading.outlet - k_zero_celsius : 0.0});
  to.push_back({{name + "_wall", "degC"}, known ? reading.wall - k_zero_celsius : 0.0});
  to.push_back({{name + "_reynolds", "1"}, reading.reynolds});
  to.push_back({{name + "_film", "W/m2/K"}, reading.film});
}

namespace {

/// Work, heat and entropy of plastic strain, summed over the steps.
void add_plastic(const coupling::EnergyAudit& sum, std::vector<Reading>& all) {
  all.push_back({{"plastic_dissipation", "J"}, sum.plastic_dissipation});
  all.push_back({{"plastic_work", "J"}, sum.plastic_work});
  all.push_back({{"hardening_energy", "J"}, sum.hardening()});
  all.push_back({{"inelastic_entropy", "J/K"}, sum.inelastic_entropy});
}

}  // namespace

std::vector<Reading> GlobalHistory::all() const {
  // The readings of history.csv in their order, each where the run has what it reads: temperatures, contact,
  // energies of the first law summed over the steps so far, and stability.
  std::vector<Reading> all = {{{"T_min", "degC"}, last_.min_temperature - k_zero_celsius},
                              {{"T_max", "degC"}, last_.max_temperature - k_zero_celsius}};
  const auto add = [&all](const char* name, const char* unit, double value) {
    all.push_back({{name, unit}, value});
  };
  if (options_.melting) add("solid_fraction", "1", last_.solid_fraction);
  if (options_.contact) {
    const coupling::ContactSummary contact = total(last_.contacts);
    add("closed_fraction", "1",
        contact.points > 0 ? static_cast<double>(contact.closed_points) / contact.points : 0.0);
    add("contact_heat", "W", contact.heat);
    add("contact_force", "N", contact.force);
  }
  for (std::size_t i = 0; i < options_.pairs.size(); ++i)
    add_pair(options_.pairs[i], i < last_.contacts.size() ? last_.contacts[i] : coupling::ContactSummary{},
             all);
  if (options_.heat) {
    add("stored_heat", "J", sum_.stored_heat);
    add("heat_in", "J", sum_.heat_in);
    for (const std::string& source : options_.sources)
      all.push_back({{source + "_power", "W"}, last_.power_of(source)});
    if (!options_.channels.empty()) add("heat_to_channels", "J", sum_.to_channels);
    for (const std::string& channel : options_.channels) add_channel(channel, all);
  }
  if (options_.grows) add("deposited_mass", "kg", mass_);
  if (options_.heat && options_.bodies) {
    add("heat_poured", "J", sum_.bodies.poured);
    add("heat_ejected", "J", sum_.bodies.ejected);
    add("heat_corrected", "J", sum_.bodies.corrected);
    add("heat_of_bodies", "J", heat_of_bodies_);
  }
  if (options_.mechanics && options_.heat) add("structural_energy", "J", sum_.structural);
  if (options_.mechanics) add("work", "J", sum_.work);
  if (options_.mechanics && options_.contact) add("contact_energy", "J", sum_.contact);
  if (options_.dynamics) add("kinetic_energy", "J", sum_.kinetic);
  if (options_.dynamics || (options_.mechanics && options_.contact))
    add("numerical_dissipation", "J", sum_.numerical);
  if (options_.mechanics) add("viscous_dissipation", "J", sum_.viscous_dissipation);
  if (options_.plastic) add_plastic(sum_, all);
  if (options_.stability) {
    add("lyapunov", "J", stability_.increment());
    add("lyapunov_mechanical", "J", last_.stability.mechanical);
    add("lyapunov_thermal", "J", last_.stability.thermal);
    add("entropy", "J/K", stability_.entropy);
    add("entropy_production", "J/K", entropy_production(stability_, sum_));
  }
  if (options_.heat) {
    add("heat_exchanged", "J", sum_.heat_exchanged);
    add("energy_defect", "J", sum_.defect());
  }
  if (options_.internal_energy) {
    add("internal_energy", "J", sum_.internal);
    add("internal_energy_defect", "J", sum_.state_defect());
  }
  return all;
}

std::vector<Reading> GlobalHistory::entries() const {
  std::vector<Reading> all = this->all();
  std::erase_if(all, [this](const auto& entry) {
    return std::any_of(options_.taken.begin(), options_.taken.end(),
                       [&](const CsvColumn& c) { return c.header() == entry.first.header(); });
  });
  return all;
}

std::vector<CsvColumn> GlobalHistory::columns() const {
  std::vector<CsvColumn> columns;
  for (const auto& [column, value] : entries()) columns.push_back(column);
  return columns;
}

void GlobalHistory::start(const coupling::StepEffort& initial, const coupling::EnergyAudit& energy,
                          const coupling::StabilityAudit& stability, double heat_content,
                          double heat_of_bodies) {
  last_ = initial;
  heat_of_bodies_ = heat_of_bodies;
  heat_content_ = heat_content;
  sum_ = energy;
  sum_.internal = initial.internal_energy - sum_.internal_at_start;
  stability_ = stability;
}

void GlobalHistory::add(const coupling::StepEffort& step, double heat_of_bodies) {
  last_ = step;
  heat_of_bodies_ = heat_of_bodies;
  sum_ += step.energy;
  sum_.internal = step.internal_energy - sum_.internal_at_start;
  stability_ += step.stability;
}

std::vector<double> GlobalHistory::values() const {
  std::vector<double> values;
  for (const auto& [column, value] : entries()) values.push_back(value);
  return values;
}

double GlobalHistory::relative_defect() const {
  return coupling::relative_defect(sum_, heat_content_);
}

}  // namespace solidus::results
