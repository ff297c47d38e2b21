/// Everything that a scheme drives, built from a case: mesh, materials, phases, contacts.
#pragma once

#include <memory>
#include <vector>

#include "cases/case_spec.hpp"
#include "cases/stage_input.hpp"
#include "contact/pair.hpp"
#include "coupling/phases.hpp"
#include "coupling/state.hpp"
#include "setup/criteria_input.hpp"
#include "setup/deposition.hpp"
#include "setup/initial_temperature.hpp"

namespace solidus::setup {

/// The phases refer to the mesh, the materials and each other: it stays where it is.
struct Assembly {
  mesh::Mesh mesh;
  std::vector<material::Material> materials;
  std::vector<std::unique_ptr<contact::ContactPair>> contacts;
  std::unique_ptr<Deposition> growth;  ///< null: nothing grows
  std::unique_ptr<mechanics::MechanicalPhase> mechanics;
  std::unique_ptr<mechanics::StructuralHeat> structural;
  std::unique_ptr<heat::ThermalPhase> heat;
  std::unique_ptr<coupling::Coherency> coherency;  ///< null: nothing that deforms melts
  std::unique_ptr<coupling::SkinShare> skin;       ///< the same
  std::unique_ptr<criteria::Criteria> criteria;    ///< null: nothing is followed
  LocalLaws local_laws;                            ///< that criteria know
  coupling::Phases phases;
  coupling::State initial;
  std::unique_ptr<InitialTemperatures> initial_temperatures;
  std::vector<InitialTemperatureRange> start;  ///< initial temperatures, [body]
  std::vector<cases::StageRun> stages;         ///< empty: the case has none
  Assembly() = default;
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;
  double coldest_start() const;  ///< [K]
  const cases::StageRun* first_stage() const { return stages.empty() ? nullptr : &stages.front(); }
};

/// Makes contacts, phases and the initial state of an assembly that has its mesh and materials. The case must
/// outlive it. Collective. Throws InputError.
void build(const cases::CaseSpec& spec, Assembly& a);

/// Gives the phases the conditions of a stage that begins at this displacement. Collective.
/// @param number  in Assembly::stages
/// @param begins  its state, which loses the heat of bodies that leave, and gets bodies that come as they are
///                drawn and poured; null where a run goes on inside it
/// Returns the heat of these bodies.
coupling::BodyHeat apply(const cases::CaseSpec& spec, std::size_t number,
                         const std::vector<double>& displacement, coupling::State* begins, Assembly& a);

}  // namespace solidus::setup
