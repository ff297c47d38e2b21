/// The columns of steps.csv, of history.csv beside time and probes, and of shots.csv: quantities of steps, of
/// the whole model and of its contacts. Each is a row with the runs that have it and how it is read.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "coupling/observer.hpp"
#include "coupling/shot.hpp"
#include "numbers/types.hpp"
#include "quantities/column.hpp"

namespace solidus::coupling {

using quantities::Column;

/// The parts of a run on which the columns of steps.csv depend.
struct StepParts {
  bool dynamics = false;   ///< bodies have inertia
  bool stability = false;  ///< 𝓛 is followed
  bool stages = false;     ///< the run has stages
  /// Heat is followed, and with it the first law, which mechanics alone does not close, because the energy of
  /// deformation is not counted there.
  bool heat = true;
};

/// A step and the sums over its contacts.
struct StepSource {
  const StepRecord& record;
  ContactSummary contact;
};
using StepColumn = quantities::ReadColumn<StepParts, StepSource>;
/// steps.csv in its order.
std::span<const StepColumn> step_columns();

/// A contact whose columns history.csv has; their names begin with the contact's.
struct HistoryPair {
  std::string name;
  bool friction = false;
  bool heat = false;
  AnalysisKind kind = AnalysisKind::plane_strain;
};

/// The parts of a run on which the columns of history.csv depend.
struct HistoryParts {
  bool melting = true, contact = true, mechanics = true;
  bool plastic = false;    ///< a material can flow plastically
  bool dynamics = false;   ///< bodies have inertia
  bool stability = false;  ///< 𝓛 is followed
  std::vector<HistoryPair> pairs = {};
  bool heat = true;                        ///< is followed: the first law is audited
  bool internal_energy = false;            ///< states have one (coupling/internal_energy.hpp)
  std::vector<std::string> sources = {};   ///< names of sources that travel: a column of power for each
  std::vector<std::string> channels = {};  ///< names of channels: columns of the fluid of each
  bool grows = false;                      ///< bodies grow: their mass is a column
  bool bodies = false;                     ///< bodies leave and come: their heat is part of the balance
};

/// The run so far: its last step, and sums over all steps.
struct RunSums {
  StepEffort last;
  EnergyAudit energy;
  StabilityAudit stability;
  double mass = 0;            ///< that has been deposited [kg]
  double heat_of_bodies = 0;  ///< of the active ones, counted from 20 °C [J]
};
/// ΔS of a step or a run less what came with heat from outside: not below zero but for errors [J/K].
double entropy_production(const StabilityAudit& stability, const EnergyAudit& energy);

/// A number of a run under its column; of a contact, a channel or a source the name stands before the
/// column's.
struct ReadValue {
  const Column* column;
  std::string of;  ///< empty: of the whole model
  double value;
};
/// The columns of history.csv behind the probes, in their order.
std::vector<ReadValue> history_values(const HistoryParts& parts, const RunSums& sums);
/// All columns that history.csv can have behind the probes, of every kind of run.
std::vector<const Column*> history_columns();

/// Sums over contacts: points, heat from slave to master, normal force.
ContactSummary total(const std::vector<ContactSummary>& contacts);
using PairColumn = quantities::ReadColumn<HistoryPair, ContactSummary, double>;
/// Of each contact, in the order of history.csv.
std::span<const PairColumn> pair_columns();

/// A shot that is over and the time from its pour to the last melt, −1 where something was liquid [s].
struct ShotSource {
  const ShotRecord& shot;
  double time_to_solidify;
};
using ShotColumn = quantities::ReadColumn<ShotRecord, ShotSource, double>;
/// shots.csv in its order.
std::span<const ShotColumn> shot_columns();

/// Columns that more than one table has.
namespace columns {

inline constexpr Column k_time{
    .name = "time", .unit = "s", .label = "Time", .doc = "Time at the end of the step"};
inline constexpr Column k_stage{.name = "stage",
                                .unit = "1",
                                .label = "Stage",
                                .doc = "Number of the stage in the case, from one",
                                .when = "with stages"};
inline constexpr Column k_cycle{.name = "cycle",
                                .unit = "1",
                                .label = "Cycle",
                                .doc = "How often the cycle has come round, from one; zero outside of cycles",
                                .when = "with stages"};
inline constexpr Column k_shot{.name = "shot",
                               .unit = "1",
                               .label = "Shot",
                               .doc = "Number of the shot, from one",
                               .when = "with shots",
                               .listed = true};
inline constexpr Column k_since_pouring{.name = "time_since_pouring",
                                        .unit = "s",
                                        .label = "Time since pouring",
                                        .doc = "Time since the present shot was poured",
                                        .when = "with shots"};
inline constexpr Column k_lowest_temperature{.name = "T_min",
                                             .unit = "degC",
                                             .label = "Lowest temperature",
                                             .doc = "Over all bodies",
                                             .background = true,
                                             .listed = true};
inline constexpr Column k_highest_temperature{.name = "T_max",
                                              .unit = "degC",
                                              .label = "Highest temperature",
                                              .doc = "Over all bodies",
                                              .background = true,
                                              .listed = true};
inline constexpr Column k_solid_fraction{
    .name = "solid_fraction",
    .unit = "1",
    .label = "Solid fraction",
    .doc =
        "By volume, of the poured metal (bodies that start above their solidus, but not a chill of the same "
        "metal); without such bodies, of all that can melt",
    .when = "with metal that freezes",
    .listed = true};
inline constexpr Column k_stored_heat{.name = "stored_heat",
                                      .unit = "J",
                                      .label = "Stored heat",
                                      .doc = "Change of sensible and latent heat",
                                      .when = "with heat",
                                      .chart = quantities::Chart::heat};
inline constexpr Column k_heat_in{.name = "heat_in",
                                  .unit = "J",
                                  .label = "Heat in",
                                  .doc = "Heat that came through boundaries and from sources",
                                  .when = "with heat",
                                  .chart = quantities::Chart::heat};
inline constexpr Column k_heat_exchanged{.name = "heat_exchanged",
                                         .unit = "J",
                                         .label = "Heat exchanged",
                                         .doc = "The heat with which to compare `energy_defect`",
                                         .when = "with heat",
                                         .chart = quantities::Chart::heat};
inline constexpr Column k_heat_poured{.name = "heat_poured",
                                      .unit = "J",
                                      .label = "Heat poured",
                                      .doc = "Heat that came with bodies",
                                      .when = "with shots or bodies that grow",
                                      .chart = quantities::Chart::heat};
inline constexpr Column k_heat_ejected{.name = "heat_ejected",
                                       .unit = "J",
                                       .label = "Heat ejected",
                                       .doc = "Heat that left with bodies",
                                       .when = "with shots or bodies that grow",
                                       .chart = quantities::Chart::heat};
inline constexpr Column k_heat_corrected{.name = "heat_corrected",
                                         .unit = "J",
                                         .label = "Heat corrected",
                                         .doc = "Heat that the search for the periodic state added",
                                         .when = "with shots or bodies that grow",
                                         .chart = quantities::Chart::heat};
/// Of shots.csv and of "shots" in summary.json.
inline constexpr Column k_poured_at{.name = "poured_at",
                                    .unit = "s",
                                    .label = "Poured at",
                                    .doc = "Time at which it was poured",
                                    .listed = true};
inline constexpr Column k_time_to_solidify{
    .name = "time_to_solidify",
    .unit = "s",
    .label = "Solid after",
    .doc = "Time from the pour to the last melt of all castings; -1 where something was liquid when it left",
    .chart = quantities::Chart::freezing_of_shots,
    .no_value = -1,
    .listed = true};
inline constexpr Column k_largest_change{
    .name = "largest_change",
    .unit = "K",
    .label = "Largest change of a place",
    .doc = "The largest change of the temperature over the shot at a node of the bodies that stay",
    .listed = true};
inline constexpr Column k_periodic{.name = "periodic",
                                   .unit = "1",
                                   .label = "Periodic",
                                   .doc = "1 where the change is within what was asked for"};
inline constexpr Column k_structural_energy{.name = "structural_energy",
                                            .unit = "J",
                                            .label = "Structural energy",
                                            .doc = "Change of the energy of deformation",
                                            .when = "with heat and mechanics",
                                            .chart = quantities::Chart::mechanical_energies};
inline constexpr Column k_work{.name = "work",
                               .unit = "J",
                               .label = "Work",
                               .doc = "Work of loads and supports on the bodies",
                               .when = "with mechanics",
                               .chart = quantities::Chart::mechanical_energies};
inline constexpr Column k_contact_energy{.name = "contact_energy",
                                         .unit = "J",
                                         .label = "Contact energy",
                                         .doc = "Change of the energy in the contact penalties",
                                         .when = "with mechanics and contact",
                                         .chart = quantities::Chart::mechanical_energies};
inline constexpr Column k_kinetic_energy{.name = "kinetic_energy",
                                         .unit = "J",
                                         .label = "Kinetic energy",
                                         .doc = "Change of the energy of motion",
                                         .when = "with inertia",
                                         .chart = quantities::Chart::mechanical_energies};
inline constexpr Column k_numerical_dissipation{
    .name = "numerical_dissipation",
    .unit = "J",
    .label = "Numerical dissipation",
    .doc = "Energy that the time integration removes from contact penalties and motion",
    .when = "with contact or inertia",
    .chart = quantities::Chart::mechanical_energies};
inline constexpr Column k_viscous_dissipation{.name = "viscous_dissipation",
                                              .unit = "J",
                                              .label = "Viscous dissipation",
                                              .doc = "Mechanical work that melt and mush turned into heat",
                                              .when = "with mechanics",
                                              .chart = quantities::Chart::mechanical_energies};
inline constexpr Column k_plastic_dissipation{.name = "plastic_dissipation",
                                              .unit = "J",
                                              .label = "Plastic dissipation",
                                              .doc = "The part of the plastic work that became heat",
                                              .when = "with plasticity",
                                              .chart = quantities::Chart::mechanical_energies};
inline constexpr Column k_plastic_work{.name = "plastic_work",
                                       .unit = "J",
                                       .label = "Plastic work",
                                       .doc = "Work of the deviator on plastic flow",
                                       .when = "with plasticity",
                                       .chart = quantities::Chart::mechanical_energies};
inline constexpr Column k_energy_defect{.name = "energy_defect",
                                        .unit = "J",
                                        .label = "Energy defect",
                                        .doc =
                                            "Stored + structural + contact + kinetic + numerical - work - "
                                            "heat in: the imbalance of the first law",
                                        .when = "with heat",
                                        .chart = quantities::Chart::energy_imbalance};
inline constexpr Column k_lyapunov_mechanical{
    .name = "lyapunov_mechanical",
    .unit = "J",
    .label = "𝓛, mechanical phase",
    .doc = "Change of the functional of stability by the mechanical phase of the last step",
    .when = "with heat and mechanics",
    .chart = quantities::Chart::stability_of_phases};
inline constexpr Column k_lyapunov_thermal{
    .name = "lyapunov_thermal",
    .unit = "J",
    .label = "𝓛, thermal phase",
    .doc = "Change of the functional of stability by the thermal phase of the last step",
    .when = "with heat and mechanics",
    .chart = quantities::Chart::stability_of_phases};
inline constexpr Column k_entropy{
    .name = "entropy",
    .unit = "J/K",
    .label = "Entropy",
    .doc = "Change of the entropy of sensible and latent heat and of deformation",
    .when = "with heat and mechanics",
    .chart = quantities::Chart::entropy};
inline constexpr Column k_entropy_production{.name = "entropy_production",
                                             .unit = "J/K",
                                             .label = "Entropy production",
                                             .doc =
                                                 "Entropy less the entropy of the heat from outside, at the "
                                                 "temperature of the surface where it enters: "
                                                 "produced by conduction, contact and dissipation",
                                             .when = "with heat and mechanics",
                                             .chart = quantities::Chart::entropy};

}  // namespace columns

}  // namespace solidus::coupling
