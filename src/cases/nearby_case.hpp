/// Cases close to a case, that differ from it in steps or mesh alone: what its answers are compared with
/// (results/answers/answer_comparison.hpp).
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"

namespace solidus::cases {

/// How to make a nearby case.
struct NearbyCase {
  std::vector<std::string> overrides;  ///< "path=value", as --set takes them
  std::string why_not;                 ///< why there is none; empty: there is one
};

/// The same with steps about twice as long: tolerances of errors in time four times as large where steps
/// follow them, else the steps that the case asks for.
/// @param displacement_error  that of the case (displacement_error()) [m]
NearbyCase longer_steps(const CaseSpec& spec, double displacement_error);

/// The same with larger elements: twice as large in two dimensions, half as large again in three. There is
/// none where the mesh is a file that was meshed elsewhere.
/// @param from_geometry  the program meshes the file of the case, a geometry
NearbyCase coarser_mesh(const CaseSpec& spec, bool from_geometry);

}  // namespace solidus::cases
