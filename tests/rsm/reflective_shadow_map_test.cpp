// SPDX-License-Identifier: MIT
#include "engine/rsm/reflective_shadow_map.h"

#include "engine/core/parallel.h"
#include "engine/scene/light/unit_light.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

namespace limn::reflective_shadow_map_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A box of 4 x 3 x 5 m, seen from within, of albedo 0.5.
Scene room() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f, 0.25f, 0)));
    b.add(simple::box(glm::vec3(-2, 0, -2), glm::vec3(2, 3, 3), true));
    return b.build();
}

double incident(const ReflectiveShadowMap& map) {
    double sum = 0;
    for (const RsmTexel& texel : map.texels)
        sum += double(texel.incident);
    return sum;
}

ReflectiveShadowMap cast(const Scene& scene, const Light& light, std::uint32_t size = 64) {
    return castRsm(TraceScene(scene), scene, light, size);
}

// All of a light's flux falls on the walls of a closed room: 4 pi I.
TEST(ReflectiveShadowMap, OfAPointLightHoldsItsFlux) {
    const Light point{.kind = LightKind::Point, .position = glm::vec3(0.5f, 1, 0)};
    const ReflectiveShadowMap map = cast(room(), point);
    EXPECT_EQ(map.rays, 6U * 64 * 64);
    EXPECT_NEAR(incident(map), 4 * kPi, 4 * kPi * 1e-3);
    for (const RsmTexel& texel : map.texels) {
        EXPECT_EQ(texel.albedo, glm::vec3(0.5f, 0.25f, 0));
        EXPECT_GT(glm::dot(texel.normal, point.position - texel.position), 0);
    }
}

// Within the cone the falloff is ((cos - cosOuter) / (cosInner - cosOuter))^2; about the axis that
// integrates to 2 pi ((1 - cosInner) + (cosInner - cosOuter) / 3).
TEST(ReflectiveShadowMap, OfASpotHoldsTheFluxOfItsCone) {
    for (const float outer : {0.4f, 1.0f, 1.3f, 1.5f}) {
        const Light spot{.kind = LightKind::Spot,
                         .position = glm::vec3(0, 1, 0),
                         .direction = glm::normalize(glm::vec3(1, -0.5f, 0.3f)),
                         .innerAngle = 0.2f,
                         .outerAngle = outer};
        const double inner = std::cos(0.2), edge = std::cos(double(outer));
        const double flux = 2 * kPi * (1 - inner + (inner - edge) / 3);
        EXPECT_NEAR(incident(cast(room(), spot)), flux, flux * 5e-3) << outer;
    }
}

// A rectangle of radiance 1 sends pi times its area, all of it to its front.
TEST(ReflectiveShadowMap, OfARectangleHoldsItsFlux) {
    const Light rectangle{.kind = LightKind::Rectangle,
                          .position = glm::vec3(0, 2.9f, 0),
                          .direction = glm::vec3(0, -1, 0),
                          .size = glm::vec2(1.5f, 0.5f)};
    const ReflectiveShadowMap map = cast(room(), rectangle);
    EXPECT_NEAR(incident(map), kPi * 0.75, kPi * 0.75 * 2e-3);
    for (const RsmTexel& texel : map.texels)
        EXPECT_LT(texel.position.y, 2.9f);
}

// A lamp in the plane of a wall is not hidden by the wall.
TEST(ReflectiveShadowMap, OfALampOnTheCeilingHoldsItsFlux) {
    const Light rectangle{.kind = LightKind::Rectangle,
                          .position = glm::vec3(0, 3, 0),
                          .direction = glm::vec3(0, -1, 0),
                          .size = glm::vec2(1)};
    EXPECT_NEAR(incident(cast(room(), rectangle)), kPi, kPi * 2e-3);
}

// A sun of irradiance 1 brings the area across its beam: that of a slanted square of 2 x 2 m is
// four times the cosine. What lies behind it in the beam stays dark.
TEST(ReflectiveShadowMap, OfASunHoldsTheAreaAcrossItsBeam) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad(glm::vec3(-1, 0, -1), glm::vec3(0, 0, 2), glm::vec3(2, 0, 0)));
    b.add(simple::quad(glm::vec3(-0.5f, -1, -0.5f), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)));
    const Scene scene = b.build();
    const Light sun{.kind = LightKind::Directional,
                    .direction = glm::normalize(glm::vec3(0.1f, -1, 0))};
    const ReflectiveShadowMap map = cast(scene, sun, 256);
    const double cosine = 1 / std::sqrt(1.01);
    EXPECT_NEAR(incident(map), 4 * cosine, 0.03);
    for (const RsmTexel& texel : map.texels)
        EXPECT_EQ(texel.instance, 0U);
    EXPECT_EQ(map.rays, 256U * 256);
}

// The range's window is that of KHR_lights_punctual at the surface.
TEST(ReflectiveShadowMap, EndsAtTheRangeOfALight) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::sphere(2, 3, true));
    const Scene scene = b.build();
    const Light point{.kind = LightKind::Point, .position = glm::vec3(0), .range = 2.5f};
    const double window = 1 - std::pow(2 / 2.5, 4);
    EXPECT_NEAR(incident(cast(scene, point)), 4 * kPi * window, 4 * kPi * window * 0.02);
    Light nearby = point;
    nearby.range = 1;
    EXPECT_TRUE(cast(scene, nearby).texels.empty());
}

TEST(ReflectiveShadowMap, LeavesOutBacksAndSurfacesThatReflectNothing) {
    Scene scene = room();
    const Light outside{.kind = LightKind::Point, .position = glm::vec3(0, 9, 0)};
    EXPECT_TRUE(cast(scene, outside).texels.empty()) << "backs";
    scene.materials[0].doubleSided = true;
    const ReflectiveShadowMap both = cast(scene, outside);
    EXPECT_FALSE(both.texels.empty());
    for (const RsmTexel& texel : both.texels)
        EXPECT_GT(glm::dot(texel.normal, outside.position - texel.position), 0);
    scene.materials[0].baseColor = glm::vec4(0, 0, 0, 1);
    EXPECT_TRUE(cast(scene, outside).texels.empty()) << "black";
    EXPECT_EQ(castRsm(TraceScene(scene), scene, outside, 64, {}, RsmTexels::All).texels.size(),
              both.texels.size());
}

// A texel says through which part of which view its piece is seen: the ray through its middle ends
// there. The pieces' areas across the light, over the squared distance, make up the sphere.
TEST(ReflectiveShadowMap, TellsThePlaceAndTheAreaOfEachTexel) {
    const Scene scene = room();
    const Light point{.kind = LightKind::Point, .position = glm::vec3(0.5f, 1, 0)};
    const std::vector<RsmView> views =
        rsmViews(unitLight(point), scene.bounds, 64, [](glm::vec3 p, glm::vec3) { return p; });
    double solidAngle = 0;
    for (const RsmTexel& t : cast(scene, point).texels) {
        const RsmView& view = views.at(t.view);
        const glm::vec2 ndc = (glm::vec2(t.place) + 0.5f) * (2 / float(view.size)) - 1.f;
        const glm::vec3 way = glm::normalize(view.forward + ndc.x * view.right + ndc.y * view.up);
        const float distance = glm::distance(t.position, point.position);
        EXPECT_LT(glm::distance(way * distance, t.position - point.position), 1e-4f);
        EXPECT_LT(glm::distance(way, t.direction), 1e-5f);
        solidAngle += double(t.area / (distance * distance));
        const Mesh& mesh = scene.meshOf(scene.instances[t.instance]);
        const std::uint32_t* corner = &mesh.indices[3 * std::size_t(t.triangle)];
        EXPECT_LT(glm::distance(mesh.positions[corner[0]] * (1 - t.u - t.v) +
                                    mesh.positions[corner[1]] * t.u +
                                    mesh.positions[corner[2]] * t.v,
                                t.position),
                  1e-4f);
    }
    EXPECT_NEAR(solidAngle, 4 * kPi, 4 * kPi * 1e-3);
}

TEST(ReflectiveShadowMap, IsTheSameForAnyColourAndNumberOfThreads) {
    const Scene scene = room();
    Light point{.kind = LightKind::Point, .position = glm::vec3(0.5f, 1, 0)};
    const ReflectiveShadowMap map = cast(scene, point);
    const ThreadLimit one(1);
    point.color = glm::vec3(7, 0, 0);
    point.strength = 0;
    point.name = "Other";
    const ReflectiveShadowMap again = cast(scene, point);
    ASSERT_EQ(again.texels.size(), map.texels.size());
    for (std::size_t i = 0; i < map.texels.size(); ++i) {
        EXPECT_EQ(again.texels[i].position, map.texels[i].position);
        EXPECT_EQ(again.texels[i].incident, map.texels[i].incident);
    }
    EXPECT_EQ(unitLight(point), unitLight({.kind = LightKind::Point, .position = point.position}));
    Light moved = point;
    moved.position.x += 1;
    EXPECT_NE(unitLight(point), unitLight(moved));
}

TEST(ReflectiveShadowMap, StopsWhenCancelledAndNeedsNoSurface) {
    const std::atomic<bool> cancel = true;
    const Scene scene = room();
    const Light sun{.kind = LightKind::Directional};
    EXPECT_TRUE(castRsm(TraceScene(scene), scene, sun, 64, {.report = {}, .cancel = &cancel})
                    .texels.empty());
    EXPECT_TRUE(cast(simple::SceneBuilder().build(), sun).texels.empty());
}

} // namespace
} // namespace limn::reflective_shadow_map_test
