/// Makes contacts from [[interface]] sections: the faces of the mesh that face each other, the laws of the
/// library (docs/guide/interfaces.md).
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "mesh/making/body_interfaces.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::setup {

/// A contact that an interface makes: what process 0 finds and tells the others.
struct FoundInterface {
  std::size_t section = 0;  ///< of CaseSpec::interfaces
  int a = 0, b = 0;         ///< bodies
  std::string surface_a, surface_b;
  double distance = 0;  ///< that was looked within [m]
};

/// Looks for the faces of all [[interface]] sections, gives bodies that share nodes their own, and makes the
/// groups A_to_B and A_free. Prints what it has found. On process 0.
/// Throws InputError where a section that names two bodies finds nothing.
std::vector<FoundInterface> find_interfaces(const cases::CaseSpec& spec, mesh::RawMesh& mesh,
                                            const std::string& source);

/// Adds the contacts, with laws from the library, on every process. Throws InputError where the library has
/// no law, or none of the name.
void add_contacts(const std::vector<FoundInterface>& found, cases::CaseSpec& spec);

/// Makes the groups of [[mesh.group]] sections that are rules. On process 0.
void add_rule_groups(const cases::CaseSpec& spec, mesh::RawMesh& mesh, const std::string& source);

}  // namespace solidus::setup
