// SPDX-License-Identifier: MIT
#include "engine/math/packing.h"
#include "engine/scene/scene.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <random>

namespace limn::texture_test {
namespace {

using namespace simple;

Image imageOf(std::uint32_t width, std::uint32_t height) {
    return {"image", width, height, std::vector<std::uint8_t>(std::size_t(width) * height * 4)};
}

void setTexel(Image& image, std::uint32_t x, std::uint32_t y, glm::u8vec4 rgba) {
    for (std::uint32_t c = 0; c < 4; ++c)
        image.rgba[(std::size_t(y) * image.width + x) * 4 + c] = rgba[int(c)];
}

/// Squares of one texel, black and white.
Image checker(std::uint32_t size) {
    Image image = imageOf(size, size);
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
            const std::uint8_t grey = (x + y) % 2 ? 255 : 0;
            setTexel(image, x, y, {grey, grey, grey, 255});
        }
    return image;
}

/// A square of 2 m x 2 m, its texture once over it.
Scene texturedSquare(const Image& image, const Material& material) {
    SceneBuilder b;
    b.assets->images.push_back(image);
    b.addMaterial(material);
    b.add(quad(glm::vec3(0), {1, 0, 0}, {0, 1, 0}), glm::mat4(glm::mat3(2)));
    return b.build();
}

Material white() {
    Material m = lambert(glm::vec3(1));
    m.baseColorTexture.image = 0;
    return m;
}

/// Albedo over `area` round the texel (x, y)'s centre, in the lower triangle: x > y.
SurfaceMaterial over(const Scene& scene, float x, float y, float area) {
    const float size = float(scene.assets->images[0].width);
    const glm::vec2 uv = glm::vec2(x + 0.5f, y + 0.5f) / size;
    // Corners at uv (0, 0), (1, 0), (1, 1).
    return surfaceMaterialOver(scene, scene.instances[0], 0, uv.x - uv.y, uv.y, area);
}

TEST(Footprint, LargeOnesSeeTheMeanOfACheckerAndTinyOnesASquare) {
    const Scene scene = texturedSquare(checker(256), white());
    const float texel = 4.f / (256 * 256); // [m^2]
    for (const float texels : {4.f, 9.f, 100.f, 1e4f, 65536.f, 1e9f})
        EXPECT_NEAR(over(scene, 100, 31, texels * texel).albedo.x, 0.5, 1e-3) << texels;
    for (const float texels : {1.f, 0.1f, 1e-9f, 0.f}) {
        EXPECT_NEAR(over(scene, 100, 31, texels * texel).albedo.x, 0.99, 1e-4) << texels;
        EXPECT_NEAR(over(scene, 100, 30, texels * texel).albedo.x, 0, 1e-4) << texels;
    }
    // Between one texel and four it passes from one to the other.
    EXPECT_NEAR(over(scene, 100, 31, 2 * texel).albedo.x, 0.75, 1e-3);
}

TEST(Footprint, SeesTheMeanOfItsOwnAreaNotOfMore) {
    std::mt19937 rng(1);
    Image image = imageOf(64, 64);
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) {
            const auto grey = std::uint8_t(rng() % 256);
            setTexel(image, x, y, {grey, grey, grey, 255});
        }
    Assets assets;
    assets.images.push_back(image);
    TextureRef texture;
    texture.image = 0;
    texture.scale = {2, 2}; // a quarter of the uv area covers the same texels
    double mean = 0;
    for (std::uint32_t y = 8; y < 16; ++y)
        for (std::uint32_t x = 24; x < 32; ++x)
            mean += image.rgba[(y * 64 + x) * 4] / 255.0 / 64;
    const glm::vec2 middle = glm::vec2(28, 12) / 64.f / 2.f;
    EXPECT_NEAR(sampleTextureFootprint(assets, texture, middle, 64 / 4096.f / 4, TexelKind::Data).x,
                mean, 1e-3);
}

TEST(Footprint, EmissionAndMetalAreMeansToo) {
    Image image = checker(64);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        image.rgba[i] = 255; // red everywhere
    Material m = lambert(glm::vec3(0.8f), glm::vec3(10));
    m.emissiveTexture.image = 0;
    m.metallic = 1;
    m.metallicRoughnessTexture.image = 0; // metal in blue
    const SurfaceMaterial s = over(texturedSquare(image, m), 20, 3, 1);
    EXPECT_NEAR(s.emission.x, 10, 1e-2);
    EXPECT_NEAR(s.emission.y, 5, 1e-2);
    EXPECT_NEAR(s.albedo.x, 0.4, 1e-3);
}

TEST(Footprint, HolesHaveNoColour) {
    Image image = imageOf(32, 32);
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x) // a red leaf, green where it is cut away
            (x + y) % 4 ? setTexel(image, x, y, {0, 255, 0, 0})
                        : setTexel(image, x, y, {255, 0, 0, 255});
    Material m = white();
    m.alphaMode = AlphaMode::Mask;
    const glm::vec3 leaf = over(texturedSquare(image, m), 20, 3, 1).albedo;
    EXPECT_NEAR(leaf.x, 0.99, 1e-3);
    EXPECT_NEAR(leaf.y, 0, 1e-3);
    m.alphaMode = AlphaMode::Opaque; // then alpha says nothing
    EXPECT_NEAR(over(texturedSquare(image, m), 20, 3, 1).albedo.y, 0.75, 1e-3);
}

TEST(Mips, KeepTheMeanAtAnySize) {
    std::mt19937 rng(2);
    for (const glm::uvec2 size : {glm::uvec2(64, 64), glm::uvec2(7, 5), glm::uvec2(1, 13),
                                  glm::uvec2(100, 3), glm::uvec2(31, 257)}) {
        Image image = imageOf(size.x, size.y);
        double mean = 0;
        for (std::uint8_t& b : image.rgba)
            b = std::uint8_t(rng() % 256);
        for (std::size_t i = 0; i < image.rgba.size(); i += 4)
            mean += image.rgba[i] / 255.0;
        mean /= double(image.rgba.size() / 4);
        const MipChain chain = buildMips(image, TexelKind::Data);
        ASSERT_FALSE(chain.levels.empty());
        for (const MipChain::Level& level : chain.levels) {
            double sum = 0;
            for (const auto& t : level.rgba)
                sum += halfToFloat(t[0]);
            EXPECT_NEAR(sum / double(level.rgba.size()), mean, 1e-3);
        }
        EXPECT_EQ(chain.levels.back().rgba.size(), 1U);
    }
}

TEST(Mips, AreMadeOnceAndTakeTwoThirdsOfTheImage) {
    Assets assets;
    assets.images.push_back(checker(256));
    EXPECT_EQ(assets.mips.bytes(), 0U);
    const MipChain* first = &assets.mips.of(assets.images, 0, TexelKind::Color);
    EXPECT_EQ(&assets.mips.of(assets.images, 0, TexelKind::Color), first);
    EXPECT_EQ(assets.mips.bytes(), (256 * 256 - 1) / 3 * 8);
    const Assets copy = assets;
    EXPECT_EQ(copy.mips.bytes(), 0U);
}

TEST(Mips, OfAnImageWithoutTexelsOrOfOneAreNone) {
    EXPECT_TRUE(buildMips({}, TexelKind::Color).levels.empty());
    Assets assets;
    assets.images.push_back(checker(1));
    TextureRef texture;
    texture.image = 0;
    EXPECT_EQ(sampleTextureFootprint(assets, texture, {0.5f, 0.5f}, 100, TexelKind::Color).x, 0);
    EXPECT_EQ(sampleTextureFootprint(assets, {}, {0, 0}, 1, TexelKind::Color), glm::vec4(1));
}

} // namespace
} // namespace limn::texture_test
