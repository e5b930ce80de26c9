// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/gpu/volume_pass.h"

#include "engine/picture/field_lobe.h"
#include "engine/shading/pixel_rays.h"
#include "engine/shading/surface_point.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/radiance_volumes/lit_by_volumes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace limn::volume_pass_test {
namespace {

constexpr std::uint32_t kWidth = 48, kHeight = 32;

/// A room with a block, lit by two lamps. Metal is a material of the block.
Scene room() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    Material metal = simple::lambert({0.8f, 0.7f, 0.5f});
    metal.metallic = 1;
    metal.roughness = 0.3f;
    b.addMaterial(metal);
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false, 1));
    b.scene.lights = {{.kind = LightKind::Point, .position = glm::vec3(3, 2.5f, 1), .strength = 5},
                      {.kind = LightKind::Spot,
                       .position = glm::vec3(1.5f, 2.9f, 4),
                       .direction = glm::vec3(0, -1, 0),
                       .color = glm::vec3(0.1f, 0.3f, 1),
                       .strength = 7,
                       .outerAngle = 0.6f}};
    b.scene.technique.settings = {{"radiance-volumes.read", 16}, {"radiance-volumes.map", 32}};
    return b.build();
}

Camera camera() {
    return {.eye = {2.7f, 1.7f, 4.1f}, .target = {1.2f, 0.5f, 1.3f}};
}

class VolumePassTest : public ViewportTest {
protected:
    /// The picture of a view of the CPU's light, without direct light.
    ImageF drawn(LitByVolumes& lit, View view) {
        options.camera = camera();
        options.width = kWidth;
        options.height = kHeight;
        viewport->setIndirect(*lit.lighting->field(),
                              uploadVolumePart(*device, *viewport, *lit.lighting->field()));
        Scene dark = lit.scene;
        dark.lights.clear();
        layout = std::make_shared<LightmapLayout>(lit.layout);
        viewport->setLighting(dark);
        return draw(dark, view);
    }
};

/// The largest and the root of the mean square difference, as shares of the largest value.
void expectSame(const ImageF& a, const ImageF& b, float largest, float rms, const char* what) {
    double sum = 0, worst = 0, brightest = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double d = std::abs(double(a.rgb[i][c]) - double(b.rgb[i][c]));
            sum += d * d;
            worst = std::max(worst, d);
            brightest = std::max(brightest, double(b.rgb[i][c]));
        }
    const double root = std::sqrt(sum / double(3 * a.rgb.size()));
    std::printf("%s: differs by %.2g of the largest at most, %.2g rms\n", what, worst / brightest,
                root / brightest);
    EXPECT_GT(brightest, 0);
    EXPECT_LT(worst, largest * brightest) << what;
    EXPECT_LT(root, rms * brightest) << what;
}

/// The same picture on the CPU, through the middles of pixels.
template <class Value>
ImageF onCpu(const LitByVolumes& lit, const Value& value) {
    ImageF image;
    image.width = kWidth;
    image.height = kHeight;
    image.rgb.resize(std::size_t(kWidth) * kHeight);
    const PixelRays rays(camera(), kWidth, kHeight);
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
        const Ray ray = rays.through(glm::vec2(i % kWidth, i / kWidth) + 0.5f);
        const Hit hit = lit.trace->closestHit(ray);
        if (hit)
            image.rgb[i] = value(ray, hit);
    }
    return image;
}

TEST_F(VolumePassTest, DrawsTheLightOfTheCpu) {
    const Viewpoint view = viewpointOf(camera(), {kWidth, kHeight});
    for (const auto& [bands, caches] : {std::pair(2, 4096), std::pair(3, 150)}) {
        LitByVolumes lit(room());
        lit.set("bands", bands);
        lit.set("caches", caches);
        const LightingReport report = lit.update(&view);
        EXPECT_EQ(counterOf(report, "caches_dropped") > 0, caches == 150);
        const ImageF cpu = onCpu(lit, [&](const Ray&, const Hit& hit) {
            return lit.irradiance(hit.position, hit.geometricNormal * (hit.frontFace ? 1.f : -1.f));
        });
        expectSame(drawn(lit, View::Irradiance), cpu, 2e-5f, 2e-6f,
                   bands == 3 ? "3 bands, some caches dropped" : "2 bands");
    }
}

// The spot's light comes through the block, from behind its sides: there, caches whose irradiance
// is below 0 lie next to others.
TEST_F(VolumePassTest, DrawsCachesThatAreClamped) {
    const Viewpoint view = viewpointOf(camera(), {kWidth, kHeight});
    Scene scene = room();
    scene.lights.erase(scene.lights.begin());
    LitByVolumes lit(scene);
    lit.set("shadow", 0);
    ImageF clamped, mixed;
    for (const bool clamp : {false, true}) {
        lit.set("clamp", clamp ? 1 : 0);
        lit.update(&view);
        (clamp ? clamped : mixed) = onCpu(lit, [&](const Ray&, const Hit& hit) {
            return lit.irradiance(hit.position, hit.geometricNormal * (hit.frontFace ? 1.f : -1.f));
        });
    }
    expectSame(drawn(lit, View::Irradiance), clamped, 2e-5f, 2e-6f, "each cache clamped");
    float brightest = 0, added = 0;
    for (std::size_t i = 0; i < mixed.rgb.size(); ++i) {
        brightest = std::max(brightest, mixed.rgb[i].z);
        added = std::max(added, clamped.rgb[i].z - mixed.rgb[i].z);
    }
    std::printf("clamping each cache adds up to %.2g of the largest\n", double(added / brightest));
    EXPECT_GT(added, 1e-3f * brightest);
}

TEST_F(VolumePassTest, DrawsReflectionsOfTheCpu) {
    const Viewpoint view = viewpointOf(camera(), {kWidth, kHeight});
    std::vector<glm::vec3> before;
    for (const int glossy : {0, 1}) {
        LitByVolumes lit(room());
        lit.set("glossy", glossy);
        lit.set("fill", 2);
        lit.update(&view);
        const std::vector<int> bands = reflectedBands(lit.scene, *lit.lighting->field());
        const ImageF cpu = onCpu(lit, [&](const Ray& ray, const Hit& hit) {
            const GlossyPoint g = glossyPoint(*lit.trace, hit, ray, *surfacePoint(*lit.trace, hit));
            const FieldPoint p =
                fieldPoint(*lit.lighting->field(), lit.layout, lit.scene, hit, g.surface);
            const FieldLobe lobe =
                fieldLobe(p, g, bands[lit.scene.instances[hit.instance].material], true);
            return g.surface.albedo * sampleIrradiance(p) / kPi +
                   lobe.weight * sampleLobe(p, lobe.axis, lobe.bands, lobe.factors);
        });
        expectSame(drawn(lit, View::Lit), cpu, 2e-4f, 5e-5f, glossy == 1 ? "maps" : "harmonics");
        EXPECT_NE(cpu.rgb, before) << "maps are not harmonics";
        before = cpu.rgb;
    }
}

TEST_F(VolumePassTest, IsDarkWithoutCaches) {
    LitByVolumes lit(simple::SceneBuilder().build());
    lit.update();
    EXPECT_EQ(uploadVolumePart(*device, *viewport, *lit.lighting->field()), nullptr);
}

} // namespace
} // namespace limn::volume_pass_test
