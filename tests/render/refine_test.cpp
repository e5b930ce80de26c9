// SPDX-License-Identifier: MIT
// Pictures that Viewport::refine() makes the mean of several samples of each pixel.
#include "engine/render/passes/camera_view.h"
#include "tests/render/viewport_fixture.h"

#include <algorithm>
#include <set>

namespace limn::refine_test {
namespace {

/// A viewport that looks down on the plane y = 0.
class Refined : public ViewportTest {
protected:
    /// Width of a pixel on the plane [m].
    float pixelWidth() const {
        return 2 * options.camera.eye.y * std::tan(options.camera.fovY / 2) / float(options.height);
    }

    ImageF refined(const Scene& scene, View view, std::uint32_t samples) {
        draw(scene, view);
        for (std::uint32_t n = 2; n <= samples; ++n)
            EXPECT_EQ(viewport->refine(), n);
        return viewport->readLinear();
    }
};

constexpr float kAlbedo = 0.5f;

/// A grey sheet whose edges to the right and towards the bottom of the picture lie `covered` of a
/// pixel beyond its middle.
Scene sheet(glm::vec2 covered, float pixelWidth) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(kAlbedo)));
    const glm::vec2 edge = covered * pixelWidth;
    b.add(simple::quad({edge.x - 9, 0, edge.y}, {9, 0, 0}, {0, 0, -9}));
    return b.build();
}

TEST_F(Refined, AnEdgeCoversItsShareOfAPixel) {
    for (const glm::vec2 covered : {glm::vec2(0.1f, 0.9f), glm::vec2(0.37f, 0.5f)}) {
        const Scene scene = sheet(covered, pixelWidth());
        for (const auto& [samples, tolerance] : {std::pair(16u, 0.065f), std::pair(64u, 0.017f)}) {
            const ImageF image = refined(scene, View::Albedo, samples);
            EXPECT_NEAR(pixel(image, 16, 4).x / kAlbedo, covered.x, tolerance) << samples;
            EXPECT_NEAR(pixel(image, 4, 16).x / kAlbedo, covered.y, tolerance) << samples;
            EXPECT_NEAR(pixel(image, 16, 16).x / kAlbedo, covered.x * covered.y, 2 * tolerance)
                << samples;
            EXPECT_NEAR(pixel(image, 15, 15).x, kAlbedo, 1e-6f);
            EXPECT_EQ(pixel(image, 17, 4).x, 0);
            EXPECT_EQ(pixel(image, 4, 17).x, 0);
        }
    }
}

// The light is nearer to the plane than two pixels are wide. Its mean over a pixel is far below
// that in the middle, and farther for samples whose points and surfaces do not belong together.
TEST_F(Refined, ShadesWhereEachSampleSees) {
    constexpr float kHeight = 0.15f, kCandela = 0.1f;
    Scene scene = plane(glm::vec3(1)).build();
    const glm::vec3 middle = planePoint(options, 16, 16);
    scene.lights = {{.position = middle + glm::vec3(0, kHeight, 0), .strength = kCandela}};
    const auto radiance = [&](glm::vec2 from) {
        return kCandela * kHeight /
               (kPi * std::pow(glm::dot(from, from) + kHeight * kHeight, 1.5f));
    };
    constexpr int kSteps = 64;
    float mean = 0;
    for (int y = 0; y < kSteps; ++y)
        for (int x = 0; x < kSteps; ++x)
            mean +=
                radiance((glm::vec2(x, y) + 0.5f - kSteps / 2.f) * pixelWidth() / float(kSteps));
    mean /= float(kSteps * kSteps);
    ASSERT_LT(mean, 0.9f * radiance({0, 0})) << "the test would not see a fault";
    expectNear(pixel(draw(scene, View::Lit), 16, 16), glm::vec3(radiance({0, 0})), 0.01f, "middle");
    expectNear(pixel(refined(scene, View::Lit, 64), 16, 16), glm::vec3(mean), 0.01f, "mean");
}

TEST_F(Refined, RenderingBeginsAnew) {
    const Scene scene = sheet({0.3f, 0.6f}, pixelWidth());
    const ImageF first = draw(scene, View::Albedo);
    const std::uint64_t drawn = viewport->stats().geometryDrawn;
    const ImageF mean = refined(scene, View::Albedo, 5);
    EXPECT_EQ(viewport->stats().geometryDrawn, drawn + 4) << "one for each new sample";
    EXPECT_NE(mean.rgb, first.rgb);
    EXPECT_EQ(draw(scene, View::Albedo).rgb, first.rgb);
    options.width = options.height = 300; // larger images
    const ImageF large = draw(scene, View::Albedo);
    viewport->refine();
    EXPECT_EQ(viewport->readLinear().width, 300u);
    EXPECT_EQ(draw(scene, View::Albedo).rgb, large.rgb);
    EXPECT_TRUE(device->validationMessages().empty());
}

TEST_F(Refined, TheToneMappedPictureAndTheMeteredOneAreOfTheMean) {
    const Scene scene = sheet({0.5f, 0.5f}, pixelWidth());
    options.tonemap = Tonemap::None;
    const auto grey = [&] { return int(viewport->readTonemapped().rgba[(4 * 32 + 16) * 4]); };
    draw(scene, View::Albedo);
    const int before = grey();
    const ImageF mean = refined(scene, View::Albedo, 16);
    EXPECT_TRUE(before == 0 || before == 188) << before; // sRGB of 0.5
    EXPECT_NEAR(grey(), 137, 8);                         // of 0.25
    const ImageF metered = viewport->readMetering();
    const auto between = [](glm::vec3 c) { return c.x > 0.1f && c.x < 0.4f; };
    EXPECT_TRUE(std::ranges::any_of(metered.rgb, between));
}

TEST(SamplePoints, LieInDifferentColumnsAndRows) {
    EXPECT_EQ(render::samplePoint(0), glm::vec2(0));
    for (const std::uint32_t count : {2u, 4u, 16u, 64u, 256u}) {
        std::set<int> columns, rows;
        for (std::uint32_t n = 0; n < count; ++n) {
            const glm::vec2 p = render::samplePoint(n) + 0.5f;
            EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
            columns.insert(int(p.x * float(count)));
            rows.insert(int(p.y * float(count)));
        }
        EXPECT_EQ(columns.size(), count);
        EXPECT_EQ(rows.size(), count);
    }
}

// As many of the first 4^k in each of as many squares.
TEST(SamplePoints, LieInDifferentSquares) {
    for (const int across : {2, 4, 8}) {
        std::set<int> squares;
        for (int n = 0; n < across * across; ++n) {
            const glm::ivec2 at((render::samplePoint(std::uint32_t(n)) + 0.5f) * float(across));
            squares.insert(at.y * across + at.x);
        }
        EXPECT_EQ(int(squares.size()), across * across);
    }
}

} // namespace
} // namespace limn::refine_test
