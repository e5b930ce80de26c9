#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tests/journeys/check.sh [FILTER]: uses the editor's window as a person would, by mouse and keys on a screen without a monitor,
# and leaves pictures of the screen in build/journeys; before that, 20 soaks of random events, and ten
# minutes of switching techniques, on the CPU and on the device.
# FILTER is GoogleTest's; with one, there are no soaks. 1 if anything failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

.ci/install build test
.ci/build release limn journeys editor_ui_undo_law_test editor_ui_technique_soak_test app_device_soak_test
if [ $# -eq 0 ]; then
    for soak in editor_ui_undo_law editor_ui_technique_soak app_device_soak; do
        "build/release/${soak}_test" --gtest_also_run_disabled_tests --gtest_filter='*DISABLED*' --gtest_brief
    done
fi
build/release/journeys --gtest_filter="${1:-*}"
echo "Pictures: build/journeys"
