#!/usr/bin/env bash
# `solidus mcp` and the client of npm's SDK: run.sh PROGRAM FOLDER. Exit code 77: skipped, with its reason.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
program=$1 folder=$2

sources=$(tests/mcp/fingerprint.sh)
grep -q "sources $sources" tests/mcp/built/client.mjs ||
  { echo "tests/mcp/built/client.mjs was not built from the files next to it: run ./dev mcp-client"; exit 1; }
command -v node >/dev/null || { echo "skipped: node is not installed (./dev test installs it)"; exit 77; }
options=()
PYTHONPATH=python /usr/bin/python3 -c 'import sys; from solidus_casting.mcp import landlock; sys.exit(landlock.version() == 0)' ||
  options=(--trust-files)
exec node tests/mcp/client_test.mjs "$program" "$folder" "${options[@]}"
