// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/caches/cache_runs.h"

#include <gtest/gtest.h>

namespace limn {

/// Caches of `which` whose texels differ, bit by bit.
inline std::size_t differing(const Bake& bake, const IndirectField& a, const IndirectField& b,
                             const CacheFlags& which) {
    EXPECT_EQ(a.lightmap.size(), b.lightmap.size());
    const std::size_t texels = std::size_t(a.lightmapWidth) * a.lightmapHeight;
    std::size_t count = 0;
    for (std::size_t c = 0; c < which.size(); ++c)
        for (std::size_t i = 0; which[c] != 0 && i < a.coefficients(); ++i) {
            const std::size_t at = i * texels + bake.caches.texel[c];
            if (a.lightmap[at] == b.lightmap[at])
                continue;
            ++count;
            break;
        }
    return count;
}

} // namespace limn
