#!/usr/bin/env bash
# What the client is built from, as one number: it stands in built/client.mjs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
cat src/client.mjs build.mjs package.json package-lock.json | sha256sum | cut -c 1-32
