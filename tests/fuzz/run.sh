#!/usr/bin/env bash
# run.sh READER SECONDS: fuzzes one reader from build/fuzz/corpus; what goes wrong lies in build/fuzz/crashes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mkdir -p build/fuzz/crashes
# The program's own leaks are looked for by the tests; MPI and udunits keep what they have made.
ASAN_OPTIONS=detect_leaks=0 exec build/fuzz/tests/fuzz/fuzz_"$1" build/fuzz/corpus/"$1" -max_total_time="$2" \
  -max_len=40000 -timeout=20 -rss_limit_mb=2048 -dict=tests/fuzz/toml.dict -artifact_prefix=build/fuzz/crashes/"$1"- \
  -print_final_stats=1 -print_funcs=0 -verbosity=0
