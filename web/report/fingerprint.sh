#!/usr/bin/env bash
# What the viewer is built from, as one number: it stands in built/viewer.html.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
cat $(find src -type f | LC_ALL=C sort) build.mjs package.json package-lock.json ../../LICENSE | sha256sum | cut -c 1-32
