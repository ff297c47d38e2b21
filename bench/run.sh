#!/usr/bin/env bash
# Runs benchmarks and writes build/bench/report.md; ./dev bench builds first.
#   bench/run.sh [PART ...]      parts: micro heat case coupling check cylinder mixed scaling nodes20k nodes100k nodes300k; without: all but the last
#   REPEAT=3 bench/run.sh case   medians of three runs (the default; the large blocks run once)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
((EUID != 0)) || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
exec /usr/bin/python3 bench/measure.py "$@"
