// SPDX-License-Identifier: MIT
#include "tests/render/viewport_fixture.h"

#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <random>

namespace limn::viewport_test {

namespace {

Light pointLight(glm::vec3 position, float candela) {
    Light l;
    l.position = position;
    l.strength = candela;
    return l;
}

/// A field without lightmap whose grid of 2 x 2 x 2 cells holds the same coefficients everywhere.
IndirectField constantGrid(const std::array<glm::vec3, 9>& c, std::uint64_t version = 1) {
    IndirectField field;
    field.gridSize = glm::uvec3(2);
    field.gridBounds = {glm::vec3(-10), glm::vec3(10)};
    for (glm::vec3 k : c)
        field.grid.insert(field.grid.end(), 8, glm::vec4(k, 0));
    field.version = version;
    return field;
}

std::array<glm::vec3, 9> constantRadiance(glm::vec3 L) {
    std::array<glm::vec3, 9> c{};
    c[0] = L * (2 * std::sqrt(kPi));
    return c;
}

bool isFinite(const ImageF& image) {
    return std::all_of(image.rgb.begin(), image.rgb.end(), [](glm::vec3 p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

} // namespace

class ViewportViews : public ViewportTest {};

TEST_F(ViewportViews,
       DirectLightOfAPointOverAPlaneIsAlbedoOverPiTimesIntensityCosineOverDistance2) {
    simple::SceneBuilder b = plane();
    const Light light = pointLight({0.3f, 2, -0.4f}, 50);
    b.scene.lights = {light};
    const ImageF image = draw(b.build(), View::Direct);
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x) {
            const glm::vec3 d = light.position - planePoint(options, x, y);
            const float E = 50 * (d.y / glm::length(d)) / glm::dot(d, d);
            // Single precision interpolation of the position.
            expectNear(pixel(image, x, y), glm::vec3(0.2f, 0.4f, 0.8f) * E / kPi, 2e-4f);
        }
}

TEST_F(ViewportViews, DirectLightOfEveryKindIsThatOfSampleLight) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int round = 0; round < 24; ++round) {
        simple::SceneBuilder b = plane();
        Light light;
        light.kind = LightKind(round % 3);
        light.position = {unit(random) - 0.5f, 0.5f + unit(random), unit(random) - 0.5f};
        light.direction = glm::normalize(glm::vec3(unit(random) - 0.5f, -1, unit(random) - 0.5f));
        light.color = {unit(random), unit(random), unit(random)};
        light.strength = 1 + 99 * unit(random);
        light.range = round % 2 ? 1 + 3 * unit(random) : 0;
        light.innerAngle = 0.3f * unit(random);
        light.outerAngle = light.innerAngle + 0.1f + 0.9f * unit(random);
        b.scene.lights = {light};
        const ImageF image = draw(b.build(), View::Direct);
        for (std::uint32_t y = 0; y < 32; y += 3)
            for (std::uint32_t x = 0; x < 32; x += 3) {
                const LightSample s = sampleLight(light, planePoint(options, x, y));
                const glm::vec3 E = s.irradiance * std::max(s.toLight.y, 0.f);
                const glm::vec3 expected = glm::vec3(0.2f, 0.4f, 0.8f) * E / kPi;
                // At the rim of a cone or range the relative error of a vanishing number grows.
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(pixel(image, x, y)[c], expected[c],
                                1e-3f * expected[c] + 2e-5f * light.strength)
                        << "round " << round << " pixel " << x << ", " << y;
            }
    }
}

/// A profile that differs in all directions, over vertical angles of 10 to 170 degrees.
ProfileRef lopsidedProfile(std::uint32_t columns) {
    LightProfile p{.firstVertical = 10, .lastVertical = 170, .rows = 33, .columns = columns};
    for (std::uint32_t i = 0; i < p.rows * p.columns; ++i)
        p.share.push_back(0.5f + 0.5f * std::sin(0.37f * float(i)));
    return {std::make_shared<const LightProfile>(p)};
}

TEST_F(ViewportViews, DirectLightOfAProfileIsThatOfSampleLight) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int round = 0; round < 12; ++round) {
        simple::SceneBuilder b = plane();
        for (int k = 0; k < 3; ++k) { // whose values follow each other; the first has none
            Light light;
            light.kind = LightKind(1 + round % 2);
            light.position = {unit(random) - 0.5f, 0.5f + unit(random), unit(random) - 0.5f};
            light.direction = glm::normalize(glm::vec3(unit(random) - 0.5f, -1, 0.2f));
            light.strength = 1 + 9 * unit(random);
            light.roll = 6 * unit(random);
            light.outerAngle = 1.2f;
            if (k > 0)
                light.profile = lopsidedProfile(k == 1 ? 1 : 16);
            b.scene.lights.push_back(light);
        }
        const ImageF image = draw(b.build(), View::Direct);
        float darkest = 1e30f, brightest = 0;
        for (std::uint32_t y = 0; y < 32; y += 3)
            for (std::uint32_t x = 0; x < 32; x += 3) {
                float E = 0;
                for (const Light& light : b.scene.lights) {
                    const LightSample s = sampleLight(light, planePoint(options, x, y));
                    E += s.irradiance.x * std::max(s.toLight.y, 0.f);
                }
                darkest = std::min(darkest, E);
                brightest = std::max(brightest, E);
                expectNear(pixel(image, x, y), glm::vec3(0.2f, 0.4f, 0.8f) * E / kPi, 3e-3f);
            }
        EXPECT_GT(brightest, 1.5f * darkest);
    }
}

TEST_F(ViewportViews, DirectLightOfARectangleIsThatOfRectangleIrradiance) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int round = 0; round < 24; ++round) {
        simple::SceneBuilder b = plane();
        Light light;
        light.kind = LightKind::Rectangle;
        light.position = {unit(random) - 0.5f, 0.2f + 2 * unit(random), unit(random) - 0.5f};
        light.direction = glm::normalize(
            glm::vec3(unit(random) - 0.5f, round % 3 ? -1 : 0.1f, unit(random) - 0.5f));
        light.size =
            round % 4 ? glm::vec2(2 * unit(random) + 0.1f, 0.5f) : glm::vec2(0.004f, 0.02f);
        light.roll = 6 * unit(random);
        light.color = {unit(random), unit(random), unit(random)};
        light.strength = 1 + 99 * unit(random);
        b.scene.lights = {light};
        const ImageF image = draw(b.build(), View::Direct);
        for (std::uint32_t y = 0; y < 32; y += 3)
            for (std::uint32_t x = 0; x < 32; x += 3) {
                const float share = rectangleIrradiance(lightRectangle(light),
                                                        planePoint(options, x, y), {0, 1, 0});
                const glm::vec3 expected =
                    glm::vec3(0.2f, 0.4f, 0.8f) * light.color * (light.strength * share / kPi);
                // The shader sums angles in single precision: 1e-6 rad and what their sum cancels.
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(pixel(image, x, y)[c], expected[c],
                                1e-3f * expected[c] + 1e-6f * light.strength)
                        << "round " << round << " pixel " << x << ", " << y;
            }
    }
}

TEST_F(ViewportViews, LightsAddUp) {
    simple::SceneBuilder b = plane();
    std::array<ImageF, 3> images;
    for (std::size_t i = 0; i < 3; ++i) {
        b.scene.lights.clear();
        if (i != 1)
            b.scene.lights.push_back(pointLight({1, 2, 0}, 10));
        if (i != 0)
            b.scene.lights.push_back(pointLight({-1, 3, 0}, 20));
        images[i] = draw(b.build(), View::Direct);
    }
    for (std::size_t i = 0; i < images[0].rgb.size(); ++i)
        expectNear(images[2].rgb[i], images[0].rgb[i] + images[1].rgb[i], 1e-5f);
}

TEST_F(ViewportViews, ConstantRadianceGivesIrradiancePiFromGridAndLightmap) {
    simple::SceneBuilder b = plane();
    const Scene scene = b.build();
    const glm::vec3 L(1, 2, 0.5f);
    viewport->setIndirect(constantGrid(constantRadiance(L)));
    for (glm::vec3 p : draw(scene, View::Irradiance).rgb)
        expectNear(p, kPi * L, 1e-5f);

    layout = std::make_shared<LightmapLayout>();
    layout->width = layout->height = 4;
    layout->meshes.resize(1);
    layout->instances.resize(1);
    layout->instances[0].uv = {{0.2f, 0.2f}, {0.8f, 0.2f}, {0.8f, 0.8f}, {0.2f, 0.8f}};
    IndirectField field = constantGrid({}, 2);
    field.lightmapWidth = field.lightmapHeight = 4;
    field.lightmap.assign(16 * 9, glm::vec4(0));
    std::fill_n(field.lightmap.begin(), 16, glm::vec4(L * (2 * std::sqrt(kPi)), 0));
    viewport->setIndirect(field);
    for (glm::vec3 p : draw(scene, View::Irradiance).rgb)
        expectNear(p, kPi * L, 1e-5f);
}

TEST_F(ViewportViews, EveryCoefficientGivesTheIrradianceOfItsHarmonic) {
    // E(n) = sum A_l c_i Y_i(n) at the normal n of a tilted plane.
    const glm::mat4 tilt =
        glm::rotate(glm::mat4(1), 0.4f, glm::normalize(glm::vec3(1, 0.2f, 0.7f)));
    const glm::vec3 n(tilt * glm::vec4(0, 1, 0, 0));
    const std::array<float, 9> Y = {0.2820948f,
                                    0.4886025f * n.y,
                                    0.4886025f * n.z,
                                    0.4886025f * n.x,
                                    1.0925484f * n.x * n.y,
                                    1.0925484f * n.y * n.z,
                                    0.3153916f * (3 * n.z * n.z - 1),
                                    1.0925484f * n.x * n.z,
                                    0.5462742f * (n.x * n.x - n.y * n.y)};
    simple::SceneBuilder b = plane();
    b.scene.instances[0].toWorld = tilt;
    b.scene.instances[0].normalToWorld = glm::mat3(tilt);
    const Scene scene = b.build();
    for (std::size_t i = 0; i < 9; ++i) {
        std::array<glm::vec3, 9> c = constantRadiance(glm::vec3(1));
        c[i] += glm::vec3(0.5f, -0.5f, 0);
        viewport->setIndirect(constantGrid(c, i + 1));
        const float A = i == 0 ? kPi : i < 4 ? 2 * kPi / 3 : kPi / 4;
        expectNear(pixel(draw(scene, View::Irradiance), 16, 16),
                   glm::vec3(kPi) + glm::vec3(0.5f, -0.5f, 0) * (A * Y[i]), 1e-4f + 2 * kHalf,
                   std::to_string(i).c_str());
    }
}

TEST_F(ViewportViews, ANegativeFieldIsNoNegativeLight) {
    viewport->setIndirect(constantGrid(constantRadiance(glm::vec3(-1, 1, -2))));
    const Scene scene = plane().build();
    for (View view : {View::Irradiance, View::Indirect, View::Lit})
        for (glm::vec3 p : draw(scene, view).rgb)
            EXPECT_TRUE(p.r >= 0 && p.g > 0 && p.b >= 0);
}

TEST_F(ViewportViews, TheGridIsInterpolatedLinearly) {
    IndirectField field = constantGrid({});
    field.gridSize = {4, 1, 1};
    field.gridBounds = {{-4, -1, -4}, {4, 1, 4}};
    field.grid.assign(4 * 9, glm::vec4(0));
    for (std::uint32_t x = 0; x < 4;
         ++x) // radiance x at x, at the cells' centres -3, -1, 1, 3, plus 10
        field.grid[x] = glm::vec4(glm::vec3(2 * std::sqrt(kPi) * (10 + 2 * float(x) - 3)), 0);
    viewport->setIndirect(field);
    const ImageF image = draw(plane().build(), View::Irradiance);
    for (std::uint32_t x = 0; x < 32; ++x) {
        const float worldX = planePoint(options, x, 16).x;
        expectNear(pixel(image, x, 16), glm::vec3(kPi * (10 + worldX)), 1e-4f + kHalf);
    }
}

TEST_F(ViewportViews, IndirectIsAlbedoOverPiTimesIrradianceAndLitIsTheSumWithEmission) {
    simple::SceneBuilder b = plane();
    b.scene.lights = {pointLight({0, 2, 0}, 30)};
    b.scene.materials[0].emission = {0.1f, 0.2f, 0.3f};
    viewport->setIndirect(constantGrid(constantRadiance(glm::vec3(0.5f))));
    const Scene scene = b.build();
    const ImageF direct = draw(scene, View::Direct), indirect = draw(scene, View::Indirect);
    const ImageF lit = draw(scene, View::Lit);
    for (std::size_t i = 0; i < lit.rgb.size(); ++i) {
        expectNear(indirect.rgb[i], glm::vec3(0.2f, 0.4f, 0.8f) * 0.5f, 1e-4f);
        const glm::vec3 diffuse = direct.rgb[i] + indirect.rgb[i] + glm::vec3(0.1f, 0.2f, 0.3f);
        // Specular reflection of a dielectric only adds, and less than a tenth of what arrives.
        const glm::vec3 arriving = (direct.rgb[i] + indirect.rgb[i]) / glm::vec3(0.2f, 0.4f, 0.8f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(lit.rgb[i][c], diffuse[c]);
            EXPECT_LE(lit.rgb[i][c], diffuse[c] + 0.1f * arriving[c]);
        }
    }
}

TEST_F(ViewportViews, TheBackgroundIsTheSkyInLitAndBlackElsewhere) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({100, 0, 0}, {1, 0, 0}, {0, 0, -1}));
    b.scene.sky.radiance = {1, 2, 300};
    const Scene scene = b.build();
    for (View view :
         {View::Lit, View::Direct, View::Indirect, View::Irradiance, View::Albedo, View::Normals}) {
        const glm::vec3 expected = view == View::Lit ? scene.sky.radiance : glm::vec3(0);
        for (glm::vec3 p : draw(scene, view).rgb)
            EXPECT_EQ(p, expected) << kViewNames[std::size_t(view)];
    }
}

TEST_F(ViewportViews, TheBackgroundShowsGradientAndImageAsSkyRadianceSays) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({-1, -1, 5}, {2, 0, 0}, {0, 2, 0})); // behind the camera
    options.camera = {.eye = {0, 0, 0}, .target = {0.3f, 0.1f, -1}, .fovY = 2};
    ImageF panorama{64, 32, {}};
    for (int i = 0; i < 64 * 32; ++i)
        panorama.rgb.push_back({float(i % 64), float(i / 64), 63});
    const Sky gradient{.kind = SkyKind::Gradient,
                       .radiance = {4, 2, 1},
                       .horizon = {0.5f, 1, 3},
                       .ground = {0, 0, 9}};
    const Sky image{
        .kind = SkyKind::Image, .strength = 2, .rotation = 2, .panorama = makeSkyImage(panorama)};
    for (const Sky& sky : {gradient, image, gradient}) {
        b.scene.sky = sky;
        const ImageF drawn = draw(b.build(), View::Lit);
        int apart = 0;
        for (std::uint32_t y = 0; y < 32; ++y)
            for (std::uint32_t x = 0; x < 32; ++x) {
                const glm::vec3 d = rayDirection(options.camera, 1, (float(x) + 0.5f) / 16 - 1,
                                                 1 - (float(y) + 0.5f) / 16);
                const glm::vec3 off = pixel(drawn, x, y) - skyRadiance(sky, glm::normalize(d));
                // Of 63 * 2, half a step of RGB9E5 is an eighth.
                apart += glm::length(off) > (sky.kind == SkyKind::Image ? 0.25f : 1e-5f);
            }
        EXPECT_LE(apart, sky.kind == SkyKind::Image ? 4 : 0)
            << "but for rays through pixels' edges";
    }
}

TEST_F(ViewportViews, NormalsAreThoseOfTheWorldMappedFromMinusOneToOne) {
    const glm::vec3 n = glm::normalize(glm::vec3(0.3f, 1, -0.2f));
    simple::SceneBuilder b = plane();
    b.assets->meshes[0].normals.assign(4, n);
    expectNear(pixel(draw(b.build(), View::Normals), 5, 20), n * 0.5f + 0.5f, 1e-5f);
}

TEST_F(ViewportViews, MetalsHaveNoAlbedoAndNoneExceedsItsLimit) {
    simple::SceneBuilder b = plane(glm::vec3(1, 0.5f, 1));
    b.scene.materials[0].metallic = 0.25f;
    expectNear(pixel(draw(b.build(), View::Albedo), 9, 9), {0.75f, 0.375f, 0.75f}, 1e-5f);
    b.scene.materials[0].metallic = 0;
    expectNear(pixel(draw(b.build(), View::Albedo), 9, 9), {0.99f, 0.5f, 0.99f}, 1e-5f);
}

TEST_F(ViewportViews, AlbedoFollowsTextureTransformWrapAndVertexColourAsTheTracerDoes) {
    simple::SceneBuilder b = plane(glm::vec3(0.9f));
    Image image{.name = "checker", .width = 4, .height = 4, .rgba = {}};
    for (std::uint32_t i = 0; i < 16; ++i) {
        const auto v = [&](std::uint32_t k) { return std::uint8_t((i * 37 + k * 91) % 256); };
        image.rgba.insert(image.rgba.end(), {v(0), v(1), v(2), 255});
    }
    b.assets->images.push_back(image);
    b.assets->meshes[0].colors.assign(4, {0.5f, 1, 0.75f, 1});
    TextureRef& t = b.scene.materials[0].baseColorTexture;
    t = {.image = 0, .offset = {0.1f, 0.3f}, .scale = {1.5f, 0.7f}, .rotation = 0.6f};
    t.wrapU = Wrap::Mirror;
    t.nearest = true;
    options.width = options.height = 64;
    const Scene scene = b.build();
    const ImageF drawn = draw(scene, View::Albedo);
    int different = 0;
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) {
            const glm::vec3 p = planePoint(options, x, y);
            const float u = (p.x + 10) / 20, v = (10 - p.z) / 20; // of the quad
            const bool first = u >= v;                            // triangles (0,1,2) and (0,2,3)
            const SurfaceMaterial m = first
                                          ? surfaceMaterial(scene, scene.instances[0], 0, u - v, v)
                                          : surfaceMaterial(scene, scene.instances[0], 1, u, v - u);
            different += glm::length(pixel(drawn, x, y) - m.albedo) > 0.01f;
        }
    // Nearest texels differ where a pixel's middle meets a texel's edge.
    EXPECT_LE(different, 64 * 64 / 50);
}

TEST_F(ViewportViews, ANormalMapTiltsTheNormalTowardsTheTangent) {
    simple::SceneBuilder b = plane();
    b.assets->meshes[0].tangents.assign(4, {1, 0, 0, 1});
    // (0.6, 0, 0.8) as 8 bits: tangent +x, bitangent cross(n, t) = -z, normal +y.
    b.assets->images.push_back({"bump", 1, 1, {204, 128, 230, 255}});
    b.scene.materials[0].normalTexture.image = 0;
    const glm::vec3 n = pixel(draw(b.build(), View::Normals), 16, 16) * 2.f - 1.f;
    EXPECT_NEAR(n.x, 0.6f, 0.01f);
    EXPECT_NEAR(n.y, 0.8f, 0.01f);
    EXPECT_NEAR(n.z, 0, 0.01f);
}

TEST_F(ViewportViews, AlphaMasksCutHoles) {
    simple::SceneBuilder b = plane();
    b.assets->images.push_back({"mask", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    Material& m = b.scene.materials[0];
    m.alphaMode = AlphaMode::Mask;
    m.baseColorTexture = {.image = 0, .nearest = true}; // u < 0.5 is kept: x < 0
    const ImageF image = draw(b.build(), View::Albedo);
    expectNear(pixel(image, 4, 16), {0.2f, 0.4f, 0.8f}, 1e-5f);
    EXPECT_EQ(pixel(image, 28, 16), glm::vec3(0));
}

TEST_F(ViewportViews, TheBackOfAOneSidedSurfaceIsBlackAndOfATwoSidedOneLit) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.addMaterial(simple::lambert(glm::vec3(0.25f)));
    b.add(simple::quad({-10, 1, -10}, {20, 0, 0}, {0, 0, 20}, 0)); // faces down, above the other
    b.add(simple::quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}, 1));
    const auto albedo = [&] { return pixel(draw(b.build(), View::Albedo), 16, 16).r; };
    EXPECT_FLOAT_EQ(albedo(), 0);
    b.scene.materials[0].doubleSided = true;
    EXPECT_FLOAT_EQ(albedo(), 0.5f);
    b.scene.lights = {pointLight({0, 3, 0}, kPi)};
    EXPECT_NEAR(pixel(draw(b.build(), View::Direct), 16, 16).r, 0.5f / 4, 2e-3f);
}

TEST_F(ViewportViews, AMirroredInstanceKeepsItsFrontOutside) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    const std::uint32_t mesh = b.addMesh(simple::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    b.addInstance(mesh, glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1)));
    b.scene.lights = {pointLight({0, 2, 0}, 4 * kPi)};
    const Scene scene = b.build();
    EXPECT_NEAR(pixel(draw(scene, View::Direct), 16, 16).r, 0.5f, 2e-3f);
    expectNear(pixel(draw(scene, View::Normals), 16, 16), {0.5f, 1, 0.5f}, 1e-5f);
}

TEST_F(ViewportViews, VertexNormalsAreMirroredWithTheirInstanceAndTurnedOnTheBack) {
    const glm::vec3 n = glm::normalize(glm::vec3(0.3f, 1, -0.2f));
    simple::SceneBuilder b = plane();
    b.assets->meshes[0].normals.assign(4, n);
    b.scene.instances[0].toWorld = glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1));
    expectNear(pixel(draw(b.build(), View::Normals), 16, 16),
               glm::vec3(-n.x, n.y, n.z) * 0.5f + 0.5f, 1e-5f);
    b.scene.instances[0].toWorld = glm::scale(glm::mat4(1), glm::vec3(1, -1, 1));
    b.scene.materials[0].doubleSided = true; // its front looks down now
    expectNear(pixel(draw(b.build(), View::Normals), 16, 16),
               glm::vec3(-n.x, n.y, -n.z) * 0.5f + 0.5f, 1e-5f);
}

class ViewportLife : public ViewportTest {};

TEST_F(ViewportLife, AnEmptySceneIsTheSky) {
    Scene scene;
    scene.assets = std::make_shared<Assets>();
    scene.sky.radiance = {0.25f, 0.5f, 1};
    for (glm::vec3 p : draw(scene, View::Lit).rgb)
        EXPECT_EQ(p, scene.sky.radiance);
    scene.lights = {pointLight({0, 1, 0}, 5)};
    Light sun;
    sun.kind = LightKind::Directional;
    scene.lights.push_back(sun);
    EXPECT_TRUE(isFinite(draw(scene, View::Lit)));
}

TEST_F(ViewportLife, OneTriangleIsAScene) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    Mesh m;
    m.positions = {{-1, 0, 1}, {1, 0, 1}, {0, 0, -1}};
    m.normals.assign(3, {0, 1, 0});
    m.indices = {0, 1, 2};
    b.add(m);
    b.scene.lights = {pointLight({0, 2, 0}, 4 * kPi)};
    EXPECT_NEAR(pixel(draw(b.build(), View::Direct), 16, 16).r, 0.5f, 5e-3f);
}

TEST_F(ViewportLife, EmptyMeshesAreNotDrawn) {
    simple::SceneBuilder b = plane();
    b.add(Mesh{});
    EXPECT_TRUE(isFinite(draw(b.build(), View::Lit)));
}

TEST_F(ViewportLife, LightsOfAnyStrengthAndPlaceGiveFiniteNumbers) {
    for (float strength : {1e-6f, 1.f, 1e6f})
        for (float height : {-1.f, 0.f, 1e-6f, 1e-3f, 1e4f}) {
            simple::SceneBuilder b = plane();
            b.scene.materials[0].roughness = 0;
            b.scene.lights = {pointLight({0, height, 0}, strength)};
            b.scene.lights.push_back(b.scene.lights[0]);
            b.scene.lights[1].kind = LightKind::Spot;
            b.scene.lights.push_back(b.scene.lights[0]);
            b.scene.lights[2].kind = LightKind::Directional;
            for (const float size : {kMinLightSize, 1.f, kMaxLightSize}) {
                b.scene.lights.push_back(b.scene.lights[0]);
                b.scene.lights.back().kind = LightKind::Rectangle;
                b.scene.lights.back().size = {size, 1};
            }
            const ImageF image = draw(b.build(), View::Lit);
            EXPECT_TRUE(isFinite(image)) << strength << " at " << height;
        }
}

TEST_F(ViewportLife, ScenesOfAnySizeLookTheSame) {
    for (float scale : {1e-3f, 1.f, 1e4f}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        const std::uint32_t mesh = b.addMesh(simple::quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}));
        b.addInstance(mesh, glm::scale(glm::mat4(1), glm::vec3(scale)));
        b.scene.lights = {pointLight(glm::vec3(0, 2, 0) * scale, 4 * kPi * scale * scale)};
        options.camera.eye = glm::vec3(0, 5, 0) * scale;
        EXPECT_NEAR(pixel(draw(b.build(), View::Direct), 16, 16).r, 0.5f, 2e-3f) << scale;
    }
}

TEST_F(ViewportLife, TheSizeMayChangeEveryFrameAndThePictureFillsIt) {
    simple::SceneBuilder b = plane();
    viewport->setScene(b.build(), nullptr);
    options.view = View::Albedo;
    options.width = options.height = 300;
    viewport->render(options);
    const VkImageView view = viewport->colorView();
    std::mt19937 random(3);
    for (int i = 0; i < 20; ++i) {
        options.width = 1 + std::uint32_t(random() % 300);
        options.height = 1 + std::uint32_t(random() % 300);
        viewport->render(options);
        EXPECT_EQ(viewport->colorView(), view) << "a smaller size needs no new image";
        const ImageF image = viewport->readLinear();
        ASSERT_EQ(image.rgb.size(), std::size_t(options.width) * options.height);
        for (glm::vec3 p : {image.rgb.front(), image.rgb.back()})
            expectNear(p, {0.2f, 0.4f, 0.8f}, 1e-5f);
    }
    EXPECT_EQ(viewport->readTonemapped().rgba.size(),
              std::size_t(options.width) * options.height * 4);
}

TEST_F(ViewportLife, SettingScenesAgainAndAgainKeepsNoMemory) {
    std::uint64_t bytes = 0;
    options.view = View::Lit;
    for (int i = 0; i < 30; ++i) {
        simple::SceneBuilder b = plane();
        b.assets->images.push_back({"white", 1, 1, {255, 255, 255, 255}});
        b.scene.materials[0].baseColorTexture.image = 0;
        b.scene.lights = {pointLight({0, 2, 0}, float(i + 1))};
        viewport->setIndirect(constantGrid(constantRadiance(glm::vec3(1)), std::uint64_t(i + 1)));
        viewport->setScene(b.build(), nullptr);
        viewport->render(options);
        viewport->render(options);
        device->waitIdle();
        if (i == 2)
            bytes = viewport->stats().gpuBytes;
        if (i > 2) {
            ASSERT_EQ(viewport->stats().gpuBytes, bytes) << "scene " << i;
        }
    }
}

TEST_F(ViewportLife, MovingAnInstanceMovesItsPictureWithoutAnotherUpload) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1}));
    Scene scene = b.build();
    EXPECT_FLOAT_EQ(pixel(draw(scene, View::Albedo), 16, 16).r, 0.5f);
    const std::uint64_t bytes = viewport->stats().gpuBytes;
    scene.instances[0].toWorld = glm::translate(glm::mat4(1), glm::vec3(1.2f, 0, 0));
    scene.bounds = {{0.7f, 0, -0.5f}, {1.7f, 0, 0.5f}};
    const ImageF image = draw(scene, View::Albedo);
    EXPECT_EQ(pixel(image, 16, 16).r, 0);
    EXPECT_FLOAT_EQ(pixel(image, 26, 16).r, 0.5f);
    EXPECT_EQ(viewport->stats().gpuBytes, bytes);
}

TEST_F(ViewportLife, EditingAMaterialShowsInTheNextFrameOnly) {
    simple::SceneBuilder b = plane();
    Scene scene = b.build();
    viewport->setScene(scene, nullptr);
    options.view = View::Albedo;
    viewport->render(options);
    scene.materials[0].baseColor = {0.5f, 0.5f, 0.5f, 1};
    viewport->setLighting(scene);
    expectNear(pixel(viewport->readLinear(), 3, 3), {0.2f, 0.4f, 0.8f}, 1e-5f);
    viewport->render(options);
    expectNear(pixel(viewport->readLinear(), 3, 3), glm::vec3(0.5f), 1e-5f);
}

TEST_F(ViewportLife, ALayoutThatDoesNotFitTheSceneIsLeftOut) {
    layout = std::make_shared<LightmapLayout>();
    layout->width = layout->height = 4;
    layout->meshes.resize(1);
    layout->instances.resize(1);
    layout->instances[0].uv.resize(3); // the quad has four vertices
    viewport->setIndirect(constantGrid(constantRadiance(glm::vec3(1))));
    expectNear(pixel(draw(plane().build(), View::Irradiance), 16, 16), glm::vec3(kPi), 1e-5f);
}

TEST_F(ViewportLife, ChartsMayCutVerticesApart) {
    simple::SceneBuilder b = plane();
    layout = std::make_shared<LightmapLayout>();
    layout->width = 2;
    layout->height = 1;
    layout->meshes.resize(1);
    layout->meshes[0].sourceVertex = {0, 1, 2, 0, 2, 3};
    layout->meshes[0].indices = {0, 1, 2, 3, 4, 5};
    layout->instances.resize(1);
    // The first triangle lies in texel 0, the second in texel 1.
    layout->instances[0].uv.assign(6, {0.25f, 0.5f});
    std::fill_n(layout->instances[0].uv.begin() + 3, 3, glm::vec2(0.75f, 0.5f));
    IndirectField field;
    field.version = 1;
    field.lightmapWidth = 2;
    field.lightmapHeight = 1;
    field.lightmap.assign(2 * 9, glm::vec4(0));
    field.lightmap[0] = glm::vec4(glm::vec3(2 * std::sqrt(kPi)), 0);
    field.lightmap[1] = glm::vec4(glm::vec3(6 * std::sqrt(kPi)), 0);
    viewport->setIndirect(field);
    const ImageF image = draw(b.build(), View::Irradiance);
    expectNear(pixel(image, 24, 24), glm::vec3(kPi),
               1e-4f + kHalf); // x > 0, z > 0: below the diagonal
    expectNear(pixel(image, 4, 4), glm::vec3(3 * kPi), 1e-4f + kHalf);
}

} // namespace limn::viewport_test
