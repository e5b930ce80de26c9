// SPDX-License-Identifier: MIT
// The reference shares surface points, direct light, emitters and the sky with the pictures that it
// judges. So all of these are held here to closed forms, each through whatever uses it.
#include "engine/reference/reference.h"

#include "engine/shading/direct_light.h"
#include "engine/shading/incident_light.h"
#include "engine/trace/direct_light.h"
#include "tests/shading/light_formulas.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::closed_forms_test {
namespace {

using namespace simple;
using formulas::kPi;

const glm::vec3 kAlbedo(0.8f, 0.4f, 0.2f);

/// The ground y = 0 and whatever is added to it.
struct World : SceneBuilder {
    World() {
        addMaterial(lambert(kAlbedo));
        add(quad({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}));
    }
};

struct Receiver {
    glm::vec3 position, normal;

    SurfacePoint surface() const {
        return {.position = position, .geometricNormal = normal, .normal = normal};
    }
};

/// Points on the ground, and in the air with tilted normals.
std::vector<Receiver> receivers() {
    return {{{0.1f, 0, 0.2f}, {0, 1, 0}},
            {{-1.3f, 0, 0.7f}, {0, 1, 0}},
            {{0.4f, 0.3f, -0.5f}, glm::normalize(glm::vec3(0.3f, 1, -0.2f))},
            {{-0.6f, 0.5f, 0.2f}, glm::normalize(glm::vec3(0.2f, 1, 0.25f))}};
}

/// Mean of a function of a sampler's index.
template <class Sample>
glm::dvec3 meanOver(std::uint32_t count, const Sample& sample) {
    glm::dvec3 sum(0);
    for (std::uint32_t i = 0; i < count; ++i)
        sum += glm::dvec3(sample(Sampler{7, i}));
    return sum / double(count);
}

/// Expects `truth` times the light's colour of all that computes direct light at a point.
void expectDirect(const TraceScene& trace, const Light& light, const Receiver& receiver,
                  double truth) {
    const glm::dvec3 expected = truth * glm::dvec3(light.color);
    const auto expectNear = [&](glm::dvec3 value, double tolerance, const char* what) {
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(value[k], expected[k], tolerance * expected[k] + 1e-7) << what;
    };
    const bool area = light.kind == LightKind::Rectangle;
    // Sampled points of a rectangle are stratified: the error of 4096 is far below 1 / 64.
    const std::uint32_t samples = area ? 4096 : 1;
    const double tolerance = area ? 2e-3 : 1e-5;
    std::uint64_t rays = 0;
    expectNear(glm::dvec3(directIrradiance(trace, receiver.surface(), rays)), 1e-5,
               "directIrradiance");
    expectNear(meanOver(samples,
                        [&](const Sampler& s) {
                            return sampleDirectLightFrom(trace, receiver.surface(), light,
                                                         s.pair(0), rays)
                                .irradiance;
                        }),
               tolerance, "sampleDirectLightFrom");
    expectNear(meanOver(samples,
                        [&](const Sampler& s) {
                            return sampleDirectLight(trace, receiver.surface(), s.pair(1).x,
                                                     s.pair(0), rays)
                                .irradiance;
                        }),
               tolerance, "sampleDirectLight");
    const LitPoint lit{trace.clearOf(receiver.position, receiver.normal), receiver.normal, {}};
    // From beside the surface by the offset of shadow rays, some 1e-5 m.
    expectNear(glm::dvec3(shadowedLight(trace, light, lit, 16, rays)), 1e-4, "shadowedLight");
    expectNear(
        glm::dvec3(referenceIrradiance(trace, receiver.position, receiver.normal, 1, 0, true, 1)),
        1e-5, "referenceIrradiance");
    if (receiver.position.y > 0)
        return;
    ReferenceOptions o;
    o.view = View::Direct;
    o.camera = {.eye = receiver.position + glm::vec3(0.01f, 0.2f, 0), .target = receiver.position};
    o.camera.fovY = 1e-3f;
    o.width = o.height = area ? 4 : 1;
    o.samplesPerPixel = area ? 256 : 4;
    glm::dvec3 sum(0);
    for (const glm::vec3 c : renderReference(trace, o).image.rgb)
        sum += glm::dvec3(c / kAlbedo) * kPi / double(o.width * o.height);
    expectNear(sum, area ? 4e-3 : 1e-4, "renderReference");
}

void expectPunctual(const Light& light) {
    World w;
    w.scene.lights = {light};
    const TraceScene trace(w.build());
    for (const Receiver& receiver : receivers())
        expectDirect(trace, light, receiver,
                     formulas::punctualIrradiance(light, glm::dvec3(receiver.position),
                                                  glm::dvec3(receiver.normal)));
}

Light lamp(LightKind kind) {
    Light light;
    light.kind = kind;
    light.position = {0.6f, 1.5f, 0.3f};
    light.direction = glm::normalize(glm::vec3(-0.3f, -1, -0.1f));
    light.color = {1, 0.5f, 0.25f};
    light.strength = 7;
    return light;
}

TEST(ClosedForms, ASunGivesItsIrradianceTimesTheCosine) {
    expectPunctual(lamp(LightKind::Directional));
}

TEST(ClosedForms, APointLightGivesItsIntensityTimesTheCosineOverTheSquaredDistance) {
    expectPunctual(lamp(LightKind::Point));
}

TEST(ClosedForms, APointLightWithARangeIsWindowed) {
    Light light = lamp(LightKind::Point);
    light.range = 1.8f; // the second point is beyond it
    expectPunctual(light);
}

TEST(ClosedForms, ASpotFadesBetweenItsCones) {
    Light light = lamp(LightKind::Spot);
    for (const auto& [inner, outer] :
         {std::pair(0.05f, 0.5f), std::pair(0.f, 1.2f), std::pair(0.7f, 0.8f)}) {
        light.innerAngle = inner;
        light.outerAngle = outer;
        expectPunctual(light);
    }
    light.range = 3;
    expectPunctual(light);
}

Light panel() {
    Light light = lamp(LightKind::Rectangle);
    light.size = {1.4f, 0.6f};
    return light;
}

TEST(ClosedForms, ARectangleGivesLambertsPolygon) {
    for (const glm::vec3 direction :
         {glm::vec3(0, -1, 0), glm::normalize(glm::vec3(-0.3f, -1, -0.1f))})
        for (const float roll : {0.f, 0.4f}) {
            Light light = panel();
            light.direction = direction;
            light.roll = roll;
            World w;
            w.scene.lights = {light};
            const TraceScene trace(w.build());
            for (const Receiver& receiver : receivers()) {
                const auto corners = formulas::cornersOf(light, glm::dvec3(receiver.position));
                for (const glm::dvec3 c : corners)
                    ASSERT_GT(glm::dot(c, glm::dvec3(receiver.normal)), 0);
                expectDirect(trace, light, receiver,
                             7 * formulas::polygonIrradiance(corners, glm::dvec3(receiver.normal)));
            }
        }
}

TEST(ClosedForms, ARectangleIsCutOffAtTheHorizonAndDarkFromBehind) {
    Light light = panel();
    light.position = {0, 1.5f, 0};
    light.direction = {0, -1, 0};
    light.size = {2, 1};
    World w;
    w.scene.lights = {light};
    const TraceScene trace(w.build());
    const glm::dvec3 n(1, 0, 0); // sees what lies at x > 0.25
    const Receiver wall{{0.25f, 0.5f, 0.1f}, glm::vec3(n)};
    Light above = light;
    above.size.x = 0.75f;
    above.position.x = 0.625f;
    const auto corners = formulas::cornersOf(above, glm::dvec3(wall.position));
    expectDirect(trace, light, wall, 7 * formulas::polygonIrradiance(corners, n));
    expectDirect(trace, light, {{0.25f, 1.7f, 0.1f}, {0, -1, 0}}, 0);
}

// A screen's edge hides one half of the light: what is left is the polygon of the other half.
TEST(ClosedForms, HalfARectangleIsLeftBehindAScreen) {
    Light light = panel();
    light.position = {0, 2, 0};
    light.direction = {0, -1, 0};
    World w;
    w.add(quad({0, 1, -4}, {0, 0, 8}, {4, 0, 0}));
    w.scene.lights = {light};
    const TraceScene trace(w.build());
    Light half = light;
    half.size.x /= 2;
    half.position.x = -half.size.x / 2;
    const Receiver ground{{0, 0, 0.1f}, {0, 1, 0}};
    const double truth = 7 * formulas::polygonIrradiance(
                                 formulas::cornersOf(half, glm::dvec3(ground.position)), {0, 1, 0});
    std::uint64_t rays = 0;
    // The edge parts 64 points as it does the light.
    EXPECT_NEAR(double(directIrradiance(trace, ground.surface(), rays).x), truth, 0.01 * truth);
    const glm::dvec3 sampled = meanOver(4096, [&](const Sampler& s) {
        return sampleDirectLightFrom(trace, ground.surface(), light, s.pair(0), rays).irradiance;
    });
    EXPECT_NEAR(sampled.x, truth, 2e-3 * truth);
}

TEST(ClosedForms, OtherLightsAreBlackInTheShadowOfAScreen) {
    for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
        Light light = lamp(kind);
        light.position = {0, 2, 0};
        light.direction = {0, -1, 0};
        World w;
        w.add(quad({0, 1, -4}, {0, 0, 8}, {4, 0, 0}));
        w.scene.lights = {light};
        const TraceScene trace(w.build());
        for (const float x : {-0.2f, 0.2f}) {
            const Receiver receiver{{x, 0, 0.1f}, {0, 1, 0}};
            const double open = formulas::punctualIrradiance(light, glm::dvec3(receiver.position),
                                                             glm::dvec3(receiver.normal));
            ASSERT_GT(open, 1);
            expectDirect(trace, light, receiver, x < 0 ? open : 0);
        }
    }
}

// One light of many is picked, in proportion to what it would give without shadows.
TEST(ClosedForms, ManyLightsAddUp) {
    World w;
    w.scene.lights = {lamp(LightKind::Point), lamp(LightKind::Directional), panel()};
    w.scene.lights[0].enabled = false;
    w.scene.lights.push_back(lamp(LightKind::Point));
    w.scene.lights[3].position = {-1, 0.7f, 0};
    w.scene.lights[3].color = {0, 1, 3};
    const Scene scene = w.build();
    const TraceScene trace(scene);
    for (const Receiver& receiver : receivers()) {
        const glm::dvec3 p(receiver.position), n(receiver.normal);
        glm::dvec3 truth(0);
        for (const std::size_t i : {1, 2, 3}) {
            const Light& l = scene.lights[i];
            truth += glm::dvec3(l.color) *
                     (i == 2 ? 7 * formulas::polygonIrradiance(formulas::cornersOf(l, p), n)
                             : formulas::punctualIrradiance(l, p, n));
        }
        std::uint64_t rays = 0;
        EXPECT_LT(
            glm::length(glm::dvec3(directIrradiance(trace, receiver.surface(), rays)) - truth),
            1e-5 * glm::length(truth));
        const glm::dvec3 sampled = meanOver(4096, [&](const Sampler& s) {
            return sampleDirectLight(trace, receiver.surface(), s.pair(1).x, s.pair(0), rays)
                .irradiance;
        });
        EXPECT_LT(glm::length(sampled - truth), 5e-3 * glm::length(truth));
    }
}

// Interpolated normals lean towards light that the triangle itself hides.
TEST(ClosedForms, NothingComesFromBelowTheTrianglesHorizon) {
    for (const LightKind kind :
         {LightKind::Directional, LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
        Light light = lamp(kind);
        light.position = {1, 0.9f, 0};
        light.direction = glm::normalize(glm::vec3(-1, 0.1f, 0)); // from below
        light.size = glm::vec2(0.1f);
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0), glm::vec3(3)));
        b.add(quad({1, 0.8f, -0.1f}, {0, 0, 0.2f}, {0, 0.1f, 0}));
        b.scene.lights = {light};
        const TraceScene trace(b.build());
        const Emitters emitters = findEmitters(trace);
        std::uint64_t rays = 0;
        for (const bool leaning : {false, true}) {
            const glm::vec3 side(1, 0, 0), up(0, 1, 0);
            const SurfacePoint p{
                .position = {0, 1, 0}, .geometricNormal = leaning ? up : side, .normal = side};
            const bool dark = leaning;
            const auto lit = [](const auto& sample) { return sample.irradiance.x > 0; };
            EXPECT_NE(lit(sampleDirectLightFrom(trace, p, light, {0.5f, 0.5f}, rays)), dark);
            EXPECT_NE(lit(sampleEmitterLight(trace, emitters, p, 0.5f, {0.5f, 0.5f}, rays)), dark);
            EXPECT_NE(directIrradiance(trace, p, rays).x > 0, dark);
        }
    }
}

/// A constant sky above a plane with normals tilted by 40 degrees: what the tilted cosine leaves of
/// the hemisphere above the triangle is (1 + cos 40 degrees) / 2 of all, whatever the map says.
TEST(ClosedForms, AMappedNormalSeesTheSkyAboveItsTriangle) {
    SceneBuilder b;
    Material m = lambert(glm::vec3(0.5f));
    m.normalTexture.image = 0;
    b.addMaterial(m);
    Mesh mesh = quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    b.add(mesh);
    const double tilt = kPi * 40 / 180;
    const auto byte = [](double v) { return std::uint8_t(std::lround((v + 1) * 127.5)); };
    b.assets->images.push_back(
        {"tilted", 1, 1, {byte(std::sin(tilt)), byte(0), byte(std::cos(tilt)), 255}});
    b.scene.sky.radiance = {1, 2, 3};
    const Scene scene = b.build();
    const TraceScene trace(scene);
    const Emitters emitters = findEmitters(trace);
    const SkyLight sky = findSkyLight(scene.sky);
    const Hit hit = trace.closestHit({{0.3f, 1, 0.2f}, {0, -1, 0}});
    const SurfacePoint p = *surfacePoint(trace, hit);
    EXPECT_NEAR(double(p.normal.x), std::sin(tilt), 0.01);
    EXPECT_EQ(surfacePoint(trace, hit, NormalDetail::Mesh)->normal, glm::vec3(0, 1, 0));
    const glm::dvec3 E = meanOver(1 << 14, [&](const Sampler& s) {
        std::uint64_t rays = 0;
        return sampleIndirectIrradiance({trace, emitters, sky}, p, s, rays);
    });
    const double cosine = double(p.normal.y);
    EXPECT_NEAR(E.y, 2 * kPi * (1 + cosine) / 2, 0.01 * 2 * kPi);
}

TEST(ClosedForms, NoSkyComesFromBelowTheTrianglesHorizon) {
    ImageF image{16, 8, std::vector<glm::vec3>(128, glm::vec3(0))};
    image.rgb[4 * 16 + 12] = glm::vec3(1); // just below the horizon, towards +X
    Scene scene;
    scene.sky = {.kind = SkyKind::Image, .image = "x", .panorama = makeSkyImage(image)};
    const TraceScene trace(scene);
    const SkyLight sky = findSkyLight(scene.sky);
    std::uint64_t rays = 0;
    SurfacePoint p{.geometricNormal = {1, 0, 0}, .normal = {1, 0, 0}};
    EXPECT_GT(sampleSkyLight(trace, sky, p, {0.5f, 0.5f}, rays).irradiance.x, 0);
    p.geometricNormal = {0, 1, 0};
    EXPECT_EQ(sampleSkyLight(trace, sky, p, {0.5f, 0.5f}, rays).irradiance.x, 0);
}

double irradianceAt(const TraceScene& trace, const Receiver& receiver, std::uint32_t samples) {
    return double(
        referenceIrradiance(trace, receiver.position, receiver.normal, samples, 1, false, 1).x);
}

// The sky alone, of which a plane sees one half.
TEST(ClosedForms, AConstantSkyGivesPiTimesItsRadianceFromAllSides) {
    Scene scene;
    scene.sky.radiance = {2, 3, 4};
    const TraceScene trace(scene);
    for (const Receiver& receiver : receivers())
        EXPECT_NEAR(irradianceAt(trace, receiver, 16), 2 * kPi, 1e-5);
}

// Radiance is h + (z - h) y above the horizon and h + (g - h) |y| below it. The integral of
// y cos over the hemisphere is 2 pi / 3 about the vertical, and of |y| cos 2/3 for each half of the
// one about a horizontal axis.
TEST(ClosedForms, AGradientGivesItsIntegralUpwardsSidewaysAndDownwards) {
    Scene scene;
    scene.sky = {.kind = SkyKind::Gradient,
                 .radiance = glm::vec3(4),
                 .horizon = glm::vec3(1),
                 .ground = glm::vec3(2.5f)};
    const TraceScene trace(scene);
    const double h = 1, z = 4, g = 2.5;
    const auto irradiance = [&](glm::vec3 n) {
        return irradianceAt(trace, {glm::vec3(0), n}, 4096);
    };
    EXPECT_NEAR(irradiance({0, 1, 0}), kPi * h + 2 * kPi / 3 * (z - h), 2e-3);
    EXPECT_NEAR(irradiance({0, -1, 0}), kPi * h + 2 * kPi / 3 * (g - h), 2e-3);
    const double sideways = kPi * h + 2.0 / 3 * (z - h) + 2.0 / 3 * (g - h);
    for (const glm::vec3 n : {glm::vec3(1, 0, 0), glm::vec3(0, 0, -1)})
        EXPECT_NEAR(irradiance(n), sideways, 4e-3);
}

/// Vector irradiance of a pixel of unit radiance in a panorama, turned by `rotation`: the integral
/// of directions over its solid angle. Row 0 is at the zenith; the middle of a row is towards -Z,
/// from where columns go on towards +X.
glm::dvec3 pixelVector(std::uint32_t width, std::uint32_t height, std::uint32_t x, std::uint32_t y,
                       double rotation) {
    const double t0 = kPi * y / height, t1 = kPi * (y + 1) / height; // from the zenith
    const double f0 = 2 * kPi * (double(x) / width - 0.5) - rotation,
                 f1 = f0 + 2 * kPi / width; // from -Z towards +X
    const double squares = (t1 - t0) / 2 - (std::sin(2 * t1) - std::sin(2 * t0)) / 4; // of sines
    return {squares * (std::cos(f0) - std::cos(f1)),
            (f1 - f0) * (std::pow(std::sin(t1), 2) - std::pow(std::sin(t0), 2)) / 2,
            -squares * (std::sin(f1) - std::sin(f0))};
}

TEST(ClosedForms, APixelOfAPanoramaGivesItsVectorIrradiance) {
    constexpr std::uint32_t kWidth = 16, kHeight = 8;
    for (const auto& [x, y] : {std::pair(3U, 1U), std::pair(9U, 2U), std::pair(14U, 6U)})
        for (const float rotation : {0.f, 0.9f}) {
            ImageF image{kWidth, kHeight, std::vector<glm::vec3>(kWidth * kHeight, glm::vec3(0))};
            image.rgb[y * kWidth + x] = glm::vec3(5, 1, 0.5f);
            Scene scene;
            scene.sky = {.kind = SkyKind::Image,
                         .image = "x",
                         .strength = 3,
                         .rotation = rotation,
                         .panorama = makeSkyImage(image)};
            const TraceScene trace(scene);
            const SkyLight sky = findSkyLight(scene.sky);
            const glm::dvec3 V = pixelVector(kWidth, kHeight, x, y, double(rotation));
            // Planes that see all of the pixel, which is less than 0.3 rad from its middle.
            const glm::dvec3 axis = glm::normalize(V),
                             side = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 1, 0.2)));
            for (const glm::dvec3 n :
                 {axis, glm::normalize(axis + side), glm::normalize(axis - side)}) {
                const Receiver receiver{glm::vec3(0), glm::vec3(n)};
                const double truth = 3 * 5 * glm::dot(V, n);
                EXPECT_NEAR(irradianceAt(trace, receiver, 1024), truth, 2e-3 * truth);
                std::uint64_t rays = 0;
                const glm::dvec3 found = meanOver(1024, [&](const Sampler& s) {
                    return sampleSkyLight(trace, sky, receiver.surface(), s.pair(0), rays)
                        .irradiance;
                });
                EXPECT_LT(glm::length(found - truth * glm::dvec3(1, 0.2, 0.1)), 2e-3 * truth);
            }
            ReferenceOptions o;
            o.camera = {.eye = glm::vec3(0), .target = glm::vec3(V), .fovY = 0.1f};
            o.width = o.height = 1;
            o.samplesPerPixel = 2;
            EXPECT_EQ(renderReference(trace, o).image.rgb[0], glm::vec3(15, 3, 1.5f));
        }
}

/// Two triangles of unlike size and radiance, each turned and stretched, the second mirrored.
struct Shards {
    const std::array<glm::vec3, 3> corners{
        {{-0.5f, 0, 0.4f}, {0.6f, 0.1f, 0.3f}, {0, 0.2f, -0.5f}}};
    std::array<glm::mat4, 2> places;
    Scene scene;

    explicit Shards(bool bothSides) {
        const glm::mat4 one(1);
        places[0] = glm::translate(one, glm::vec3(0.3f, 1.2f, 0)) *
                    glm::rotate(one, 2.8f, glm::vec3(1, 0.1f, 0)) *
                    glm::scale(one, glm::vec3(0.8f, 1, 1.3f));
        places[1] = glm::translate(one, glm::vec3(-0.9f, 0.9f, 0.2f)) *
                    glm::rotate(one, 3.f, glm::vec3(1, 0, 0.2f)) *
                    glm::scale(one, glm::vec3(-0.5f, 0.5f, 0.5f));
        SceneBuilder b;
        for (const float radiance : {2.f, 5.f}) {
            Material m = lambert(glm::vec3(0), glm::vec3(radiance));
            m.doubleSided = bothSides;
            b.addMaterial(m);
        }
        for (const std::uint32_t i : {0, 1})
            b.add(flatShaded({corners.begin(), corners.end()}, i), places[i]);
        scene = b.build();
    }
    /// Corners of one in the world, relative to `p`.
    std::vector<glm::dvec3> from(std::size_t i, glm::vec3 p) const {
        std::vector<glm::dvec3> relative;
        for (const glm::vec3 c : corners)
            relative.emplace_back(glm::vec3(places[i] * glm::vec4(c, 1)) - p);
        return relative;
    }
    double truthAt(const Receiver& receiver) const {
        const glm::dvec3 n(receiver.normal);
        return 2 * formulas::polygonIrradiance(from(0, receiver.position), n) +
               5 * formulas::polygonIrradiance(from(1, receiver.position), n);
    }
};

TEST(ClosedForms, EmissiveTrianglesGiveLambertsPolygonFromTheirFront) {
    for (const bool bothSides : {false, true}) {
        const Shards shards(bothSides);
        const TraceScene trace(shards.scene);
        const Emitters emitters = findEmitters(trace);
        ASSERT_EQ(emitters.triangles.size(), 2U);
        // Their fronts face down: points below are lit, those above by two-sided ones alone.
        for (const auto& [receiver, front] :
             {std::pair(Receiver{{0.1f, 0, 0.1f}, {0, 1, 0}}, true),
              std::pair(Receiver{{-0.5f, -0.3f, 0}, glm::normalize(glm::vec3(0.2f, 1, 0.1f))},
                        true),
              std::pair(Receiver{{0, 3, 0}, {0, -1, 0}}, false),
              std::pair(Receiver{{-0.4f, 2.5f, 0.3f}, {0, -1, 0}}, false)}) {
            const double truth = front || bothSides ? shards.truthAt(receiver) : 0;
            EXPECT_NEAR(irradianceAt(trace, receiver, 1 << 14), truth, 4e-3 * truth) << bothSides;
            std::uint64_t rays = 0;
            const SurfacePoint p = receiver.surface();
            const glm::dvec3 found = meanOver(1 << 14, [&](const Sampler& s) {
                return sampleEmitterLight(trace, emitters, p, s.pair(0).x, s.pair(1), rays)
                    .irradiance;
            });
            EXPECT_NEAR(found.x, truth, 4e-3 * truth) << bothSides;
        }
    }
}

} // namespace
} // namespace limn::closed_forms_test
