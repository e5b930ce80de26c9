// SPDX-License-Identifier: MIT
#include "tests/render/viewport_fixture.h"

#include "engine/render/shadows/shadow_maps.h"
#include "engine/render/surfaces/render_scene.h"
#include "engine/trace/rectangle_shadow.h"
#include "engine/trace/trace_scene.h"

namespace limn::shadow_test {

namespace {

Light lightOf(LightKind kind, glm::vec3 position, glm::vec3 direction, float strength) {
    Light l;
    l.kind = kind;
    l.position = position;
    l.direction = glm::normalize(direction);
    l.strength = strength;
    l.outerAngle = 1.f;
    return l;
}

/// The plane and a square of 2 m, 1 m above its middle.
simple::SceneBuilder planeAndRoof() {
    simple::SceneBuilder b = plane();
    b.add(simple::quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}));
    return b;
}

/// Through the middle of a pixel.
Ray cameraRay(const ViewportOptions& o, std::uint32_t x, std::uint32_t y) {
    const float aspect = float(o.width) / float(o.height);
    const glm::vec3 d = rayDirection(o.camera, aspect, 2 * (float(x) + 0.5f) / float(o.width) - 1,
                                     1 - 2 * (float(y) + 0.5f) / float(o.height));
    return {.origin = o.camera.eye, .direction = glm::normalize(d)};
}

/// Direct view by rays: what the shadow maps approximate.
glm::vec3 tracedDirect(const TraceScene& trace, const ViewportOptions& o, std::uint32_t x,
                       std::uint32_t y) {
    const Hit hit = trace.closestHit(cameraRay(o, x, y));
    if (!hit)
        return glm::vec3(0);
    const Scene& scene = trace.scene();
    const Instance& instance = scene.instances[hit.instance];
    glm::vec3 E(0);
    for (const Light& light : scene.lights) {
        const LightSample s = sampleLight(light, hit.position);
        const glm::vec3 from = hit.position + hit.geometricNormal * trace.epsilonAt(hit.position);
        if (!trace.occluded({.origin = from, .direction = s.toLight, .tFar = s.distance * 0.999f}))
            E += s.irradiance * std::max(0.f, glm::dot(hit.geometricNormal, s.toLight));
    }
    return surfaceMaterial(scene, instance, hit.triangle, hit.u, hit.v).albedo * E / kPi;
}

} // namespace

class ViewportShadows : public ViewportTest {
protected:
    std::uint32_t mapsDrawn(const Scene& scene) {
        viewport->setScene(scene, nullptr);
        viewport->render(options);
        return viewport->stats().shadowMapsDrawn;
    }
};

TEST_F(ViewportShadows, APointBehindARoofIsBlackAndOneBesideItIsAsWithout) {
    options.camera.eye = {0, 5, 6};
    for (LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
        simple::SceneBuilder open = plane(), roofed = planeAndRoof();
        Light light = lightOf(kind, {0, 4, 0}, {0, -1, 0}, 10);
        light.range = kind == LightKind::Spot ? 5.f : 0.f; // the roof is 3 m away
        open.scene.lights = roofed.scene.lights = {light};
        const ImageF lit = draw(open.build(), View::Direct);
        const ImageF shadowed = draw(roofed.build(), View::Direct);
        int black = 0, same = 0;
        for (std::uint32_t y = 0; y < 32; ++y)
            for (std::uint32_t x = 0; x < 32; ++x) {
                const glm::vec3 p = planePoint(options, x, y);
                const glm::vec3 roof = planePoint(options, x, y, 1);
                if (std::abs(roof.x) < 1.1f && std::abs(roof.z) < 1.1f)
                    continue; // the roof hides it
                const float edge = kind == LightKind::Directional ? 1.f : 4.f / 3; // of the shadow
                const float r = std::max(std::abs(p.x), std::abs(p.z));
                if (r < edge - 0.05f) {
                    EXPECT_EQ(pixel(shadowed, x, y), glm::vec3(0)) << x << ", " << y;
                    ++black;
                } else if (r > edge + 0.05f) {
                    expectNear(pixel(shadowed, x, y), pixel(lit, x, y), 1e-5f);
                    ++same;
                }
            }
        EXPECT_GT(black, 5);
        EXPECT_GT(same, 200);
    }
}

TEST_F(ViewportShadows, AgreeWithTracedRaysButForTheirEdges) {
    simple::SceneBuilder b = planeAndRoof();
    b.add(simple::box({1.5f, 0, -1}, {2.5f, 2, 0.5f}, false));
    b.add(simple::sphere(0.5f, 3, false), glm::translate(glm::mat4(1), glm::vec3(-1.7f, 0.6f, 0)));
    b.add(simple::box({-10, -0.1f, -10}, {10, 6, 10}, true)); // a closed room round all
    options.camera.eye = {3, 4, 5};
    options.width = 96;
    options.height = 64;
    const std::array lights = {lightOf(LightKind::Point, {0, 3, 2}, {}, 30),
                               lightOf(LightKind::Spot, {-4, 3, 3}, {1, -0.8f, -0.8f}, 60),
                               lightOf(LightKind::Point, {0.2f, 0.5f, 0.3f}, {}, 5)};
    for (const Light& light : lights) {
        b.scene.lights = {light};
        const Scene scene = b.build();
        const TraceScene trace(scene);
        const ImageF image = draw(scene, View::Direct);
        int wrong = 0;
        for (std::uint32_t y = 0; y < options.height; ++y)
            for (std::uint32_t x = 0; x < options.width; ++x) {
                const glm::vec3 expected = tracedDirect(trace, options, x, y);
                wrong += glm::length(pixel(image, x, y) - expected) >
                         0.05f * glm::length(expected) + 1e-4f;
            }
        // Pixels on the edges of shadows, and the sphere's, whose smooth normals differ from its
        // facets.
        EXPECT_LE(wrong, int(options.width * options.height) * 4 / 100);
    }
}

/// Plates of 0.6 m, a metre apart, from the origin to (8, 0, 8): 3200 triangles in one mesh, rows
/// from the near half and the far one in turn.
Mesh plates() {
    std::vector<glm::vec3> corners;
    const auto square = [&](glm::vec3 o, float size) {
        const glm::vec3 x(size, 0, 0), z(0, 0, size);
        corners.insert(corners.end(), {o, o + z, o + x, o + x, o + z, o + x + z});
    };
    for (int row = 0; row < 8; ++row)
        for (int plate = 0; plate < 8; ++plate)
            for (int k = 0; k < 25; ++k)
                square({float(plate) + 0.12f * float(k % 5), 0,
                        float(4 * (row % 2) + row / 2) + 0.12f * float(k / 5)},
                       0.12f);
    return simple::flatShaded(corners, 0);
}

TEST_F(ViewportShadows, SheetsOfGlassCastNone) {
    simple::SceneBuilder b = planeAndRoof();
    b.scene.lights = {lightOf(LightKind::Directional, {}, {0.3f, -1, 0.2f}, 3)};
    options.camera.eye = {3, 4, 5};
    const Scene opaque = b.build();
    const Scene without = [] {
        simple::SceneBuilder alone = plane();
        alone.scene.lights = {lightOf(LightKind::Directional, {}, {0.3f, -1, 0.2f}, 3)};
        return alone.build();
    }();
    Material glass = simple::lambert(glm::vec3(1));
    glass.transmission = 1;
    b.addMaterial(glass);
    b.scene.instances[1].material = 1;
    const ImageF shaded = draw(opaque, View::Direct), lit = draw(b.build(), View::Direct),
                 empty = draw(without, View::Direct);
    int same = 0, changed = 0;
    for (std::uint32_t y = 0; y < options.height; ++y)
        for (std::uint32_t x = 0; x < options.width; ++x) {
            if (pixel(empty, x, y) == glm::vec3(0) || pixel(lit, x, y) == glm::vec3(0))
                continue; // nothing, or the sheet itself, which reflects no light diffusely
            same += glm::length(pixel(lit, x, y) - pixel(empty, x, y)) <
                    1e-3f * glm::length(pixel(empty, x, y));
            changed += pixel(shaded, x, y) == glm::vec3(0);
            EXPECT_NEAR(pixel(lit, x, y).g, pixel(empty, x, y).g, 2e-3f * pixel(empty, x, y).g);
        }
    EXPECT_GT(same, 100);
    EXPECT_GT(changed, 5);
}

TEST_F(ViewportShadows, OfAMeshOfManyTrianglesAgreeWithTracedRays) {
    simple::SceneBuilder b = plane();
    b.add(plates(), glm::translate(glm::mat4(1), glm::vec3(-3.8f, 1, -3.8f)));
    options.camera.eye = {3, 4, 5};
    options.width = 96;
    options.height = 64;
    std::vector<Light> lights = {lightOf(LightKind::Point, {0.5f, 2, -0.5f}, {}, 30),
                                 lightOf(LightKind::Point, {-2, 1.5f, -2}, {}, 30),
                                 lightOf(LightKind::Spot, {3, 3, 3}, {-1, -1, -1}, 60),
                                 lightOf(LightKind::Directional, {}, {0.3f, -1, 0.2f}, 3)};
    lights[1].range = lights[2].range = 4;
    for (const Light& light : lights) {
        b.scene.lights = {light};
        const Scene scene = b.build();
        const TraceScene trace(scene);
        const ImageF image = draw(scene, View::Direct);
        int wrong = 0, lit = 0;
        for (std::uint32_t y = 0; y < options.height; ++y)
            for (std::uint32_t x = 0; x < options.width; ++x) {
                const glm::vec3 expected = tracedDirect(trace, options, x, y);
                lit += expected.g > 0;
                wrong += glm::length(pixel(image, x, y) - expected) >
                         0.05f * glm::length(expected) + 1e-4f;
            }
        EXPECT_GT(lit, 200);
        // Pixels on the edges of shadows.
        EXPECT_LE(wrong, lit * 4 / 100) << int(light.kind) << ", range " << light.range;
    }
}

TEST_F(ViewportShadows, OfARectangleAreSoftAsTracedOnes) {
    simple::SceneBuilder b = planeAndRoof();
    b.add(simple::box({1.5f, 0, -1}, {2.5f, 2, 0.5f}, false));
    options.camera.eye = {3, 4, 5};
    options.width = 96;
    options.height = 64;
    Light light = lightOf(LightKind::Rectangle, {0.4f, 3, 1}, {0.2f, -1, -0.2f}, 8);
    light.size = {1.2f, 0.6f};
    b.scene.lights = {light};
    const Scene scene = b.build();
    const TraceScene trace(scene);
    const ImageF image = draw(scene, View::Direct);
    double squares = 0, sum = 0, error = 0, soft = 0;
    for (std::uint32_t y = 0; y < options.height; ++y)
        for (std::uint32_t x = 0; x < options.width; ++x) {
            const Hit hit = trace.closestHit(cameraRay(options, x, y));
            if (!hit)
                continue;
            const LightRectangle r = lightRectangle(light);
            std::uint64_t rays = 0;
            const float share = shadowedIrradiance(
                trace, r, RectangleReceiver::flat(hit.position, hit.geometricNormal), 512, {},
                rays);
            const float whole = rectangleIrradiance(r, hit.position, hit.geometricNormal);
            const double expected = 0.4 * 8 * double(share) / double(kPi);
            const double d = double(pixel(image, x, y).g) - expected;
            squares += d * d;
            error += d;
            sum += expected;
            soft += share > 0.02f * whole && share < 0.98f * whole;
        }
    EXPECT_GT(soft, 300); // else nothing is tested
    const double pixels = double(options.width) * options.height;
    EXPECT_LT(std::sqrt(squares / pixels) / (sum / pixels), 0.03);
    EXPECT_LT(std::abs(error / sum), 0.01); // edges that no quarter's middle sees let light pass
    RecordProperty("nrmse", std::to_string(std::sqrt(squares / pixels) / (sum / pixels)));
}

// Far beyond the walls of a room with a table in it.
TEST_F(ViewportShadows, OfARectangleThatReachesThroughWallsAreAsTraced) {
    for (const float size : {3.f, 8.f, 20.f, 50.f, 100.f}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.4f)));
        b.add(simple::box({-2, 0, -2.5f}, {2, 3, 2.5f}, true));
        b.add(simple::box({-0.5f, 0.7f, -0.6f}, {0.7f, 0.8f, 0.6f}, false));
        options.camera.eye = {-1.8f, 1.8f, 2.3f};
        options.camera.target = {0.3f, 0.4f, 0};
        options.width = 96;
        options.height = 64;
        Light light = lightOf(LightKind::Rectangle, {0.2f, 2.6f, 0.1f}, {0, -1, 0}, 8);
        light.size = glm::vec2(size);
        b.scene.lights = {light};
        const Scene scene = b.build();
        const TraceScene trace(scene);
        const ImageF image = draw(scene, View::Direct);
        double squares = 0, sum = 0, error = 0;
        for (std::uint32_t y = 0; y < options.height; ++y)
            for (std::uint32_t x = 0; x < options.width; ++x) {
                const Hit hit = trace.closestHit(cameraRay(options, x, y));
                if (!hit)
                    continue;
                std::uint64_t rays = 0;
                const float share = shadowedIrradiance(
                    trace, lightRectangle(light),
                    RectangleReceiver::flat(hit.position, hit.geometricNormal), 512, {}, rays);
                const double expected = 0.4 * 8 * double(share) / double(kPi);
                const double d = double(pixel(image, x, y).g) - expected;
                squares += d * d;
                error += d;
                sum += expected;
            }
        const double pixels = double(options.width) * options.height;
        EXPECT_LT(std::sqrt(squares / pixels) / (sum / pixels), 0.15) << size;
        EXPECT_LT(std::abs(error / sum), 0.05) << size;
        std::printf("%g m: nRMSE %.4f, bias %+.4f\n", double(size),
                    std::sqrt(squares / pixels) / (sum / pixels), error / sum);
    }
}

TEST_F(ViewportShadows, LitFlatSurfacesHaveNoAcneAtGrazingAngles) {
    simple::SceneBuilder b = planeAndRoof();
    for (float slope : {0.02f, 0.1f, 0.5f, 2.f}) {
        b.scene.lights = {lightOf(LightKind::Directional, {}, {1, -slope, 0.3f}, 1)};
        const ImageF image = draw(b.build(), View::Direct);
        const float expected = 0.4f / kPi * -b.scene.lights[0].direction.y;
        for (std::uint32_t y = 0; y < 32; ++y) // left of the roof, where the sun comes from
            EXPECT_NEAR(pixel(image, 1, y).g, expected, 1e-5f) << slope;
    }
}

TEST_F(ViewportShadows, HonourAlphaMasks) {
    simple::SceneBuilder b = planeAndRoof();
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.scene.instances[1].material = 1;
    b.assets->images.push_back({"mask", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    Material& m = b.scene.materials[1];
    m.alphaMode = AlphaMode::Mask;
    m.baseColorTexture = {.image = 0, .nearest = true}; // the half x < 0 of the roof is kept
    b.scene.lights = {lightOf(LightKind::Directional, {}, {0, -1, 0}, kPi)};
    options.camera = {.eye = {0, 0.5f, 4}, .target = {0, 0.2f, 0}, .fovY = 0.7f};
    const ImageF image = draw(b.build(), View::Direct);
    float shadow = 1, light = 0;
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x) {
            const glm::vec3 p = planePoint(options, x, y);
            if (std::abs(p.z) > 0.8f || planePoint(options, x, y).y > 0.01f)
                continue;
            if (p.x > -0.9f && p.x < -0.1f)
                shadow = std::min(shadow, pixel(image, x, y).g);
            if (p.x > 0.1f && p.x < 0.9f)
                light = std::max(light, pixel(image, x, y).g);
        }
    EXPECT_EQ(shadow, 0);
    EXPECT_NEAR(light, 0.4f, 1e-4f);
    options.camera = {.eye = {0, 5, 0}, .target = {0, 0, 0}, .fovY = 0.7f};
    const ImageF above = draw(b.build(), View::Albedo);
    for (std::uint32_t y = 12; y < 20; ++y)
        for (std::uint32_t x = 12; x < 20; ++x) {
            const float roof = planePoint(options, x, y, 1).x;
            ASSERT_GT(std::abs(roof), 0.01f);
            EXPECT_NEAR(pixel(above, x, y).r, roof < 0 ? 0.5f : 0.2f, 1e-3f) << "seen through";
        }
}

TEST_F(ViewportShadows, AreDrawnOnlyWhenALightOrAnObjectMoved) {
    simple::SceneBuilder b = planeAndRoof();
    b.scene.lights = {lightOf(LightKind::Directional, {}, {0, -1, 0.1f}, 1),
                      lightOf(LightKind::Point, {0, 4, 0}, {}, 10),
                      lightOf(LightKind::Spot, {1, 4, 0}, {0, -1, 0}, 10)};
    Scene scene = b.build();
    options.view = View::Direct;
    EXPECT_EQ(mapsDrawn(scene), 3u);
    EXPECT_EQ(mapsDrawn(scene), 0u) << "nothing changed";
    scene.lights[0].strength = 5;
    scene.lights[1].color = {1, 0, 0};
    scene.lights[2].range = 3.5f; // the roof is 3 m away
    scene.lights[2].innerAngle = 0.1f;
    scene.sky.radiance = glm::vec3(1);
    scene.materials[0].baseColor = glm::vec4(0.5f);
    EXPECT_EQ(mapsDrawn(scene), 0u) << "strength, colour and range cast no other shadow";
    scene.lights[2].range = 4;
    EXPECT_EQ(mapsDrawn(scene), 0u) << "what it reaches is drawn";
    scene.lights[1].range = 3.5f;
    scene.lights[1].position.x += 0.1f;
    EXPECT_EQ(mapsDrawn(scene), 1u);
    scene.lights[1].range = 8;
    EXPECT_EQ(mapsDrawn(scene), 1u) << "more may be in its way";
    std::swap(scene.lights[0], scene.lights[2]);
    EXPECT_EQ(mapsDrawn(scene), 0u) << "their order does not matter";
    scene.lights[1].enabled = false;
    EXPECT_EQ(mapsDrawn(scene), 0u);
    scene.instances[1].toWorld = glm::translate(glm::mat4(1), glm::vec3(0, 0.2f, 0));
    EXPECT_EQ(mapsDrawn(scene), 2u) << "an object moved; the light that is off has no map";
    scene.lights[0].kind = LightKind::Rectangle;
    EXPECT_GE(mapsDrawn(scene), 1u); // more where the atlas had to grow
    scene.lights[0].strength = 9;
    EXPECT_EQ(mapsDrawn(scene), 0u);
    scene.lights[0].size.x = 0.5f;
    EXPECT_EQ(mapsDrawn(scene), 1u) << "the quarters' middles moved";
}

TEST_F(ViewportShadows, LightsThatDoNotShineCostNothing) {
    simple::SceneBuilder b = planeAndRoof();
    mapsDrawn(b.build());
    device->waitIdle();
    const std::uint64_t bytes = viewport->stats().gpuBytes;
    Light off = lightOf(LightKind::Point, {0, 4, 0}, {}, 10), black = off, weak = off, far = off;
    off.enabled = false;
    black.color = glm::vec3(0);
    weak.strength = 0;
    far.range = 2.9f; // the roof is 3 m away
    b.scene.lights = {off, black, weak, far};
    b.build();
    viewport->setLighting(b.scene);
    viewport->render(options);
    EXPECT_EQ(viewport->stats().shadowMapsDrawn, 0u);
    device->waitIdle();
    EXPECT_EQ(viewport->stats().gpuBytes, bytes);
}

TEST_F(ViewportShadows, AreNotDrawnForViewsWithoutDirectLight) {
    simple::SceneBuilder b = planeAndRoof();
    b.scene.lights = {lightOf(LightKind::Point, {0, 4, 0}, {}, 10)};
    const Scene scene = b.build();
    for (View view : {View::Irradiance, View::Indirect, View::Albedo, View::Normals}) {
        options.view = view;
        EXPECT_EQ(mapsDrawn(scene), 0u);
    }
    options.view = View::Lit;
    EXPECT_EQ(mapsDrawn(scene), 1u);
}

TEST_F(ViewportShadows, OfManyLightsAtOnceAreAllRight) {
    simple::SceneBuilder b = planeAndRoof();
    std::vector<ImageF> alone;
    std::vector<Light> lights;
    for (int i = 0; i < 9; ++i) {
        const float a = 0.7f * float(i);
        lights.push_back(lightOf(LightKind(i % 3), {2 * std::cos(a), 2.5f, 2 * std::sin(a)},
                                 {-std::cos(a), -1.5f, -std::sin(a)}, 3));
    }
    for (const Light& light : lights) {
        b.scene.lights = {light};
        alone.push_back(draw(b.build(), View::Direct));
    }
    b.scene.lights = lights;
    const ImageF all = draw(b.build(), View::Direct);
    EXPECT_GE(viewport->stats().shadowMapsDrawn, 8u) << "each picture before left one map at most";
    for (std::size_t i = 0; i < all.rgb.size(); ++i) {
        glm::vec3 sum(0);
        for (const ImageF& image : alone)
            sum += image.rgb[i];
        expectNear(all.rgb[i], sum, 1e-4f);
    }
}

TEST(ShadowViews, HoldEveryCornerOfTheSceneAndPutNearDepthsAboveFarOnes) {
    const Bounds bounds{{-3, -1, -2}, {5, 4, 2}};
    const render::ShadowKey sun{.kind = LightKind::Directional,
                                .direction = glm::normalize(glm::vec3(0.3f, -1, 0.2f))};
    const auto views = render::shadowViews(sun, bounds, 1024);
    ASSERT_EQ(views.size(), 1u);
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p((i & 1) ? 5.f : -3.f, (i & 2) ? 4.f : -1.f, (i & 4) ? 2.f : -2.f);
        const glm::vec4 q = views[0].toClip * glm::vec4(p, 1);
        EXPECT_TRUE(std::abs(q.x) < q.w && std::abs(q.y) < q.w && q.z > 0 && q.z < q.w);
        const glm::vec4 further = views[0].toClip * glm::vec4(p + 0.1f * sun.direction, 1);
        EXPECT_LT(further.z / further.w, q.z / q.w);
    }
}

TEST(ShadowViews, OfAPointLightLookAllRound) {
    const Bounds bounds{glm::vec3(-5), glm::vec3(5)};
    const auto views =
        render::shadowViews({.kind = LightKind::Point, .position = {1, 0, 0}}, bounds, 512);
    ASSERT_EQ(views.size(), 6u);
    for (glm::vec3 d : {glm::vec3(1, 0.9f, -0.9f), glm::vec3(-1, 0.2f, 0.3f), glm::vec3(0, 1, 0),
                        glm::vec3(0.5f, -1, 0.5f), glm::vec3(0, 0, 1), glm::vec3(0.9f, 0.9f, -1)}) {
        int inside = 0;
        for (const auto& v : views) {
            const glm::vec4 q = v.toClip * glm::vec4(glm::vec3(1, 0, 0) + d, 1);
            inside += q.w > 0 && std::abs(q.x) <= q.w && std::abs(q.y) <= q.w;
        }
        EXPECT_GE(inside, 1);
    }
}

TEST(RenderScene, BoundsAreCulledOnlyWhenOutside) {
    const glm::mat4 toClip =
        projectionMatrix({}, 1, 100, 0.1f) * viewMatrix({.eye = {0, 0, 0}, .target = {0, 0, -1}});
    const auto visible = [&](glm::vec3 lower, glm::vec3 upper) {
        return render::mayBeVisible({lower, upper}, toClip);
    };
    EXPECT_TRUE(visible({-1, -1, -5}, {1, 1, -4}));
    EXPECT_TRUE(visible(glm::vec3(-1000), glm::vec3(1000))) << "the camera is inside";
    EXPECT_FALSE(visible({-1, -1, 4}, {1, 1, 5})) << "behind";
    EXPECT_FALSE(visible({50, -1, -5}, {51, 1, -4})) << "to the right";
    EXPECT_FALSE(visible({-1, -1, -300}, {1, 1, -200})) << "beyond";
}

TEST(RenderScene, BoundsFollowTransforms) {
    const Bounds b = render::transformBounds(
        {{-1, 0, 2}, {1, 3, 4}}, glm::rotate(glm::mat4(1), kPi / 2, glm::vec3(0, 1, 0)));
    EXPECT_NEAR(b.lower.x, 2, 1e-5f);
    EXPECT_NEAR(b.upper.x, 4, 1e-5f);
    EXPECT_NEAR(b.lower.z, -1, 1e-5f);
    EXPECT_NEAR(b.upper.z, 1, 1e-5f);
}

} // namespace limn::shadow_test
