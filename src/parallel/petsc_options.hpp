/// Options of PETSc: those of the user, and defaults of Solidus where the user gives none.
#pragma once

#include <string>

namespace solidus::petsc {

/// PETSc's name and version.
std::string version();

/// Gives an option that the user has not given. Solvers within solvers do not exist before their set-up, but
/// their options do.
void set_default_option(const std::string& name, const std::string& value);

/// Whether the user, not set_default_option(), gave an option whose name begins so; without the dash.
bool user_gave_option(const std::string& beginning);

}  // namespace solidus::petsc
