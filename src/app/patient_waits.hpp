/// Waits of MPI that leave the core to others (decision 0077).
#pragma once

namespace solidus::app {

/// From here on sched_yield(), which Open MPI calls while it waits (petsc::yield_in_waits()), sleeps where a
/// wait is long. For programs that MPI has started along with others on the same machine.
void wait_patiently();

}  // namespace solidus::app
