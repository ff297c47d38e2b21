/// history.csv: the whole model after a step. Temperatures and contact, then the sums of the first law, and
/// stability. Columns of contacts, sources and channels stand between them.
#include <algorithm>
#include <array>

#include "coupling/columns.hpp"
#include "heat/columns.hpp"

namespace solidus::coupling {

namespace {

using quantities::Chart;
using HistoryColumn = quantities::ReadColumn<HistoryParts, RunSums, double>;

constexpr auto in_all_runs = [](const HistoryParts&) { return true; };
constexpr auto with_melting = [](const HistoryParts& p) { return p.melting; };
constexpr auto with_contact = [](const HistoryParts& p) { return p.contact; };
constexpr auto with_heat = [](const HistoryParts& p) { return p.heat; };
constexpr auto with_channels = [](const HistoryParts& p) { return p.heat && !p.channels.empty(); };
constexpr auto that_grow = [](const HistoryParts& p) { return p.grows; };
constexpr auto with_bodies = [](const HistoryParts& p) { return p.heat && p.bodies; };
constexpr auto with_mechanics = [](const HistoryParts& p) { return p.mechanics; };
constexpr auto with_mechanics_and_heat = [](const HistoryParts& p) { return p.mechanics && p.heat; };
constexpr auto with_forces = [](const HistoryParts& p) { return p.mechanics && p.contact; };
constexpr auto with_inertia = [](const HistoryParts& p) { return p.dynamics; };
constexpr auto with_damping = [](const HistoryParts& p) { return p.dynamics || (p.mechanics && p.contact); };
constexpr auto with_plasticity = [](const HistoryParts& p) { return p.plastic; };
constexpr auto with_stability = [](const HistoryParts& p) { return p.stability; };
constexpr auto with_internal_energy = [](const HistoryParts& p) { return p.internal_energy; };

double closed_fraction(const ContactSummary& all) {
  return all.points > 0 ? static_cast<double>(all.closed_points) / all.points : 0.0;
}

/// The end of the step: temperatures, solid fraction, contact.
constexpr auto k_state = std::to_array<HistoryColumn>({
    {columns::k_lowest_temperature, in_all_runs,
     [](const RunSums& s) { return s.last.min_temperature - k_zero_celsius; }},
    {columns::k_highest_temperature, in_all_runs,
     [](const RunSums& s) { return s.last.max_temperature - k_zero_celsius; }},
    {columns::k_solid_fraction, with_melting, [](const RunSums& s) { return s.last.solid_fraction; }},
    {{.name = "closed_fraction",
      .unit = "1",
      .label = "Closed fraction",
      .doc = "Share of the points of contact that touch",
      .when = "with contact"},
     with_contact,
     [](const RunSums& s) { return closed_fraction(total(s.last.contacts)); }},
    {{.name = "contact_heat",
      .unit = "W",
      .label = "Contact heat",
      .doc = "Heat from slave to master, of all contacts",
      .when = "with contact"},
     with_contact,
     [](const RunSums& s) { return total(s.last.contacts).heat; }},
    {{.name = "contact_force",
      .unit = "N",
      .label = "Contact force",
      .doc = "Resultant normal force of all contacts",
      .when = "with contact"},
     with_contact,
     [](const RunSums& s) { return total(s.last.contacts).force; }},
});

/// Heat since the start.
constexpr auto k_heat = std::to_array<HistoryColumn>({
    {columns::k_stored_heat, with_heat, [](const RunSums& s) { return s.energy.stored_heat; }},
    {columns::k_heat_in, with_heat, [](const RunSums& s) { return s.energy.heat_in; }},
});

/// Behind the power of sources and before the columns of each channel.
constexpr auto k_channels = std::to_array<HistoryColumn>({
    {{.name = "heat_to_channels",
      .unit = "J",
      .label = "Heat to channels",
      .doc = "Heat that the fluids of all channels have taken up",
      .when = "with cooling channels",
      .chart = Chart::heat},
     with_channels,
     [](const RunSums& s) { return s.energy.to_channels; }},
});

/// The balances since the start.
constexpr auto k_balance = std::to_array<HistoryColumn>({
    {{.name = "deposited_mass",
      .unit = "kg",
      .label = "Deposited mass",
      .doc = "Mass of the bodies that grow, so far",
      .when = "with bodies that grow"},
     that_grow,
     [](const RunSums& s) { return s.mass; }},
    {columns::k_heat_poured, with_bodies, [](const RunSums& s) { return s.energy.bodies.poured; }},
    {columns::k_heat_ejected, with_bodies, [](const RunSums& s) { return s.energy.bodies.ejected; }},
    {columns::k_heat_corrected, with_bodies, [](const RunSums& s) { return s.energy.bodies.corrected; }},
    {{.name = "heat_of_bodies",
      .unit = "J",
      .label = "Heat of bodies",
      .doc = "Heat content of the present bodies, from 20 °C",
      .when = "with shots or bodies that grow",
      .chart = Chart::heat},
     with_bodies,
     [](const RunSums& s) { return s.heat_of_bodies; }},
    {columns::k_structural_energy, with_mechanics_and_heat,
     [](const RunSums& s) { return s.energy.structural; }},
    {columns::k_work, with_mechanics, [](const RunSums& s) { return s.energy.work; }},
    {columns::k_contact_energy, with_forces, [](const RunSums& s) { return s.energy.contact; }},
    {columns::k_kinetic_energy, with_inertia, [](const RunSums& s) { return s.energy.kinetic; }},
    {columns::k_numerical_dissipation, with_damping, [](const RunSums& s) { return s.energy.numerical; }},
    {columns::k_viscous_dissipation, with_mechanics,
     [](const RunSums& s) { return s.energy.viscous_dissipation; }},
    {columns::k_plastic_dissipation, with_plasticity,
     [](const RunSums& s) { return s.energy.plastic_dissipation; }},
    {columns::k_plastic_work, with_plasticity, [](const RunSums& s) { return s.energy.plastic_work; }},
    {{.name = "hardening_energy",
      .unit = "J",
      .label = "Hardening energy",
      .doc = "The part of the plastic work that is stored",
      .when = "with plasticity",
      .chart = Chart::mechanical_energies},
     with_plasticity,
     [](const RunSums& s) { return s.energy.hardening(); }},
    {{.name = "inelastic_entropy",
      .unit = "J/K",
      .label = "Inelastic entropy",
      .doc = "The entropy S^I that plastic flow has made, a part of `entropy_production`",
      .when = "with plasticity",
      .chart = Chart::entropy},
     with_plasticity,
     [](const RunSums& s) { return s.energy.inelastic_entropy; }},
    {{.name = "lyapunov",
      .unit = "J",
      .label = "𝓛",
      .doc = "The functional of a-priori stability (monograph 2.24) since the start",
      .when = "with heat and mechanics",
      .chart = Chart::stability},
     with_stability,
     [](const RunSums& s) { return s.stability.increment(); }},
    {columns::k_lyapunov_mechanical, with_stability,
     [](const RunSums& s) { return s.last.stability.mechanical; }},
    {columns::k_lyapunov_thermal, with_stability, [](const RunSums& s) { return s.last.stability.thermal; }},
    {columns::k_entropy, with_stability, [](const RunSums& s) { return s.stability.entropy; }},
    {columns::k_entropy_production, with_stability,
     [](const RunSums& s) { return entropy_production(s.stability, s.energy); }},
    {columns::k_heat_exchanged, with_heat, [](const RunSums& s) { return s.energy.heat_exchanged; }},
    {columns::k_energy_defect, with_heat, [](const RunSums& s) { return s.energy.defect(); }},
    {{.name = "internal_energy",
      .unit = "J",
      .label = "Internal energy",
      .doc = "Energy of the present state less that of the first one, both computed from their fields",
      .when = "with structural heat; not with a specific heat at constant strain in a body that changes its "
              "phase or whose moduli, expansion or hardening depend on temperature",
      .chart = Chart::heat},
     with_internal_energy,
     [](const RunSums& s) { return s.energy.internal; }},
    {{.name = "internal_energy_defect",
      .unit = "J",
      .label = "Defect of the internal energy",
      .doc = "This difference less heat and work: the first law without a sum over steps",
      .when = "as `internal_energy`",
      .chart = Chart::energy_imbalance},
     with_internal_energy,
     [](const RunSums& s) { return s.energy.state_defect(); }},
});

void add(std::span<const HistoryColumn> rows, const HistoryParts& parts, const RunSums& sums,
         std::vector<ReadValue>& to) {
  for (const HistoryColumn& row : rows)
    if (row.there(parts)) to.push_back({&row.column, {}, row.read(sums)});
}

void add_pair(const HistoryPair& pair, const ContactSummary& sums, std::vector<ReadValue>& to) {
  for (const PairColumn& row : pair_columns())
    if (row.there(pair)) to.push_back({&row.column, pair.name, row.read(sums)});
}

/// The mean power of the step, and the fluid at the end of it.
void add_channel(const std::string& name, const StepEffort& last, std::vector<ReadValue>& to) {
  heat::ChannelSource source{{}, last.power_of(name)};
  for (const heat::ChannelReading& reading : last.channels)
    if (reading.name == name) source.reading = reading;
  for (const heat::ChannelColumn& row : heat::channel_columns())
    to.push_back({&row.column, name, row.read(source)});
}

void add(std::span<const HistoryColumn> rows, std::vector<const Column*>& to) {
  for (const HistoryColumn& row : rows) to.push_back(&row.column);
}

}  // namespace

double entropy_production(const StabilityAudit& stability, const EnergyAudit& energy) {
  return stability.entropy + stability.frictional_entropy + energy.inelastic_entropy - energy.entropy_in;
}

std::vector<ReadValue> history_values(const HistoryParts& parts, const RunSums& sums) {
  std::vector<ReadValue> values;
  add(k_state, parts, sums, values);
  for (std::size_t i = 0; i < parts.pairs.size(); ++i)
    add_pair(parts.pairs[i], i < sums.last.contacts.size() ? sums.last.contacts[i] : ContactSummary{},
             values);
  add(k_heat, parts, sums, values);
  if (parts.heat) {
    for (const std::string& source : parts.sources)
      values.push_back({&heat::k_power, source, sums.last.power_of(source)});
    add(k_channels, parts, sums, values);
    for (const std::string& channel : parts.channels) add_channel(channel, sums.last, values);
  }
  add(k_balance, parts, sums, values);
  return values;
}

std::vector<const Column*> history_columns() {
  std::vector<const Column*> columns;
  add(k_state, columns);
  for (const PairColumn& row : pair_columns()) columns.push_back(&row.column);
  add(k_heat, columns);
  add(k_channels, columns);
  for (const heat::ChannelColumn& row : heat::channel_columns()) columns.push_back(&row.column);
  add(k_balance, columns);
  return columns;
}

}  // namespace solidus::coupling
