#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tests/device/run.sh SCENES [OUT]: measures what a graphics card relights and shades, beside the times that Jendersie, Kuri and Grosch
# (2016) print for a GTX 980 (Table 2 and Section 5.3.1), in about five minutes. SCENES holds sponza-crytek/Sponza.gltf. OUT, by default
# build/device, gets papers.html, papers.md, papers.csv and papers.json. Fails where the only Vulkan device is a program on the CPU,
# unless DEVICE names it; DEVICE is part of a device's name.
set -euo pipefail
scenes=$(realpath "${1:?folder of scenes}") out=$(realpath -m "${2:-build/device}")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
limn=${LIMN:-build/release/limn}
[ -x "$limn" ] || { echo "$limn is missing: build it first" >&2; exit 1; }
mkdir -p "$out"
picture=(cornell --technique ambient --width 16 --height 16 --spp 1 --gather-rays 0 --json -o "$out/device.png")
options=(--scenes "$scenes" -o "$out" --only T2,5.3.1 --runs 31)
[ -z "${DEVICE:-}" ] || { picture+=(--device "$DEVICE"); options+=(--device "$DEVICE"); }
device=$("$limn" render "${picture[@]}" 2>/dev/null | sed -n 's/.*"device":"\([^"]*\)","view".*/\1/p') || true
case $device in
'' | cpu) echo "there is no Vulkan device${DEVICE:+ whose name has \"$DEVICE\"}" >&2; exit 1 ;;
*llvmpipe*) [ -n "${DEVICE:-}" ] || { echo "the only device is a program on the CPU: $device" >&2; exit 1; } ;;
esac
# No reference is needed for times: the smallest one is quick.
"$limn" bench papers "${options[@]}" --width 32 --height 18 --spp 4
