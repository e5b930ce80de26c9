// SPDX-License-Identifier: MIT
#include "engine/trace/alpha_mask.h"

#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limn::alpha_mask_test {

using namespace simple;

namespace {

Image noiseImage(std::uint32_t width, std::uint32_t height, std::mt19937& random) {
    Image image{"noise", width, height, {}};
    for (std::uint32_t i = 0; i < 4 * width * height; ++i)
        image.rgba.push_back(std::uint8_t(random() >> 24));
    return image;
}

} // namespace

// surfaceAlpha() is what a material means; the mask is the same thing for tracing.
TEST(AlphaMask, AgreesWithTheMaterialForAllWrapsFiltersAndTransforms) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int variant = 0; variant < 200; ++variant) {
        SceneBuilder b;
        b.assets->images.push_back(
            noiseImage(1 + std::uint32_t(random() % 9), 1 + std::uint32_t(random() % 9), random));
        Material m = lambert(glm::vec3(1));
        m.alphaMode = variant % 5 == 0 ? AlphaMode::Blend : AlphaMode::Mask;
        m.alphaCutoff = uniform(random);
        m.baseColor.w = 0.5f + 0.5f * uniform(random);
        TextureRef& t = m.baseColorTexture;
        t.image = variant % 7 == 0 ? -1 : 0;
        t.texCoord = random() % 2;
        t.wrapU = Wrap(random() % 3);
        t.wrapV = Wrap(random() % 3);
        t.nearest = random() % 2 == 0;
        t.offset = {3 * uniform(random) - 1, 3 * uniform(random) - 1};
        t.scale = {4 * uniform(random) - 2, 4 * uniform(random) - 2};
        t.rotation = variant % 3 == 0 ? 6 * uniform(random) : 0;
        b.addMaterial(m);
        Mesh mesh = quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        mesh.uv1 = {{0.1f, 0.7f}, {2, -1}, {1, 1}, {-3, 0}};
        if (variant % 2 == 0)
            mesh.colors.assign(4, {1, 1, 1, 0.8f});
        if (variant % 11 == 0)
            mesh.uv0.clear();
        b.add(mesh);
        const Scene scene = b.build();
        AlphaImages images;
        const AlphaMask mask = makeAlphaMask(*scene.assets, scene.assets->meshes[0], m, images);
        int differ = 0;
        for (int i = 0; i < 200; ++i) {
            float u = uniform(random), v = uniform(random);
            if (u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            }
            const std::uint32_t triangle = random() % 2;
            differ += opaqueAt(mask, triangle, u, v) !=
                      (surfaceAlpha(scene, scene.instances[0], triangle, u, v) > 0);
        }
        // Points on the very edge of a texel or of the cutoff may round either way.
        EXPECT_LE(differ, 1) << "variant " << variant;
    }
}

TEST(AlphaMask, FarAndNonFiniteCoordinatesDoNotCrash) {
    std::mt19937 random(1);
    SceneBuilder b;
    b.assets->images.push_back(noiseImage(4, 4, random));
    Material m = lambert(glm::vec3(1));
    m.alphaMode = AlphaMode::Mask;
    m.baseColorTexture.image = 0;
    for (const float far : {1e30f, -1e30f, std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN()})
        for (const Wrap wrap : {Wrap::Repeat, Wrap::Clamp, Wrap::Mirror}) {
            m.baseColorTexture.wrapU = m.baseColorTexture.wrapV = wrap;
            Mesh mesh = quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
            mesh.uv0.assign(4, {far, far});
            AlphaImages images;
            const AlphaMask mask = makeAlphaMask(*b.assets, mesh, m, images);
            opaqueAt(mask, 0, 0.3f, 0.3f);
            opaqueAt(mask, 1, 0.5f, 0.1f);
        }
}

} // namespace limn::alpha_mask_test
