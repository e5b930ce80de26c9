#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tests/export/check.sh [--scenes]: installs the consumers of exported light, shows each what the exporters write, and compares its
# pixels with the truth; with --scenes also whole scenes, beside pictures of `limn render`, and the live page. Prints tables; 1 if anything failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

.ci/install build export
# Debian's npm and another nodejs exclude each other: any that is there will do.
command -v npm >/dev/null || .ci/install node
(cd tests/export && npm install --ignore-scripts --no-audit --no-fund --silent)
.ci/build release write_known_light
out=$PWD/build/export
rm -rf "$out/known" "$out/failed"
build/release/write_known_light "$out/known"

failed=0
node tests/export/run.mjs "$out" || failed=1
if command -v blender >/dev/null; then
    log=$out/blender.log
    blender -b -noaudio --python tests/export/blender.py -- "$out/known" >"$log" 2>&1 || failed=1
    grep '^| Blender' "$log" || { tail -20 "$log"; failed=1; }
else
    echo "Blender is not installed: its row is missing (apt-get install blender)"
fi
node tests/export/validate.mjs "$out"/known/probe-0/*.gltf || failed=1
if [ "${1:-}" = --scenes ]; then
    .ci/build release limn
    node tests/export/scenes.mjs "$out" || failed=1
    .ci/install web
    .ci/wasm build/web
    node tests/export/live.mjs "$out" || failed=1
fi
exit $failed
