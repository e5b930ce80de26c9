// SPDX-License-Identifier: MIT
#include "engine/reference/photon.h"

#include "engine/math/fresnel.h"
#include "engine/scene/surface/dielectric.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <glm/gtc/constants.hpp>

namespace limn::photon_test {

using namespace simple;

namespace {

constexpr float kPi = glm::pi<float>();

Light sun(glm::vec3 direction, float strength) {
    Light light;
    light.kind = LightKind::Directional;
    light.direction = glm::normalize(direction);
    light.strength = strength;
    return light;
}

Material mirror(glm::vec3 color) {
    Material m = lambert(color);
    m.metallic = 1;
    m.roughness = 0;
    return m;
}

Material clearGlass(float thickness) {
    Material m = lambert(glm::vec3(1));
    m.transmission = 1;
    m.roughness = 0;
    m.thickness = thickness;
    return m;
}

/// Calls use(hit) for all arrivals of `count` photons, with powers that sum to the flux.
void forEachHit(const TraceScene& trace, std::uint32_t count, std::uint32_t maxBounces,
                const std::function<void(const PhotonHit&)>& use) {
    const LightSources sources = findLightSources(trace);
    std::vector<PhotonHit> hits;
    std::uint64_t rays = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        hits.clear();
        tracePhoton(trace, sources, maxBounces, {17, i}, hits, rays);
        for (PhotonHit& hit : hits) {
            hit.power /= float(count);
            use(hit);
        }
    }
}

/// Flux of some hits, with their number.
struct Flux {
    glm::dvec3 power{0};
    double hits = 0;

    void add(const PhotonHit& hit) {
        power += glm::dvec3(hit.power);
        ++hits;
    }
    /// Checks the flux within three standard deviations of a number that occurs by chance.
    void expectNear(glm::dvec3 expected) const {
        ASSERT_GT(hits, 500);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(power[c] / expected[c], 1, 3 / std::sqrt(hits)) << c;
    }
};

// Power on what a flat mirror of area A lights in the sun: F E A cos.
TEST(Photon, AFlatMirrorSendsOnItsFresnelShareOfTheSun) {
    for (const float angle : {0.6f, 1.1f}) {
        SceneBuilder b;
        const glm::vec3 F0(0.9f, 0.6f, 0.3f);
        b.addMaterial(mirror(F0));
        b.addMaterial(lambert(glm::vec3(0)));
        b.add(quad({-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1}));
        b.add(quad({1.5f, 0, -1}, {0, 0, 2}, {0, 4, 0}, 1)); // faces the mirror
        b.scene.lights = {sun({std::sin(angle), -std::cos(angle), 0}, 3)};
        const TraceScene trace(b.build());
        Flux lit;
        forEachHit(trace, 1 << 17, 0, [&](const PhotonHit& hit) {
            if (hit.isCaustic)
                lit.add(hit);
        });
        const float cosine = std::cos(angle);
        lit.expectNear(glm::dvec3(schlickFresnel(F0, cosine) * (3 * cosine)));
    }
}

/// A sheet or plate of glass of area 1, between a floor and screens above, lit by a narrow spot.
struct LitPane {
    double incident = 0, reflected = 0, transmitted = 0, hits = 0;

    LitPane(Mesh mesh, const Material& glass, float angle) {
        SceneBuilder b;
        b.addMaterial(glass);
        b.addMaterial(lambert(glm::vec3(0)));
        b.add(std::move(mesh));
        b.add(box(glm::vec3(-9), glm::vec3(9), true, 1));
        Light spot;
        spot.kind = LightKind::Spot;
        spot.position = {-3 * std::sin(angle), 3 * std::cos(angle), 0};
        spot.direction = {std::sin(angle), -std::cos(angle), 0};
        spot.innerAngle = 0;
        spot.outerAngle = 0.03f;
        b.scene.lights = {spot};
        const TraceScene trace(b.build());
        forEachHit(trace, 1 << 15, 0, [&](const PhotonHit& hit) {
            const auto power = double(hit.power.x);
            if (hit.isDirect()) {
                incident += power;
                ++hits;
            } else if (std::abs(hit.surface.position.y) > 8.9f ||
                       std::abs(hit.surface.position.x) > 8.9f) {
                (hit.surface.position.y > 0 ? reflected : transmitted) += power;
            }
        });
    }
};

TEST(Photon, ASheetOfGlassDividesWhatArrives) {
    for (const float angle : {0.1f, 0.9f, 1.3f}) {
        const LitPane pane(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), clearGlass(0), angle);
        ASSERT_GT(pane.hits, 32000); // all but those at the edge of the spot, which is dark
        EXPECT_NEAR((pane.reflected + pane.transmitted) / pane.incident, 1, 1e-5);
        const double F = double(fresnelDielectric(std::cos(angle), 1.5f));
        EXPECT_NEAR(pane.reflected / pane.incident, F, 3 * std::sqrt(F / pane.hits));
    }
}

// Light that is reflected to and fro in a plate of clear glass leaves it in all by 2 F / (1 + F) on
// the side it came from. Stokes. 1862
TEST(Photon, APlateOfGlassReflectsFromBothFaces) {
    for (const float angle : {0.1f, 0.9f}) {
        const LitPane plate(box({-2, -0.1f, -2}, {2, 0, 2}, false), clearGlass(1), angle);
        EXPECT_NEAR((plate.reflected + plate.transmitted) / plate.incident, 1, 1e-4);
        const double F = double(fresnelDielectric(std::cos(angle), 1.5f)), R = 2 * F / (1 + F);
        EXPECT_NEAR(plate.reflected / plate.incident, R, 3 * std::sqrt(R / plate.hits)) << angle;
    }
}

// A point light of power Phi in the middle of a sphere of albedo rho: the walls receive rho^k Phi
// after k bounces, and rho / (1 - rho) Phi after all.
TEST(Photon, ASphereReceivesThePowerThatIsLeft) {
    const double rho = 0.6;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(float(rho))));
    b.add(sphere(2, 3, true));
    Light lamp;
    lamp.position = glm::vec3(0);
    lamp.strength = 5;
    b.scene.lights = {lamp};
    const TraceScene trace(b.build());
    const double Phi = 4 * double(kPi) * 5;
    double first = 0, all = 0;
    constexpr std::uint32_t kCount = 1 << 14;
    forEachHit(trace, kCount, 1000, [&](const PhotonHit& hit) {
        const double power = double(hit.power.x * hit.shadingRatio());
        first += hit.bounces == 1 ? power : 0;
        all += hit.bounces > 0 ? power : 0;
    });
    EXPECT_NEAR(first / (rho * Phi), 1, 3 * std::sqrt((1 - rho) / rho / kCount));
    EXPECT_NEAR(all / (rho / (1 - rho) * Phi), 1, 3 / std::sqrt(rho * kCount) * 2);
}

/// Inner wall of a ring about the vertical axis, with smooth normals.
Mesh ring(float radius, float height, int sides) {
    Mesh m;
    for (int i = 0; i <= sides; ++i) {
        const float phi = 2 * kPi * float(i) / float(sides);
        const glm::vec3 out(std::cos(phi), 0, std::sin(phi));
        for (const float y : {0.f, height}) {
            m.positions.push_back(radius * out + glm::vec3(0, y, 0));
            m.normals.push_back(-out);
        }
        if (i == 0)
            continue;
        const auto k = std::uint32_t(2 * i);
        m.indices.insert(m.indices.end(), {k - 2, k, k - 1, k - 1, k, k + 1});
    }
    return m;
}

// Parallel rays that a ring mirrors touch a curve with a cusp halfway between the axis and the wall
// away from the sun, which is the focus of a concave mirror.
TEST(Photon, ARingInTheSunMakesACuspHalfwayToItsWall) {
    constexpr float kRadius = 1, kElevation = 0.65f;
    constexpr int kCells = 32;
    SceneBuilder b;
    b.addMaterial(mirror(glm::vec3(0.9f)));
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(ring(kRadius, 0.6f, 128));
    b.add(quad({-1.2f, 0, 1.2f}, {2.4f, 0, 0}, {0, 0, -2.4f}, 1));
    b.scene.lights = {sun({std::cos(kElevation), -std::sin(kElevation), 0}, 1)};
    const TraceScene trace(b.build());
    std::vector<double> cells(kCells * kCells, 0.0);
    forEachHit(trace, 1 << 18, 0, [&](const PhotonHit& hit) {
        if (!hit.isCaustic || hit.surface.position.y > 0.01f)
            return;
        const glm::ivec2 cell(
            (glm::vec2(hit.surface.position.x, hit.surface.position.z) / kRadius + 1.f) *
            (0.5f * kCells));
        if (cell.x >= 0 && cell.x < kCells && cell.y >= 0 && cell.y < kCells)
            cells[std::size_t(cell.y * kCells + cell.x)] += double(hit.power.x);
    });
    const auto brightest = int(std::ranges::max_element(cells) - cells.begin());
    const float x = (float(brightest % kCells) + 0.5f) * 2 / kCells - 1,
                z = (float(brightest / kCells) + 0.5f) * 2 / kCells - 1;
    EXPECT_NEAR(x, kRadius / 2, 2 * 2.f / kCells);
    EXPECT_NEAR(z, 0, 2 * 2.f / kCells);
}

TEST(Photon, LightsThatAreBlackHugeOrBuriedGiveNoNan) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(-1), glm::vec3(1), true));
    Light black, huge, buried;
    black.color = glm::vec3(0);
    huge.color = glm::vec3(kMaxLight);
    huge.strength = kMaxLight;
    buried.position = {0, -1, 0}; // in the floor's plane
    const Scene scene = b.build();
    for (const Light& light : {black, huge, buried}) {
        Scene lit = scene;
        lit.lights = {light};
        const TraceScene trace(lit);
        if (findLightSources(trace).empty())
            continue;
        forEachHit(trace, 256, 10, [](const PhotonHit& hit) {
            EXPECT_TRUE(std::isfinite(channelSum(hit.power)));
            EXPECT_TRUE(std::isfinite(hit.shadingRatio()));
        });
    }
    EXPECT_TRUE(findLightSources(TraceScene(scene)).empty());
    EXPECT_TRUE(findLightSources(TraceScene(Scene{})).empty());
}

} // namespace
} // namespace limn::photon_test
