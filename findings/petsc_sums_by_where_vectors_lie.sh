#!/usr/bin/env bash
# What:      VecMDot, the scalar products of a vector with several, differs in its last bits between two runs with the same numbers: since
#            3.20 it is a product with a matrix by default where the vectors lie at equal distances in memory, and OpenBLAS sums in another
#            order there. Where vectors lie is chance. -vec_mdot_use_gemv 0 gives the same bits always.
# Versions:  PETSc 3.22.5, petsc4py 3.22.4, OpenBLAS 0.3.29 (Debian 13)
# Seen on:   28 November 2026, Debian 12, x86-64, with OpenBLAS' kernels for Prescott, Nehalem, Haswell, SkylakeX and Zen
# Matters:   GMRES orthogonalises by it: iterations, and with them results, are not the same twice.
# Solidus:   sets the option to 0 unless a user asks for it (src/parallel/petsc_options.cpp, docs/guide/install.md).
. "$(dirname "${BASH_SOURCE[0]}")/common/root.sh"

make_root trixie python3-petsc4py-real=3.22.4-1 libopenblas0-serial=0.3.29+ds-3 python3-numpy=1:2.2.4+ds-1
python_path=/usr/lib/petscdir/petsc3.22/x86_64-linux-gnu-real/lib/python3/dist-packages
environment=(OPENBLAS_CORETYPE=Nehalem UCX_LOG_LEVEL=fatal OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)

# Scalar products of one vector with four, which lie one behind the other or with gaps between them.
products() {
  inside python3 - "$@" 2>/dev/null <<'PYTHON'
import sys

import numpy as np
import petsc4py

petsc4py.init(sys.argv)
from petsc4py import PETSc

n, rng = 10007, np.random.default_rng(1)
values, others = rng.standard_normal(n), rng.standard_normal((4, n))
x = PETSc.Vec().createWithArray(values, comm=PETSc.COMM_SELF)
results = set()
for gaps in ((0, 0, 0, 0), (0, 0, 8, 0), (0, 8, 16, 40), (1, 2, 3, 4)):
    memory, at, vectors = np.empty(5 * n), 0, []
    for gap, other in zip(gaps, others):
        place = memory[at + gap : at + gap + n]
        place[:] = other
        at += gap + n
        vectors.append(PETSc.Vec().createWithArray(place, comm=PETSc.COMM_SELF))
    results.add(tuple(float(product).hex() for product in x.mDot(vectors)))
print(".".join(map(str, PETSc.Sys.getVersion())), *sys.argv[1:], "one result" if len(results) == 1 else "several results")
PYTHON
}

expect "$(products; products -vec_mdot_use_gemv 0)" <<END
3.22.5 several results
3.22.5 -vec_mdot_use_gemv 0 one result
END
