#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# tests/journeys/check.sh [FILTER]: uses the editor's window as a person would, by mouse and keys on a screen without a monitor,
# and leaves pictures of the screen in build/journeys; before that, 20 soaks of random events, and ten
# minutes of switching techniques, on the CPU and on the device.
# FILTER is GoogleTest's; with one, there are no soaks. 1 if anything failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

.ci/install build test
.ci/build release limn journeys editor_ui_tests app_tests
if [ $# -eq 0 ]; then
    for program in editor_ui_tests app_tests; do
        "build/release/$program" --gtest_also_run_disabled_tests --gtest_filter='*.DISABLED_*' --gtest_brief
    done
fi
build/release/journeys --gtest_filter="${1:-*}"
echo "Pictures: build/journeys"
