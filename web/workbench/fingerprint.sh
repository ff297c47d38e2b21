#!/usr/bin/env bash
# What the workbench is built from, as one number: it stands in python/solidus_casting/workbench/page.html.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
# Of the report's viewer the modules that the workbench takes over.
shared=(camera.ts colours.ts dom.ts geometry.ts painter.ts style.css unpack.ts)
cat $(ls src/* | LC_ALL=C sort) "${shared[@]/#/../report/src/}" build.mjs ../report/package.json ../report/package-lock.json ../../LICENSE | sha256sum | cut -c 1-32
