// SPDX-License-Identifier: MIT
#include "engine/field/sample_field.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/illuminance/bake/house_on_ground.h"
#include "tests/techniques/illuminance/bake/parted_hall.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limn::parted_hall_test {
namespace {

class ViewportPartedHall : public ViewportTest {
protected:
    void expectLooksAsOnTheCpu(const Scene& scene, const TraceScene& trace,
                               const IndirectField& field, const LightmapLayout& plain,
                               double changed);
};

/// Irradiance at the middles of the pixels, each looked up by itself.
std::vector<float> lookedUp(const TraceScene& trace, const IndirectField& field,
                            const LightmapLayout& layout, const ViewportOptions& o) {
    std::vector<float> result;
    for (std::uint32_t y = 0; y < o.height; ++y)
        for (std::uint32_t x = 0; x < o.width; ++x) {
            const glm::vec3 d = rayDirection(o.camera, float(o.width) / float(o.height),
                                             2 * (float(x) + 0.5f) / float(o.width) - 1,
                                             1 - 2 * (float(y) + 0.5f) / float(o.height));
            const Hit hit = trace.closestHit({o.camera.eye, d});
            const glm::vec3 n = hit.frontFace ? hit.geometricNormal : -hit.geometricNormal;
            result.push_back(
                sampleIrradiance({field, layout, trace.scene(), hit.instance, hit.triangle, hit.u,
                                  hit.v, hit.position, n, !hit.frontFace})
                    .x);
        }
    return result;
}

/// Share of pixels that differ by more than `bound`.
double shareOff(const std::vector<float>& a, const std::vector<float>& b, float bound) {
    std::size_t off = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        off += std::abs(a[i] - b[i]) > bound;
    return double(off) / double(a.size());
}

/// Draws the scene and compares each pixel with a lookup on the CPU. Without what `plain` leaves
/// out of the layout, more than the share `changed` of the pixels would be off.
void ViewportPartedHall::expectLooksAsOnTheCpu(const Scene& scene, const TraceScene& trace,
                                               const IndirectField& field,
                                               const LightmapLayout& plain, double changed) {
    viewport->setIndirect(field);
    const std::vector<float> truth = lookedUp(trace, field, *layout, options);
    const std::vector<float> without = lookedUp(trace, field, plain, options);
    std::vector<float> drawn;
    for (const glm::vec3 p : draw(scene, View::Irradiance).rgb)
        drawn.push_back(p.x);
    // Texture units interpolate with 8 bits of weight, along both sides of a texel.
    const float bound = *std::ranges::max_element(without) / 64;
    // Where two surfaces meet, CPU and GPU may disagree on what lies at a pixel's middle, or in
    // which cell.
    EXPECT_LT(shareOff(drawn, truth, bound), 0.003) << options.camera.eye.x;
    EXPECT_GT(shareOff(without, truth, bound), changed) << "nothing to compare";
}

TEST_F(ViewportPartedHall, LookupsSnapAsTheyDoOnTheCpu) {
    Scene scene = partedHall(0, 470);
    scene.bake.surfels = 500;
    scene.bake.rays = 64;
    const auto baked = std::make_shared<const Bake>(*bake(TraceScene(scene)));
    ASSERT_FALSE(baked->lightmap.snaps.empty());
    Relighter relighter(baked);
    relighter.relight(scene, TraceScene(scene), 16);
    scene.lights.clear(); // the pictures show bounced light alone, which the field keeps
    const TraceScene trace(scene);
    layout = std::make_shared<LightmapLayout>(baked->lightmap);
    LightmapLayout plain = baked->lightmap;
    plain.snaps.clear();
    options.width = 96;
    options.height = 64;
    // From the dark part and from the bright one, along the floor to the wall.
    for (const float eye : {1.2f, 6.2f}) {
        options.camera = {.eye = {eye, 1.6f, 2}, .target = {3.7f, 0.4f, 1.9f}, .fovY = 1.2f};
        expectLooksAsOnTheCpu(scene, trace, relighter.field(), plain, 0.03);
    }
}

TEST_F(ViewportPartedHall, FinerTexelsAreReadAsOnTheCpu) {
    Scene scene = houseOnGround(1, false).build();
    scene.bake.surfels = 1000;
    scene.bake.rays = 64;
    scene.bake.lightmapCaches = 6000;
    const auto baked = std::make_shared<const Bake>(*bake(TraceScene(scene)));
    ASSERT_TRUE(std::ranges::any_of(baked->lightmap.snaps,
                                    [](std::uint32_t s) { return (s & kFineLookup) != 0; }));
    Relighter relighter(baked);
    relighter.relight(scene, TraceScene(scene), 16);
    const TraceScene trace(scene);
    layout = std::make_shared<LightmapLayout>(baked->lightmap);
    LightmapLayout plain = baked->lightmap;
    for (std::uint32_t& s : plain.snaps)
        s = (s & kFineLookup) != 0 ? 0 : s;
    options.width = 96;
    options.height = 64;
    options.camera = {.eye = {5, 2, 2.5f}, .target = {2, 0, 2.4f}, .fovY = 1.2f};
    expectLooksAsOnTheCpu(scene, trace, relighter.field(), plain, 0.2);
}

} // namespace
} // namespace limn::parted_hall_test
