#!/usr/bin/env bash
# The page of `solidus report` in a real browser: run.sh PROGRAM FOLDER. Exit code 77: skipped, with its reason.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
program=$1 folder=$2

# The viewer in the program is that of the sources. (`./dev viewer` builds it; `./dev viewer --check` compares byte by byte.)
sources=$(web/report/fingerprint.sh)
grep -q "sources $sources" web/report/built/viewer.html ||
  { echo "web/report/built/viewer.html was not built from the sources next to it: run ./dev viewer"; exit 1; }

# It is in every page: packed it takes 0.29 MB, as it is 0.7.
(($(stat -c %s web/report/built/viewer.html) < 350000)) ||
  { echo "web/report/built/viewer.html takes $(stat -c %s web/report/built/viewer.html) bytes of every page, more than 350000"; exit 1; }

command -v node >/dev/null || { echo "skipped: node is not installed (./dev test installs it)"; exit 77; }
[[ -x /usr/bin/chromium || -x /usr/bin/chromium-browser || -x /usr/bin/google-chrome ]] ||
  { echo "skipped: chromium is not installed (./dev test installs it)"; exit 77; }
exec node tests/report/report_test.mjs "$program" "$folder"
