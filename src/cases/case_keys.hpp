/// The declaration of every key of a case file.
#pragma once

#include "cases/case_spec.hpp"
#include "input/keys.hpp"

namespace solidus::cases {

/// The whole file. Reading, `solidus explain`, `solidus schema` and the reference manual follow from it.
const Section<CaseSpec>& case_keys();

// The sections it is made of.
Section<AnalysisSpec> analysis_keys();
Section<MeshSpec> mesh_keys();
Section<TimeSpec> time_keys();
Section<StageSpec> stage_keys();
Section<CycleSpec> cycle_keys();
Section<BodySpec> body_keys();
Section<ThermalConditionSpec> thermal_condition_keys();
Section<ChannelSpec> channel_keys();
Section<SourceSpec> source_keys();
Section<DepositionSpec> deposition_keys();
Section<MechanicalConditionSpec> mechanical_condition_keys();
Section<RotationSpec> rotation_keys();
Section<ContactSpec> contact_keys();
/// [contact.heat] and [interface.heat].
Section<contact::HeatTransferSpec> contact_heat_keys();
Section<BodyInterfaceSpec> body_interface_keys();
Section<RigidSurfaceSpec> rigid_surface_keys();
Section<heat::HeatOptions> heat_keys();
Section<MechanicsSpec> mechanics_keys();
Section<DynamicsSpec> dynamics_keys();
Section<CouplingSpec> coupling_keys();
Section<ProbeSpec> probe_keys();
Section<ProfileSpec> profile_keys();
Section<CriteriaSpec> criteria_keys();
Section<DieLifeSpec> die_life_keys();
Section<JetSpec> jet_keys();
Section<ShotSleeveSpec> shot_sleeve_keys();
Section<FeedingSpec> feeding_keys();
Section<GasSpec> gas_keys();
Section<FillingSpec> filling_keys();
Section<OutputSpec> output_keys();

}  // namespace solidus::cases
