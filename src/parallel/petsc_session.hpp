/// PETSc and MPI from their start to their end.
#pragma once

#include <string>
#include <vector>

namespace solidus::petsc {

/// Starts PETSc, and MPI, where neither runs yet.
/// @param options  of PETSc, as on a command line. A .petscrc of the present folder or the home is not read,
///                 for it would change answers in silence, and signals stay the caller's.
/// Returns false where PETSc cannot start; its message then is on the standard error. Throws InputError
/// where MPI needs a folder for temporary files and none can be written.
bool start(const std::vector<std::string>& options);
/// Whether a launcher of MPI has started this process, and all others of the run on this machine. Before
/// start() too.
bool all_on_one_machine();
/// start() tells MPI to call sched_yield() whenever it finds nothing while it waits, where
/// all_on_one_machine() and unless OMPI_MCA_mpi_yield_when_idle says otherwise. For programs whose
/// sched_yield() does not hand the core to others for long. Before start().
void yield_in_waits();
/// The processes of a communicator, by its number in Fortran, in place of all. Before start().
void use_communicator(int fortran_number);
bool running();
/// Ends PETSc, and MPI where start() has started it. Does nothing unless running().
void end();

}  // namespace solidus::petsc
