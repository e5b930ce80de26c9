#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# without_vulkan.sh PROGRAM: checks the program that is linked without Vulkan. Prints what is wrong and exits with 1.
set -euo pipefail

program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
wrong() {
    echo "$1"
    exit 1
}

picture=$folder/cornell.exr
"$program" render cornell -o "$picture" --view direct --width 16 --height 16 --spp 1 2>"$folder/log" || wrong "draws nothing"
grep -q 'built without Vulkan' "$folder/log" || wrong "does not say why it draws on the CPU"
[ -s "$picture" ] || wrong "writes no picture"

status=0
"$program" render cornell -o "$picture" --device llvmpipe >"$folder/log" 2>&1 || status=$?
[ "$status" -eq 1 ] || wrong "a device that is asked for by name: status $status"
grep -q 'there is: cpu' "$folder/log" || wrong "does not say which devices there are"

status=0
"$program" edit >"$folder/log" 2>&1 || status=$?
[ "$status" -eq 2 ] || wrong "the editor, which needs a window: status $status"

# Nothing of the rooms that know Vulkan was linked.
nm -C "$program" >"$folder/symbols"
! grep -m 1 ' [TtWw] limn::gpu::' "$folder/symbols" || wrong "holds code of engine/gpu"
