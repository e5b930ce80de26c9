// SPDX-License-Identifier: MIT
#include "engine/shading/emitters.h"

#include "engine/shading/sampler.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limn::emitters_test {

using namespace simple;

static std::uint32_t addTwoTexelImage(SceneBuilder& b) {
    b.assets->images.push_back({"half", 2, 1, {255, 255, 255, 255, 0, 0, 0, 255}});
    return std::uint32_t(b.assets->images.size() - 1);
}

TEST(Emitters, ChancesFollowThePowerThatTrianglesSendOut) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1)));
    Material half = lambert(glm::vec3(0.5f), glm::vec3(2));
    half.doubleSided = true;
    half.emissiveTexture.image = int(addTwoTexelImage(b));
    half.emissiveTexture.nearest = true;
    b.addMaterial(half);
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0), glm::scale(glm::mat4(1), glm::vec3(2, 3, 1)));
    b.add(quad({0, 0, 5}, {1, 0, 0}, {0, 1, 0}, 1));
    b.add(quad({0, 0, 9}, {1, 0, 0}, {0, 1, 0}, 2));
    const TraceScene trace(b.build());
    const Emitters emitters = findEmitters(trace);
    // Triangles of area 3, radiance 1; and of area 1/2, mean radiance 3/4 * 0 + 1/4 * 2 or the
    // reverse, two-sided. The lattice of 64 points is within 1/32 of the means.
    ASSERT_EQ(emitters.triangles.size(), 4u);
    EXPECT_FLOAT_EQ(emitters.triangles[0].area, 3);
    EXPECT_NEAR(emitters.cdf[1], 6 / 8.0, 0.01);
    EXPECT_NEAR((emitters.cdf[2] - emitters.cdf[1]) / (1 - emitters.cdf[1]), 0.25, 0.04);
    EXPECT_DOUBLE_EQ(emitters.cdf[3], 1);
}

// The mean of 1 / pdf over samples is the solid angle that is sampled.
TEST(Emitters, InversePdfAveragesToTheSolidAngle) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1)));
    b.add(quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2})); // faces down, a side of the cube about 0
    const TraceScene trace(b.build());
    const Emitters emitters = findEmitters(trace);
    double solidAngle = 0;
    constexpr std::uint32_t n = 1 << 14;
    for (std::uint32_t i = 0; i < n; ++i) {
        const Sampler sampler{3, i};
        const EmitterSample s = sampleEmitter(emitters, trace.scene(), glm::vec3(0),
                                              sampler.pair(0).x, sampler.pair(1));
        ASSERT_EQ(s.radiance, glm::vec3(1));
        solidAngle += 1 / double(s.pdf) / n;
        const Hit hit = trace.closestHit({glm::vec3(0), glm::normalize(s.position)});
        ASSERT_TRUE(bool(hit));
        EXPECT_NEAR(emitterPdf(emitters, hit, glm::vec3(0)) / s.pdf, 1, 1e-4f);
    }
    EXPECT_NEAR(solidAngle, 4 * glm::pi<double>() / 6, 2e-3);
}

TEST(Emitters, TheBackOfAOneSidedEmitterIsDark) {
    for (bool doubleSided : {false, true}) {
        SceneBuilder b;
        Material m = lambert(glm::vec3(0.5f), glm::vec3(1));
        m.doubleSided = doubleSided;
        b.addMaterial(m);
        // Mirrored: its front still looks along the mirrored normal, up.
        b.add(quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1)));
        const TraceScene trace(b.build());
        const Emitters emitters = findEmitters(trace);
        const auto radianceAt = [&](float y) {
            return sampleEmitter(emitters, trace.scene(), {-0.2f, y, 0.3f}, 0.3f, {0.4f, 0.5f})
                .radiance.x;
        };
        EXPECT_EQ(radianceAt(1), 1);
        EXPECT_EQ(radianceAt(-1), doubleSided ? 1 : 0);
    }
}

TEST(Emitters, AlphaMaskedTexelsEmitNothing) {
    SceneBuilder b;
    b.assets->images.push_back({"mask", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    Material m = lambert(glm::vec3(0.5f), glm::vec3(1));
    m.alphaMode = AlphaMode::Mask;
    m.baseColorTexture.image = 0;
    m.baseColorTexture.nearest = true;
    b.addMaterial(m);
    b.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    const TraceScene trace(b.build());
    const Emitters emitters = findEmitters(trace);
    for (std::uint32_t i = 0; i < 256; ++i) {
        const Sampler sampler{3, i};
        const EmitterSample s = sampleEmitter(emitters, trace.scene(), {0.5f, 0.5f, 1},
                                              sampler.pair(0).x, sampler.pair(1));
        EXPECT_EQ(s.radiance.x, s.position.x < 0.5f ? 1 : 0);
    }
}

} // namespace limn::emitters_test
