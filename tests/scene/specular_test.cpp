// SPDX-License-Identifier: MIT
#include "engine/scene/specular.h"

#include "engine/math/sampling.h"
#include "engine/scene/receiver_bands.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limn {
namespace {

const glm::vec3 kUp(0, 1, 0);

glm::vec3 atElevation(float sine) {
    return {std::sqrt(1 - sine * sine), sine, 0};
}

/// Integral of the BRDF times the light's cosine over the hemisphere.
glm::vec3 reflectedShare(const Gloss& gloss, float NoV) {
    const DirectionSet set(200000, true, 5);
    glm::vec3 sum(0);
    for (unsigned i = 0; i < set.count; ++i)
        if (const glm::vec3 d = set[i]; d.y > 0)
            sum += specularBrdf(gloss, kUp, atElevation(NoV), d) * (d.y * set.solidAngle());
    return sum;
}

Material dielectric(float roughness) {
    Material m;
    m.roughness = roughness;
    return m;
}

Material metal(float roughness) {
    Material m = dielectric(roughness);
    m.metallic = 1;
    return m;
}

} // namespace

TEST(Specular, IsReciprocal) {
    const Gloss gloss{{0.9f, 0.5f, 0.1f}, 0.4f};
    const glm::vec3 a = glm::normalize(glm::vec3(1, 0.5f, 0.2f)),
                    b = glm::normalize(glm::vec3(-0.3f, 1, 0.8f));
    EXPECT_LT(glm::length(specularBrdf(gloss, kUp, a, b) - specularBrdf(gloss, kUp, b, a)), 1e-5f);
}

TEST(Specular, WhiteMetalReflectsNoMoreThanArrives) {
    for (const float NoV : {0.3f, 0.6f, 1.f}) {
        EXPECT_NEAR(specularAlbedo({glm::vec3(1), 0}, NoV).x, 1, 1e-6f);
        for (const float roughness : {0.3f, 0.5f, 0.75f, 1.f}) {
            EXPECT_LE(specularAlbedo({glm::vec3(1), roughness}, NoV).x, 1);
            EXPECT_LE(reflectedShare({glm::vec3(1), roughness}, NoV).x, 1.01f);
        }
    }
}

TEST(Specular, APolishedWhiteMetalReflectsAlmostAllStraightBack) {
    EXPECT_NEAR(reflectedShare({glm::vec3(1), 0.3f}, 1).x, 1, 0.03f);
}

TEST(Specular, ADielectricReflectsLessTheMoreItFacesTheEye) {
    EXPECT_NEAR(specularAlbedo({glm::vec3(0.04f), 0}, 1).x, 0.04f, 0.01f) << "F0 itself";
    // Fresnel's reflectance at 72.5 degrees is 0.2; Schlick's of the same, 0.04 + 0.96 (1 - 0.3)^5.
    EXPECT_NEAR(specularAlbedo({glm::vec3(0.04f), 0}, 0.3f).x, 0.2f, 0.03f);
}

TEST(ReceiverBands, PlainSurfacesNeedThree) {
    const Assets none;
    for (const float roughness : {0.5f, 0.7f, 1.f})
        EXPECT_EQ(receiverBands(none, dielectric(roughness), 8), 3) << roughness;
    EXPECT_EQ(receiverBands(none, metal(1), 8), 3);
    EXPECT_EQ(receiverBands(none, metal(1), 2), 2) << "there are no more";
}

TEST(ReceiverBands, GrowWithPolishAndReflectance) {
    const Assets none;
    // n = 5: s_3 ... s_5 are 0.381, 0.1875, 0.069, so three bands lose 0.086 of what the lobe
    // reflects, which is 0.6 of all, and four 0.032.
    EXPECT_EQ(receiverBands(none, metal(0.731f), 8), 4);
    EXPECT_EQ(receiverBands(none, metal(0.5f), 8), 8);
    EXPECT_EQ(receiverBands(none, metal(0.5f), 6), 6) << "there are no more";
    Material grey = metal(0.731f);
    grey.baseColor = {0.45f, 0.45f, 0.45f,
                      1}; // of 0.27, 0.086 are 0.023: a little more than may be
    EXPECT_EQ(receiverBands(none, grey, 8), 4);
    Material dark = metal(0.731f);
    dark.baseColor = {0.1f, 0.05f, 0, 1};
    EXPECT_EQ(receiverBands(none, dark, 8), 3);
    // A polished floor reflects 7 % of the light round it.
    EXPECT_GT(receiverBands(none, dielectric(0.25f), 8), 3);
}

TEST(ReceiverBands, LookAtTheTextureButForOddTexels) {
    Assets assets;
    assets.images.push_back({"rough", 32, 32, {}});
    std::vector<std::uint8_t>& rgba = assets.images[0].rgba;
    for (int i = 0; i < 32 * 32; ++i)
        rgba.insert(rgba.end(), {255, 255, 255, 255}); // rough metal
    Material m = metal(1);
    m.metallicRoughnessTexture.image = 0;
    const auto polish = [&](int row, int columns) -> const Assets& {
        for (int x = 0; x < columns; ++x)
            rgba[std::size_t(row * 32 + x) * 4 + 1] = 64;
        return assets;
    };
    EXPECT_EQ(receiverBands(polish(0, 0), m, 8), 3);
    polish(0, 2);
    EXPECT_EQ(receiverBands(polish(1, 2), m, 8), 3) << "two texels of 1024 are less than 1 %";
    for (int y = 0; y < 16; ++y)
        polish(y, 32);
    EXPECT_EQ(receiverBands(assets, m, 8), 8);
    m.metallic = 0;
    EXPECT_EQ(receiverBands(assets, m, 8), 4) << "as a floor of that polish";
}

TEST(ReceiverBands, OfASceneAreThoseOfWhatIsInIt) {
    simple::SceneBuilder b;
    b.addMaterial(dielectric(1));
    b.addMaterial(metal(0.731f));
    b.add(simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    Scene scene = b.build();
    EXPECT_EQ(receiverBands(scene, 8), 3) << "nothing is made of the metal";
    scene.instances[0].material = 1;
    EXPECT_EQ(receiverBands(scene, 8), 4);
}

} // namespace limn
