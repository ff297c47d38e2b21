#!/usr/bin/env bash
# seed.sh FOLDER [PROGRAM]: the files that the fuzzers set out from, a folder for each reader.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
corpus=$1 program=${2:-build/release/solidus}
rm -rf "$corpus"
mkdir -p "$corpus"/{case,material,point,csv,overrides,checkpoint,mesh,vtk,openfoam,import,report}
for file in cases/*/*.toml tests/robustness/mutate/corpus/*.toml; do
  case $file in cases/point/* | */plots.toml | */variants.toml) continue ;; esac
  cp "$file" "$corpus/case/$(tr / _ <<<"$file")"
done
cp materials/*.toml "$corpus/material/"
cp cases/point/*.toml "$corpus/point/"
cp tests/fuzz/csv/* "$corpus/csv/"
cp tests/fuzz/overrides/* "$corpus/overrides/"
cp tests/fuzz/openfoam/* "$corpus/openfoam/"
cp tests/fuzz/import/* "$corpus/import/"
# A mesh begins with the letter that names its format.
cp tests/fuzz/mesh/* "$corpus/mesh/"
{ printf m; cat tests/robustness/mutate/corpus/mesh.msh; } >"$corpus/mesh/msh"
{ printf a; cat tests/robustness/mutate/corpus/mesh.inp; } >"$corpus/mesh/inp"
# What a small run leaves.
run=$corpus/../run
"$program" run tests/robustness/mutate/corpus/two_blocks.toml -o "$run" >/dev/null 2>&1
for field in "$run"/fields/*.vtu; do
  cp "$field" "$corpus/vtk/"
  { printf v; cat "$field"; } >"$corpus/mesh/$(basename "$field")"
done
{
  cat "$run/case.toml"
  for file in summary.json history.csv; do printf '\n====\n'; cat "$run/$file"; done
  printf '\n====\n<VTKFile>\n<Collection>\n<DataSet timestep="0" part="0" file="a.vtu"/>\n</Collection></VTKFile>\n====\n'
  cat "$(ls "$run"/fields/fields_*.vtu | tail -1)"
} >"$corpus/report/two_blocks"
cp "$run/checkpoint/state.h5" "$corpus/checkpoint/"
