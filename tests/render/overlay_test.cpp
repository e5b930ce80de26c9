// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/overlay.h"

#include "engine/overlay/palette.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "tests/render/viewport_fixture.h"

#include <limits>

namespace limn::overlay_test {

namespace {

/// The picture from above the plane y = 0 with an overlay; the middle pixel is (16, 16).
class ViewportOverlays : public ViewportTest {
protected:
    Image drawOver(const Scene& scene, std::shared_ptr<const OverlayData> overlay) {
        viewport->setOverlay(std::move(overlay));
        draw(scene, View::Lit);
        return viewport->readTonemapped();
    }

    static glm::uvec3 pixelOf(const Image& image, std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* p = &image.rgba[(std::size_t(y) * image.width + x) * 4];
        return {p[0], p[1], p[2]};
    }
};

std::shared_ptr<OverlayData> disc(glm::vec3 position, glm::vec3 normal, float radius = 1) {
    auto data = std::make_shared<OverlayData>();
    data->marks = {{.position = position,
                    .radius = radius,
                    .normal = normal,
                    .color = packColor({1, 0.5f, 0})}};
    return data;
}

const glm::uvec3 kOrange(255, 128, 0);

} // namespace

TEST_F(ViewportOverlays, AMarkHasItsOwnColourAndSizeOverAGreyPicture) {
    const Image image = drawOver(plane({0, 0, 0.9f}).build(), disc({0, 0, 0}, {0, 1, 0}));
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x) {
            const float r = glm::length(planePoint(options, x, y));
            if (r < 0.6f) {
                EXPECT_EQ(pixelOf(image, x, y), kOrange) << x << ", " << y;
            }
            if (r > 1.1f) {
                const glm::uvec3 c = pixelOf(image, x, y);
                EXPECT_TRUE(c.r == c.g && c.g == c.b && c.r > 40 && c.r < 140) << c.r << " " << c.b;
            }
        }
}

TEST_F(ViewportOverlays, MarksHideBehindSurfacesAndShowTheirFrontOnly) {
    const Scene scene = plane().build();
    const auto middle = [&](std::shared_ptr<OverlayData> data) {
        return pixelOf(drawOver(scene, std::move(data)), 16, 16);
    };
    EXPECT_NE(middle(disc({0, -0.1f, 0}, {0, 1, 0})), kOrange);
    EXPECT_NE(middle(disc({0, 1, 0}, {0, -1, 0})), kOrange);
    EXPECT_EQ(middle(disc({0, 1, 0}, {0, 1, 0})), kOrange);
    EXPECT_EQ(middle(disc({0, 1, 0}, {0, 0, 0})), kOrange); // turned to the viewer
}

TEST_F(ViewportOverlays, TexelsColourTheSurfaceWhereTheirUvSaysAndLeaveOutUnpaintedOnes) {
    const Scene scene = plane().build();
    layout = std::make_shared<LightmapLayout>();
    layout->width = 2;
    layout->height = 1;
    layout->meshes = {{{0, 1, 2, 3}, {0, 1, 2, 0, 2, 3}, {0, 0}, {}, {{1, 1}}}};
    layout->instances = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    auto data = std::make_shared<OverlayData>();
    data->width = 2;
    data->height = 1;
    data->texels = {packColor({1, 0.5f, 0}), 0};
    const Image image = drawOver(scene, data);
    // The plane faces the viewer, so its colours are not darkened; x < 0 is texel 0. Looking down,
    // the picture's right is x > 0 or x < 0 as the camera's up vector has it.
    for (std::uint32_t x : {2u, 29u}) {
        const bool first = planePoint(options, x, 16).x < 0;
        const glm::vec3 c(pixelOf(image, x, 16));
        if (first)
            EXPECT_TRUE(c.r > 1.9f * c.g && c.b == 0 && c.r > 200)
                << c.r << " " << c.g << " " << c.b;
        else
            EXPECT_TRUE(c.r == c.g && c.g == c.b);
    }
}

// Finer texels stand for the four green ones at the plane's corners: red where their number in the
// row is even, else blue.
TEST_F(ViewportOverlays, FinerTexelsAreShownWhereLookupsReadThem) {
    Scene scene = plane().build();
    constexpr float kScale = 0.15f;
    scene.instances[0].toWorld = glm::scale(glm::mat4(1), glm::vec3(kScale));
    layout = std::make_shared<LightmapLayout>();
    layout->width = 5;
    layout->height = 7;
    layout->meshes = {{{0, 1, 2, 3}, {0, 1, 2, 0, 2, 3}, {0, 0}, {}, {{1, 1}}}};
    std::vector<glm::vec2> uv;
    const std::vector<glm::vec3>& corners = scene.meshOf(scene.instances[0]).positions;
    float half = 0;
    for (const glm::vec3 p : corners)
        half = std::max(half, p.x);
    const auto along = [&](float x) { return (x / half + 1) / 2; };
    glm::uvec2 seen(0); // red, blue
    for (const glm::vec3 p : corners)
        uv.emplace_back((0.5f + along(p.x)) / 5, (0.5f + along(p.z)) / 7);
    layout->instances = {{uv}};
    auto data = std::make_shared<OverlayData>();
    data->width = 5;
    data->height = 7;
    data->texels.assign(35, packColor({0, 1, 0}));
    for (std::size_t i = 10; i < 35; ++i)
        data->texels[i] = i % 5 % 2 == 0 ? packColor({1, 0, 0}) : packColor({0, 0, 1});
    data->finer.assign(35, ~0U);
    data->finer[0] = 10;
    const Image image = drawOver(scene, data);
    for (std::uint32_t x = 0; x < image.width; ++x) {
        const float column = along(planePoint(options, x, 16).x / kScale) * float(kFineCells);
        const glm::uvec3 c = pixelOf(image, x, 16);
        if (column < 0 || column > float(kFineCells) ||
            std::abs(column - std::floor(column) - 0.5f) < 0.1f)
            continue;
        ++seen[c.r > c.b ? 0 : 1];
        EXPECT_EQ(c.g, 0U) << x;
        EXPECT_EQ(c.r > c.b, std::lround(column) % 2 == 0) << x << ' ' << column;
    }
    EXPECT_GT(seen.x, 5U);
    EXPECT_GT(seen.y, 5U);
}

TEST_F(ViewportOverlays, TexelsColourEachSideOfATwoSidedSurfaceMirroredOrNot) {
    simple::SceneBuilder b = plane();
    b.scene.materials[0].doubleSided = true;
    layout = std::make_shared<LightmapLayout>();
    layout->width = 1;
    layout->height = 2;
    layout->meshes = {{{0, 1, 2, 3}, {0, 1, 2, 0, 2, 3}, {0, 0}, {}, {{1, 1}}}};
    layout->instances = {{std::vector<glm::vec2>(4, {0.5f, 0.25f}), 1}};
    auto data = std::make_shared<OverlayData>();
    data->width = 1;
    data->height = 2;
    data->texels = {packColor({1, 0.5f, 0}), packColor({0, 0.5f, 1})}; // front, back
    for (const float x : {1.f, -1.f})
        for (const float y : {1.f, -1.f}) { // the camera looks down on it
            b.scene.instances[0].toWorld = glm::scale(glm::mat4(1), glm::vec3(x, y, 1));
            const glm::uvec3 c = pixelOf(drawOver(b.build(), data), 16, 16);
            EXPECT_EQ(c.r > c.b, y > 0) << x << ", " << y << ": " << c.r << " " << c.b;
        }
}

TEST_F(ViewportOverlays, AWireframeDrawsTheEdgesOfTrianglesThatAreSeenAndNothingElse) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    b.add(simple::quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2})); // hidden behind the first
    options.width = options.height = 64;
    options.view = View::Albedo;
    viewport->setScene(b.build(), nullptr);
    const auto drawn = [&](Inspection inspection) {
        options.inspection = inspection;
        viewport->render(options);
        return viewport->readTonemapped();
    };
    const Image lines = drawn(Inspection::Wireframe);
    const auto isLine = [&](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* c = &lines.rgba[4 * std::size_t(y * 64 + x)];
        return c[2] == 255 && c[0] == 140;
    };
    // The square fills 5 tan(0.35) / 1 = 1.825 half pictures: its edges are 17.5 pixels from the
    // middle, and one diagonal crosses it.
    int rows = 0, diagonal = 0;
    for (std::uint32_t y = 16; y < 48; ++y) {
        int edges = 0;
        for (std::uint32_t x = 0; x < 64; ++x) {
            const bool near = x < 13 || x > 50;
            EXPECT_FALSE(near && isLine(x, y)) << x << ", " << y << ": outside the square";
            edges += isLine(x, y) ? 1 : 0;
        }
        rows += edges >= 2 && edges <= 5 ? 1 : 0;
        diagonal += isLine(y, y) || isLine(63 - y, y) || isLine(y, 63 - y) ? 1 : 0;
    }
    EXPECT_GE(rows, 30) << "the sides and the diagonal, not the hidden square's edges inside";
    EXPECT_GE(diagonal, 24);
    const Image again = drawn(Inspection::None);
    EXPECT_FALSE(std::equal(again.rgba.begin(), again.rgba.end(), lines.rgba.begin()));
}

TEST_F(ViewportOverlays, InvalidPixelsAreMagentaWhereAskedForAndValidOnesAreNot) {
    const auto magenta = [&](glm::vec3 sky, Inspection inspection) {
        Scene scene;
        scene.assets = std::make_shared<Assets>();
        scene.sky.radiance = sky;
        viewport->setScene(scene, nullptr);
        options.view = View::Lit;
        options.inspection = inspection;
        viewport->render(options);
        const Image image = viewport->readTonemapped();
        int count = 0;
        for (std::size_t i = 0; i < image.rgba.size(); i += 4)
            count += image.rgba[i] == 255 && image.rgba[i + 1] == 0 && image.rgba[i + 2] == 255;
        return count;
    };
    const int all = int(options.width * options.height);
    const float inf = std::numeric_limits<float>::infinity(), nan = inf - inf;
    EXPECT_EQ(magenta(glm::vec3(0.5f), Inspection::InvalidPixels), 0);
    EXPECT_EQ(magenta({0.5f, nan, 0.5f}, Inspection::InvalidPixels), all);
    EXPECT_EQ(magenta({inf, 0.5f, 0.5f}, Inspection::InvalidPixels), all);
    EXPECT_EQ(magenta({0.5f, nan, 0.5f}, Inspection::None), 0);
}

TEST_F(ViewportOverlays, OffCostsNoMemoryAndChangesNothing) {
    const Scene scene = plane().build();
    const Image before = drawOver(scene, nullptr);
    device->waitIdle();
    const std::uint64_t bytes = viewport->stats().gpuBytes;
    const Image over = drawOver(scene, disc({0, 0, 0}, {0, 1, 0}));
    EXPECT_NE(over.rgba, before.rgba);
    device->waitIdle();
    EXPECT_GT(viewport->stats().gpuBytes, bytes);
    const Image after = drawOver(scene, nullptr);
    device->waitIdle();
    EXPECT_EQ(after.rgba, before.rgba);
    EXPECT_EQ(viewport->stats().gpuBytes, bytes);
}

TEST_F(ViewportOverlays, EachOverlayOfABakeIsDrawnInTurn) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.7f, 0.7f}));
    b.add(simple::box({-2, -2, -2}, {2, 2, 2}, true));
    b.add(simple::box({-0.5f, -1.5f, -0.5f}, {0.5f, -0.5f, 0.5f}, false));
    b.scene.bake.surfels = 300;
    b.scene.bake.links = 16;
    b.scene.bake.rays = 64;
    b.scene.bake.lightmapCaches = 300;
    b.scene.bake.grid = {3, 3, 3};
    const Scene scene = b.build();
    const TraceScene trace(scene);
    const Result<Bake> baked = bake(trace);
    ASSERT_TRUE(baked);
    const LitBake lit{std::vector<glm::vec4>(baked->tree.size(), {1, 0.5f, 0.2f, 0}),
                      std::vector<glm::vec3>(baked->caches.size() * 4, glm::vec3(1)), 2};
    layout = std::make_shared<LightmapLayout>(baked->lightmap);
    options.camera.eye = {0.3f, 1.7f, 1.2f};
    options.width = options.height = 64;
    const Image without = drawOver(scene, nullptr);
    for (int round = 0; round < 2; ++round) // frames in flight, buffers replaced
        for (std::uint32_t k = 1; k < kOverlays.size(); ++k) {
            const auto data = std::make_shared<const OverlayData>(
                makeOverlay(*baked, scene,
                            {.kind = Overlay(k),
                             .depth = 4,
                             .cache = kOverlays[k].pick == OverlayPick::Required ? 0 : ~0u},
                            &lit));
            const Image image = drawOver(scene, data);
            std::size_t colored = 0;
            for (std::size_t p = 0; p < image.rgba.size(); p += 4)
                colored += image.rgba[p] != image.rgba[p + 1] || image.rgba[p] != image.rgba[p + 2];
            // As the albedo is, and the light of white lamps in a grey room.
            const bool grey = Overlay(k) == Overlay::Surfels || Overlay(k) == Overlay::Lobes;
            EXPECT_EQ(colored > 200, !grey) << kOverlays[k].name << ": " << colored;
            EXPECT_NE(image.rgba, without.rgba);
        }
}

} // namespace limn::overlay_test
