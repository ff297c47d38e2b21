#!/usr/bin/env bash
# The workbench in a real browser: run.sh PROGRAM FOLDER [TEST]. Exit code 77: skipped, with its reason.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
program=$1 folder=$2 test=${3:-workbench_test}

# The page that is served is that of the sources. (`./dev viewer` builds it; `./dev viewer --check` compares byte by byte.)
page=python/solidus_casting/workbench/page.html
grep -q "sources $(web/workbench/fingerprint.sh)" "$page" ||
  { echo "$page was not built from the sources in web/workbench: run ./dev viewer"; exit 1; }
command -v node >/dev/null || { echo "skipped: node is not installed (./dev test installs it)"; exit 77; }
[[ -x /usr/bin/chromium || -x /usr/bin/chromium-browser || -x /usr/bin/google-chrome ]] ||
  { echo "skipped: chromium is not installed (./dev test installs it)"; exit 77; }
/usr/bin/python3 -c "import numpy" 2>/dev/null || { echo "skipped: Python has no numpy"; exit 77; }
exec node "tests/workbench/$test.mjs" "$program" "$folder"
