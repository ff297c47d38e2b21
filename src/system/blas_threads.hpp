/// Threads of the library for dense linear algebra (BLAS).
#pragma once

namespace solidus {

/// Processes are what Solidus computes in parallel with. Debian's OpenBLAS with threads, which other packages
/// bring along, would start one thread for each core in every process: they fight over the cores, and last
/// bits depend on how many there are. From here on it has one, unless OPENBLAS_NUM_THREADS or OMP_NUM_THREADS
/// says otherwise.
void use_one_thread_of_blas();

}  // namespace solidus
