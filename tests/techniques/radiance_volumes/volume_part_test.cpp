// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/volume_part.h"

#include "engine/field/field_reading.h"
#include "engine/lightmap/atlas.h"
#include "engine/scene/scene.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace limn::volume_part_test {
namespace {

const glm::vec3 kUp(0, 0, 1);

/// Harmonics of far small lights of perpendicular irradiance 1: a red and a green one.
std::vector<glm::vec3> harmonicsOf(glm::vec3 towardsRed, glm::vec3 towardsGreen) {
    float red[4], green[4];
    shBasis(2, towardsRed, red);
    shBasis(2, towardsGreen, green);
    std::vector<glm::vec3> c;
    for (int i = 0; i < 4; ++i)
        c.emplace_back(red[i], green[i], 0);
    return c;
}

/// Eight caches at the corners of a cube of side 1. Those of x = 0 see red light from below and
/// green light from above, the others see both from the other side.
std::shared_ptr<VolumePart> cube(bool clamped) {
    auto caches = std::make_shared<CacheAllocation>();
    caches->grids.grids = {{.decision = {glm::vec3(0), glm::vec3(1)}}};
    auto part = std::make_shared<VolumePart>();
    part->clamped = clamped;
    for (std::uint32_t k = 0; k < 8; ++k) {
        caches->address.push_back(k);
        caches->places.push_back({.position = glm::vec3(cellCorner(glm::uvec3(0), k))});
        for (const glm::vec3 c : k % 2 == 0 ? harmonicsOf(-kUp, kUp) : harmonicsOf(kUp, -kUp))
            part->light.harmonics.push_back(c);
    }
    part->caches = caches;
    return part;
}

// Two bands hold 1/4 + 1/2 cos of the perpendicular irradiance: 3/4 of a light above a surface, and
// -1/4 of one below it. At x = t, the mean of both is t - 1/4 of red and 3/4 - t of green; clamped
// at each cache it is 3/4 t and 3/4 (1 - t).
TEST(VolumePart, ClampsTheMeanOrEachCache) {
    for (const bool clamped : {false, true}) {
        IndirectField field;
        field.bands = 2;
        field.parts = {cube(clamped)};
        const Scene scene;
        const LightmapLayout layout;
        for (const float t : {0.1f, 0.5f, 0.8f}) {
            const FieldPoint point{field, layout, scene, 0, 0, 0.3f, 0.3f, {t, 0.4f, 0.3f}, kUp};
            const glm::vec3 truth =
                clamped ? 0.75f * glm::vec3(t, 1 - t, 0)
                        : glm::max(glm::vec3(t - 0.25f, 0.75f - t, 0), glm::vec3(0));
            FieldReading reading;
            addIrradiance(point, {1, 2, 3}, reading);
            const glm::vec3 read = valueOf(reading, field), e = sampleIrradiance(point);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(e[c], truth[c], 1e-6f) << t << ' ' << clamped;
                EXPECT_NEAR(read[c], float(1 + c) * truth[c], 3e-6f) << t << ' ' << clamped;
            }
        }
        EXPECT_EQ(cube(clamped)->equals(*cube(true)), clamped);
    }
}

} // namespace
} // namespace limn::volume_part_test
