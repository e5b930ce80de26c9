// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/explain_illuminance.h"

#include "engine/math/sampling.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

namespace limn::explain_illuminance_test {
namespace {

/// A reading of one cache with random weights.
FieldReading readingOf(const Bake& bake, std::uint32_t cache, std::uint32_t bands) {
    FieldReading reading;
    reading.entries.push_back(
        {.grid = cache >= bake.caches.lightmapCount, .index = bake.caches.texel[cache]});
    std::uint32_t bits = cache;
    for (std::uint32_t i = 0; i < bands * bands; ++i)
        for (int k = 0; k < 3; ++k) {
            bits = mixBits(bits);
            reading.entries[0].weight[i][k] = unitFloat(bits);
        }
    return reading;
}

TEST(ExplainIlluminance, SplitsWhatAnyCacheHoldsThoseThatAreFilledIncluded) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        Scene scene = *litRoom(600, 600);
        scene.bake.storage = storage;
        scene.bake.grid = {5, 4, 6};
        scene.sky.radiance = {0.5f, 1, 2};
        const TraceScene trace(scene);
        const auto baked = std::make_shared<const Bake>(std::move(*bake(trace)));
        Relighter relighter(baked);
        relighter.lightUnreadGrid(true);
        relighter.relight(scene, trace, 1000);
        IndirectField magnitudes = relighter.field(); // of coefficients, which may cancel out
        for (auto* all : {&magnitudes.lightmap, &magnitudes.grid})
            for (glm::vec4& c : *all)
                c = glm::abs(c);
        const Caches& caches = baked->caches;
        std::size_t filled[2] = {};
        for (std::uint32_t c = 0; c < caches.size(); ++c) {
            const bool invalid = caches.fillBegin[c] != caches.fillBegin[c + 1];
            if (!invalid && c % 20 != 0)
                continue;
            filled[c >= caches.lightmapCount] += invalid;
            const FieldReading reading = readingOf(*baked, c, relighter.field().bands);
            const glm::vec3 held = valueOf(reading, relighter.field()),
                            most = valueOf(reading, magnitudes);
            const Explanation e = explainIlluminance(relighter, scene, reading, {});
            for (int k = 0; k < 3; ++k) {
                EXPECT_NEAR(totalOf(e.byOrigin)[k], held[k], 1e-3 * most[k]) << c;
                EXPECT_NEAR(totalOf(e.bySender)[k], held[k], 1e-3 * most[k]) << c;
            }
        }
        EXPECT_GT(filled[0], 0U) << "of the lightmap";
        EXPECT_GT(filled[1], 0U) << "of the grid";
    }
}

} // namespace
} // namespace limn::explain_illuminance_test
