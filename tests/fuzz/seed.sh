#!/usr/bin/env bash
# seed.sh FOLDER: the files that the fuzzers set out from, a folder for each reader.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
corpus=$1
mkdir -p "$corpus"/{case,material,point,csv,overrides,checkpoint}
for file in cases/*/*.toml tests/robustness/mutate/corpus/*.toml; do
  case $file in cases/point/* | */plots.toml) continue ;; esac
  cp "$file" "$corpus/case/$(tr / _ <<<"$file")"
done
cp materials/*.toml "$corpus/material/"
cp cases/point/*.toml "$corpus/point/"
cp tests/fuzz/csv/* "$corpus/csv/"
cp tests/fuzz/overrides/* "$corpus/overrides/"
find build/release/case_runs -name state.h5 -size -40k 2>/dev/null | head -3 | while read -r file; do
  cp "$file" "$corpus/checkpoint/$(basename "$(dirname "$(dirname "$file")")").h5"
done
