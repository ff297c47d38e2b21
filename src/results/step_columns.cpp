#include "results/step_columns.hpp"

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

}  // namespace

std::vector<Column> step_columns(StepTable table) {
  std::vector<Column> columns = {{"time", "s"},
                                 {"step", "1"},
                                 {"dt", "s"},
                                 {"reason", ""},
                                 {"rejected", "1"},
                                 {"rejection", ""},
                                 {"temperature_error", "K"},
                                 {"displacement_error", "m"},
                                 {"output", "1"},
                                 {"heat_iterations", "1"},
                                 {"heat_linear_iterations", "1"},
                                 {"heat_residual", "1"},
                                 {"heat_seconds", "s"},
                                 {"mechanics_iterations", "1"},
                                 {"mechanics_linear_iterations", "1"},
                                 {"mechanics_residual", "1"},
                                 {"mechanics_seconds", "s"},
                                 {"coupling_iterations", "1"},
                                 {"closed_points", "1"},
                                 {"contact_points", "1"},
                                 {"solid_fraction", "1"},
                                 {"T_min", "degC"},
                                 {"T_max", "degC"},
                                 {"contact_energy", "J"},
                                 {"numerical_dissipation", "J"},
                                 {"work", "J"},
                                 {"viscous_dissipation", "J"},
                                 {"plastic_dissipation", "J"},
                                 {"plastic_work", "J"}};
  if (table.heat)
    columns.insert(columns.end(), {{"stored_heat", "J"},
                                   {"structural_energy", "J"},
                                   {"heat_in", "J"},
                                   {"heat_exchanged", "J"},
                                   {"energy_defect", "J"}});
  if (table.dynamics) columns.push_back({"kinetic_energy", "J"});
  if (table.stability)
    columns.insert(columns.end(), {{"lyapunov_mechanical", "J"},
                                   {"lyapunov_thermal", "J"},
                                   {"lyapunov_tolerance", "J"},
                                   {"entropy", "J/K"},
                                   {"entropy_production", "J/K"}});
  if (table.stages) columns.insert(columns.end(), {{"stage", ""}, {"cycle", "1"}});
  return columns;
}

std::vector<Cell> step_row(const coupling::StepRecord& r, StepTable table) {
  const auto whole = [](int value) { return static_cast<std::int64_t>(value); };
  const coupling::ContactSummary contact = total(r.contacts);
  std::vector<Cell> cells = {r.time,
                             whole(r.number),
                             r.dt,
                             r.reason,
                             whole(r.rejected),
                             r.rejection,
                             r.temperature_error,
                             r.displacement_error,
                             whole(r.output ? 1 : 0),
                             whole(r.heat.iterations),
                             whole(r.heat.linear_iterations),
                             r.heat.residual,
                             r.heat.seconds,
                             whole(r.mechanics.iterations),
                             whole(r.mechanics.linear_iterations),
                             r.mechanics.residual,
                             r.mechanics.seconds,
                             whole(r.coupling_iterations),
                             whole(contact.closed_points),
                             whole(contact.points),
                             r.solid_fraction,
                             r.min_temperature - k_zero_celsius,
                             r.max_temperature - k_zero_celsius,
                             r.energy.contact,
                             r.energy.numerical,
                             r.energy.work,
                             r.energy.viscous_dissipation,
                             r.energy.plastic_dissipation,
                             r.energy.plastic_work};
  if (table.heat)
    cells.insert(cells.end(), {r.energy.stored_heat, r.energy.structural, r.energy.heat_in,
                               r.energy.heat_exchanged, r.energy.defect()});
  if (table.dynamics) cells.emplace_back(r.energy.kinetic);
  if (table.stability)
    cells.insert(cells.end(),
                 {r.stability.mechanical, r.stability.thermal, r.stability.tolerance, r.stability.entropy,
                  r.stability.entropy + r.stability.frictional_entropy + r.energy.inelastic_entropy -
                      r.energy.entropy_in});
  if (table.stages) {
    cells.emplace_back(r.stage);
    cells.emplace_back(whole(r.cycle));
  }
  return cells;
}

std::vector<Reading> GlobalHistory::all() const {
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
  }
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
  if (options_.plastic) {
    add("plastic_dissipation", "J", sum_.plastic_dissipation);
    add("plastic_work", "J", sum_.plastic_work);
    add("hardening_energy", "J", sum_.hardening());
    add("inelastic_entropy", "J/K", sum_.inelastic_entropy);
  }
  if (options_.stability) {
    add("lyapunov", "J", stability_.increment());
    add("lyapunov_mechanical", "J", last_.stability.mechanical);
    add("lyapunov_thermal", "J", last_.stability.thermal);
    add("entropy", "J/K", stability_.entropy);
    add("entropy_production", "J/K",
        stability_.entropy + stability_.frictional_entropy + sum_.inelastic_entropy - sum_.entropy_in);
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
                       [&](const Column& c) { return c.header() == entry.first.header(); });
  });
  return all;
}

std::vector<Column> GlobalHistory::columns() const {
  std::vector<Column> columns;
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
