/// Options of PETSc: those of the user, and defaults of Solidus where the user gives none.
#pragma once

#include <string>

namespace solidus::petsc {

/// PETSc's name and version.
std::string version();

/// Gives an option that the user has not given. Solvers within solvers do not exist before their set-up, but
/// their options do.
void set_default_option(const std::string& name, const std::string& value);

/// Has scalar products of vectors summed in the same order in every run, where the user does not say
/// otherwise. Before the vectors of a solver are made.
///
/// From 3.20 on PETSc takes several scalar products at once by gemv of BLAS, whose order of summing depends
/// on where in memory the vectors lie: two runs of one process then differ in the last bits. Set where no
/// vector follows, PETSc would warn of unused options at its end.
void make_scalar_products_reproducible();

/// Whether the user, not set_default_option(), gave an option whose name begins so; without the dash.
bool user_gave_option(const std::string& beginning);

}  // namespace solidus::petsc
