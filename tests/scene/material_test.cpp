// SPDX-License-Identifier: MIT
#include "engine/scene/scene.h"

#include <limits>

#include <gtest/gtest.h>

namespace limn::material_test {
namespace {

TEST(Flipbook, FramesFollowEachOtherForEverAndBackwardsBeforeTheStart) {
    const Flipbook flipbook{3, 2, 4};
    EXPECT_EQ(frameAt(flipbook, 0), 0U);
    EXPECT_EQ(frameAt(flipbook, 0.24), 0U);
    EXPECT_EQ(frameAt(flipbook, 0.25), 1U);
    EXPECT_EQ(frameAt(flipbook, 1.25), 5U);
    EXPECT_EQ(frameAt(flipbook, 1.5), 0U);
    EXPECT_EQ(frameAt(flipbook, -0.01), 5U);
    EXPECT_EQ(frameAt(flipbook, 1e308 * 10), 0U);
    EXPECT_EQ(frameAt({3, 2, 0}, 99), 0U);
}

TEST(Flipbook, ShowsItsFramesFromTheUpperLeftAfterTheTexturesTransform) {
    Assets assets; // 3 x 2 frames of one texel each: 0, 40, 80, 120, 160, 200
    Image image{"flipbook", 3, 2, {}};
    for (int i = 0; i < 6; ++i)
        for (const int c : {40 * i, 40 * i, 40 * i, 255})
            image.rgba.push_back(std::uint8_t(c));
    assets.images.push_back(image);
    Material m;
    m.emissiveTexture = {.image = 0, .offset = {0.25f, 0}, .scale = {0.5f, 1}, .nearest = true};
    m.emissiveFlipbook = {3, 2, 10};
    EXPECT_TRUE(isAnimated(m));
    for (int i = 0; i < 12; ++i)
        for (const glm::vec2 uv : {glm::vec2(0.01f, 0.02f), glm::vec2(0.99f, 0.97f)}) {
            const glm::vec4 texel =
                sampleTexture(assets, emissiveTextureAt(m, (i + 0.5) / 10), uv, false);
            EXPECT_NEAR(texel.x * 255, float(40 * (i % 6)), 1e-3f) << i;
        }
    m.emissiveFlipbook = {};
    EXPECT_FALSE(isAnimated(m));
    EXPECT_EQ(emissiveTextureAt(m, 77), m.emissiveTexture);
}

TEST(ShowTime, ChangesTheMaterialsThatPlayAndSaysWhetherAnyDid) {
    Document document;
    addObject(document, Material{.name = "still"});
    addObject(document, Sky{});
    Material playing{.name = "playing"};
    playing.emissiveTexture.image = 3;
    playing.emissiveFlipbook = {2, 1, 1};
    addObject(document, playing);
    Scene scene = flatten(document, nullptr, 1.5);
    EXPECT_EQ(scene.materials[0].emissiveTexture, TextureRef{});
    EXPECT_EQ(scene.materials[1].emissiveTexture.offset, glm::vec2(0.5f, 0));
    EXPECT_FALSE(showTime(scene, document, 1.9));
    EXPECT_TRUE(showTime(scene, document, 2));
    EXPECT_EQ(scene.materials[1].emissiveTexture.offset, glm::vec2(0));
}

} // namespace
} // namespace limn::material_test
