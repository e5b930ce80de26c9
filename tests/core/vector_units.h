// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/vector_targets.h"

#include <cstdint>

#include <hwy/targets.h>

namespace limn {

/// Vector units for which kernels are compiled and that this machine has: one bit for each.
inline std::int64_t vectorUnitsHere() {
    return hwy::SupportedTargets() & HWY_TARGETS;
}

/// For as long as it lives, kernels run on that vector unit alone.
struct OnlyVectorUnit {
    explicit OnlyVectorUnit(std::int64_t unit) { use(unit); }
    ~OnlyVectorUnit() { use(0); }
    OnlyVectorUnit(const OnlyVectorUnit&) = delete;
    OnlyVectorUnit& operator=(const OnlyVectorUnit&) = delete;

private:
    static void use(std::int64_t unit) {
        hwy::SetSupportedTargetsForTest(unit);
        hwy::GetChosenTarget().DeInit();
    }
};

} // namespace limn
