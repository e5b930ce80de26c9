// SPDX-License-Identifier: MIT
// Finer texels where light from lamps varies: where they lie, how many, and what they bring.
#include "engine/lightmap/lamp_texels.h"

#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/lightmap/texel_points.h"
#include "engine/scene/mesh/input_hash.h"
#include "tests/techniques/illuminance/relight/relit.h"
#include "tests/trace/simple_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn::lamp_texels_test {
namespace {

using namespace simple;

constexpr std::uint32_t kTexels = 4000;
constexpr float kHeight = 3, kThick = 0.01f, kHalf = 0.5f; ///< of the room, and of the lamp [m]
constexpr std::uint32_t kRoom = 0;

/// A black room of 4 x 3 x 4 m, times `scale`, with a flat lamp in the middle of its ceiling.
Scene roomWithLamp(float scale = 1, float emission = 1) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    b.addMaterial(lambert(glm::vec3(0), glm::vec3(emission)));
    b.add(box(glm::vec3(-2, 0, -2) * scale, glm::vec3(2, kHeight, 2) * scale, true));
    Mesh lamp = box(glm::vec3(-kHalf, kHeight - kThick, -kHalf) * scale,
                    glm::vec3(kHalf, kHeight, kHalf) * scale, false);
    lamp.material = 1;
    b.add(lamp);
    Scene scene = b.build();
    scene.bake.lightmapCaches = kTexels;
    scene.bake.surfels = 2000;
    return scene;
}

Atlas atlasOf(const Scene& scene) {
    const TraceScene trace(scene);
    std::uint64_t rays = 0;
    std::optional<PlacedAtlas> placed =
        atlasStage(trace, scene, hashMeshes(scene), {}, nullptr, rays);
    EXPECT_TRUE(placed);
    return std::move(placed->atlas);
}

/// Texels of the room finer than most, and how far each is from the lamp's rim on the ceiling.
std::vector<float> fineTexels(const Scene& scene, const Atlas& atlas) {
    std::vector<float> widths, result;
    for (const AtlasTexel& t : atlas.texels)
        if (t.instance == kRoom)
            widths.push_back(t.width);
    std::ranges::nth_element(widths, widths.begin() + std::ptrdiff_t(widths.size() / 2));
    const float usual = widths[widths.size() / 2];
    for (const AtlasTexel& t : atlas.texels)
        if (t.instance == kRoom && t.width < 0.5f * usual) {
            const glm::vec3 p = glm::abs(texelPoint(scene, t, 0).position);
            const glm::vec3 rim(std::min(p.x, kHalf), kHeight, std::min(p.z, kHalf));
            const glm::vec3 away = p - rim;
            const float inside = std::min(kHalf - p.x, kHalf - p.z);
            result.push_back(std::max(glm::length(away), inside));
        }
    return result;
}

TEST(LampTexels, LieAtTheRimOfALampAndNowhereInSmoothLight) {
    const Scene scene = roomWithLamp();
    const std::vector<float> fine = fineTexels(scene, atlasOf(scene));
    ASSERT_GT(fine.size(), 500U);
    EXPECT_LE(fine.size(), kTexels);
    const auto far = std::ranges::count_if(fine, [](float d) { return d > 0.2f; });
    EXPECT_LT(double(far), 0.05 * double(fine.size()));
    const Scene dark = roomWithLamp(1, 0);
    EXPECT_TRUE(fineTexels(dark, atlasOf(dark)).empty());
    Scene panel = roomWithLamp();
    panel.instances.pop_back(); // a wall of the room glows instead
    panel.materials[0].emission = glm::vec3(1);
    EXPECT_TRUE(fineTexels(panel, atlasOf(panel)).empty());
}

TEST(LampTexels, AreTheSameAtAnyScale) {
    const std::size_t one = atlasOf(roomWithLamp()).texels.size();
    for (const float scale : {1e-3f, 1024.f})
        EXPECT_NEAR(double(atlasOf(roomWithLamp(scale)).texels.size()), double(one),
                    0.05 * double(one))
            << scale;
}

/// Irradiance over radiosity at distance `away` from a long strip as high as the lamp is thick.
double besideStrip(double away) {
    return (1 - std::cos(std::atan(double(kThick) / away))) / 2;
}

/// rms error of the ceiling's irradiance within 20 cm of the rim, over the rms irradiance.
double rimError(const Relit& lit, const LightmapLayout& layout) {
    double error = 0, all = 0;
    for (int i = 0; i < 400; ++i) {
        const float away = 0.2f * (float(i) + 0.5f) / 400, z = 0.6f * float(i % 20) / 19 - 0.3f;
        const Hit hit = lit.trace.closestHit({{kHalf + away, 2, z}, {0, 1, 0}});
        EXPECT_EQ(hit.instance, kRoom);
        const auto E = double(
            sampleIrradiance({lit.relighter.field(), layout, lit.trace.scene(), hit.instance,
                              hit.triangle, hit.u, hit.v, hit.position, hit.geometricNormal, false})
                .x);
        const double truth = std::numbers::pi * besideStrip(double(away));
        error += (E - truth) * (E - truth);
        all += truth * truth;
    }
    return std::sqrt(error / all);
}

TEST(LampTexels, ShowTheLightBesideARim) {
    const Relit lit(roomWithLamp());
    LightmapLayout coarse = lit.baked->lightmap;
    for (std::uint32_t& s : coarse.snaps)
        s = (s & kFineLookup) != 0 ? 0 : s;
    const double with = rimError(lit, lit.baked->lightmap), without = rimError(lit, coarse);
    EXPECT_LT(with, 0.35);
    EXPECT_GT(without, 2 * with);
}

} // namespace
} // namespace limn::lamp_texels_test
