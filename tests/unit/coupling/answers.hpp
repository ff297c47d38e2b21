/// All numbers that a pass hands out, by name, and their comparison to the last bit.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "contact/pair.hpp"
#include "coupling/observer.hpp"
#include "coupling/state.hpp"
#include "mechanics/structural_heat.hpp"
#include "system/processes.hpp"

namespace solidus::test {

using Answers = std::map<std::string, std::vector<double>>;

/// To the last bit. On several processes solvers add up in the order in which messages arrive: a solution
/// that is found again is the same to rounding there.
inline void expect_same(const Answers& a, const Answers& b, const std::string& what,
                        bool found_again = true) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (const auto& [name, values] : a) {
    const std::vector<double>& others = b.at(name);
    ASSERT_EQ(values.size(), others.size()) << what << ": " << name;
    if (!found_again || processes::count() == 1) {
      EXPECT_EQ(values, others) << what << ": " << name;
      continue;
    }
    double size = 0, difference = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      size = std::max(size, std::abs(values[i]));
      difference = std::max(difference, std::abs(values[i] - others[i]));
    }
    EXPECT_LE(difference, 1e-6 * size) << what << ": " << name;
  }
}

inline void add(const std::string& name, const std::vector<mechanics::BlockHistory>& blocks, Answers& to) {
  std::vector<double>& values = to[name];
  for (const mechanics::BlockHistory& block : blocks)
    for (const Lane& pack : block.values)
      for (int lane = 0; lane < k_lanes; ++lane) values.push_back(pack[lane]);
}

inline void add(const mesh::Mesh& mesh, const mechanics::MechanicalState& state, Answers& to) {
  using mechanics::ElementField;
  to["displacement"] = state.displacement;
  to["pressure"] = state.pressure;
  add("history", state.history, to);
  add("stress at points", state.stress, to);
  for (const auto& [name, field] : {std::pair{"stress", ElementField::stress},
                                    {"strain", ElementField::strain},
                                    {"plastic strain", ElementField::plastic_strain},
                                    {"dissipation", ElementField::dissipation},
                                    {"thermal dissipation", ElementField::thermal_dissipation},
                                    {"intermediate temperature", ElementField::intermediate_temperature},
                                    {"pores", ElementField::pore_fraction}})
    to[std::string("elements: ") + name] = mechanics::element_field(mesh, state, field);
}

inline void add(const mechanics::MechanicalReport& report, Answers& to) {
  const mechanics::MechanicalWork& w = report.work;
  to["reactions"] = report.reactions;
  to["applied"] = report.applied;
  to["work"] = {w.external_work, w.support_work,        w.residual_work,     w.internal_work,
                w.dissipation,   w.plastic_dissipation, w.plastic_work,      w.inelastic_entropy,
                w.kinetic,       w.numerical,           w.least_dissipation, w.largest_dissipation};
}

/// The numbers of a deformation that the heat balance and the audit read.
/// @param heat         of the phase that has found it; is given this deformation
/// @param temperature  at the end of the step [K], [local node]
inline void add(mechanics::StructuralHeat& heat, const mechanics::StepDeformation& deformation,
                const std::vector<double>& temperature, Answers& to) {
  std::vector<double> r(temperature.size(), 0.0);
  heat.set_deformation(deformation);
  heat.add_residual(temperature, r);
  to["heat of deformation"] = std::move(r);
  const mechanics::StructuralChange whole = structural_change(deformation, temperature),
                                    mechanical = mechanical_change(deformation);
  to["structural change"] = {whole.energy, whole.entropy, whole.transformed, mechanical.energy,
                             mechanical.entropy};
}

inline void add(const heat::ThermalState& state, Answers& to) {
  to["temperature"] = state.temperature;
  to["enthalpy"] = state.enthalpy;
}

inline void add(const heat::ThermalReport& report, Answers& to) {
  const heat::HeatBalance& b = report.balance;
  to["balance"] = {b.stored, b.sensible, b.latent, b.entropy_in, b.exchanged};
  to["contributions"] = b.contributions;
  for (const heat::ConditionHeat& condition : b.conditions)
    to["condition " + condition.name] = {condition.heat};
  to["first flow"] = report.flows.first;
  to["last flow"] = report.flows.last;
}

inline void add(const std::vector<contact::ContactState>& contacts, Answers& to) {
  std::vector<double>& values = to["contact points"];
  for (const contact::ContactState& contact : contacts) {
    for (const contact::ContactPointState& p : contact.points) {
      values.insert(values.end(), {static_cast<double>(p.status), p.offset, p.penetration, p.pressure,
                                   p.balance_pressure, p.multiplier, p.suction, p.internal_variable, p.slip,
                                   p.work, p.dissipation, p.wear_depth, p.temperature, p.plastic_entropy});
      values.insert(values.end(), p.traction.begin(), p.traction.end());
      values.insert(values.end(), p.anchor.begin(), p.anchor.end());
    }
    for (const contact::WornNode& node : contact.master)
      values.insert(values.end(), {node.volume, node.dissipation});
  }
}

inline void add(const coupling::StepEffort& effort, Answers& to) {
  const coupling::EnergyAudit& e = effort.energy;
  to["energy"] = {e.stored_heat,
                  e.structural,
                  e.contact,
                  e.friction,
                  e.numerical,
                  e.work,
                  e.heat_in,
                  e.heat_exchanged,
                  e.plastic_work,
                  e.plastic_dissipation,
                  e.inelastic_entropy,
                  effort.stability.mechanical,
                  effort.stability.thermal,
                  effort.stability.entropy};
  to["reactions"] = effort.fields.reactions;
}

}  // namespace solidus::test
