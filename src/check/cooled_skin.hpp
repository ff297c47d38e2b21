/// The skin of a body by what lies beyond it: contacts with other bodies and tools, faces that bodies share,
/// films, radiation, fluxes and prescribed temperatures.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "check/case_measures.hpp"
#include "mesh/mesh.hpp"
#include "setup/assembly.hpp"

namespace solidus::check {

/// The case, its stage, its assembly and its measures, from which the surroundings of a body are found.
struct Surroundings {
  const cases::CaseSpec& spec;
  const cases::StageRun* stage;  ///< null without stages
  const setup::Assembly& a;
  const CaseMeasures& m;  ///< with bodies, contacts and surfaces
};

/// A part of the skin of a body that something cools, heats or holds.
struct CooledSkin {
  double area = 0;
  double cooling = 0;                ///< at the start, over the run the largest [W/m²]
  std::vector<mesh::Point> points;   ///< on it
  std::string surface;               ///< of the mesh; empty: faces that bodies share
  std::optional<std::size_t> other;  ///< the body on the other side
  double low = 0, high = 0;          ///< temperatures of that body when the metal comes [K]
  std::function<double(double, double, double)> conductance;  ///< to it: MouldSide::conductance
  bool may_open = false;
  std::function<double(double, double)> heat;  ///< without: into the body [W/m²], OpenSide::heat
};

/// All of them, some of which may not cool. Collective.
std::vector<CooledSkin> skins_of(std::size_t body, const Surroundings& in);

/// Largest heat flux into a skin at the start or later in the run, at the temperature of the pour [W/m²].
double cooling_of(const CooledSkin& skin, double start, double end);

/// Heat into metal through its cooled skins, per its volume [W/m³]; moulds as half spaces.
std::function<double(double, double)> heat_by_volume(std::vector<CooledSkin> skins, double volume,
                                                     const setup::Assembly& a);

/// Heat into the outside of a mould per area of the casting's cooled skin [W/m²]; empty where nothing is.
/// @param part  of the mould that counts
std::function<double(double, double)> outer_heat(std::size_t mould, double cooled_area, double part,
                                                 const Surroundings& in);

/// Whether a body comes in that is not solid then.
bool comes_in_molten(const setup::Assembly& a, std::size_t body);

/// The nodes of a body: [local node]
std::vector<char> nodes_of(const mesh::Mesh& mesh, std::size_t body);

}  // namespace solidus::check
