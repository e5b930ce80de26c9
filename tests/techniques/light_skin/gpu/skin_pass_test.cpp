// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/gpu/skin_pass.h"

#include "engine/picture/field_lobe.h"
#include "engine/shading/pixel_rays.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/light_skin/gpu/glossy_room.h"
#include "tests/techniques/light_skin/lit_by_skin.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace limn::skin_pass_test {
namespace {

class SkinPassTest : public ViewportTest {
protected:
    SkinPassTest() {
        options.camera = {.eye = {3.6f, 1.9f, 4.7f}, .target = {1.5f, 0.8f, 1.5f}, .fovY = 1};
        options.width = 96;
        options.height = 72;
    }

    /// Differences between the pictures of both, as shares of the largest value on the CPU.
    struct Difference {
        double largest = 0, rms = 0, mean = 0;
        double off = 0; ///< share of the pixels that differ by more than 1 % of the mean
    };
    Difference compare(LitBySkin& lit, View view) {
        Scene dark = lit.scene; // bounced light alone
        dark.lights.clear();
        const ImageF drawn = draw(dark, view);
        Difference found;
        double highest = 0, squares = 0;
        std::vector<double> largest(drawn.rgb.size());
        for (std::uint32_t y = 0; y < options.height; ++y)
            for (std::uint32_t x = 0; x < options.width; ++x) {
                const glm::vec3 expected = lightAt(lit, view, {x, y});
                const glm::vec3 d = glm::abs(pixel(drawn, x, y) - expected);
                largest[y * options.width + x] = double(std::max({d.x, d.y, d.z}));
                highest = std::max(highest, double(std::max({expected.x, expected.y, expected.z})));
                found.mean +=
                    double(expected.x + expected.y + expected.z) / (3 * double(largest.size()));
                squares += double(glm::dot(d, d)) / (3 * double(largest.size()));
            }
        for (const double d : largest) {
            found.largest = std::max(found.largest, d / highest);
            found.off += d > 0.01 * found.mean ? 1 / double(largest.size()) : 0;
        }
        found.rms = std::sqrt(squares) / highest;
        return found;
    }

    /// What the field gives in the middle of a pixel.
    glm::vec3 lightAt(const LitBySkin& lit, View view, glm::uvec2 at) const {
        const Ray ray =
            PixelRays(options.camera, options.width, options.height).through(glm::vec2(at) + 0.5f);
        const Hit hit = lit.trace->closestHit(ray);
        const auto p = hit ? surfacePoint(*lit.trace, hit) : std::nullopt;
        if (!p)
            return glm::vec3(0);
        const FieldPoint point = fieldPoint(*lit.lighting->field(), lit.layout, lit.scene, hit, *p);
        const glm::vec3 irradiance = sampleIrradiance(point);
        if (view == View::Irradiance)
            return irradiance;
        const glm::vec3 diffuse = p->albedo * irradiance / kPi;
        if (view == View::Indirect)
            return diffuse;
        const FieldLobe lobe = fieldLobe(point, glossyPoint(*lit.trace, hit, ray, *p), 2, true);
        return diffuse + lobe.weight * sampleLobe(point, lobe.axis, lobe.bands, lobe.factors);
    }
};

TEST_F(SkinPassTest, DrawsWhatTheCpuDraws) {
    LitBySkin lit(glossyRoom());
    const Viewpoint view = viewpointOf(options.camera, {options.width, options.height});
    lit.update(&view);
    viewport->setIndirect(*lit.lighting->field(),
                          uploadSkinPart(*device, *viewport, *lit.lighting->field()));
    for (const View shown : {View::Irradiance, View::Indirect, View::Lit}) {
        const Difference d = compare(lit, shown);
        std::printf("view %d: largest difference %.2e, rms %.2e, mean %.3g, off %.4f\n", int(shown),
                    d.largest, d.rms, d.mean, d.off);
        EXPECT_GT(d.mean, 0.01);
        EXPECT_LT(d.rms, 5e-5);
        // Pixels on edges of objects and of cubes may fall to either side.
        EXPECT_LT(d.off, 0.001);
    }
    // Without a view nothing glossy is drawn.
    lit.update();
    viewport->setIndirect(*lit.lighting->field(),
                          uploadSkinPart(*device, *viewport, *lit.lighting->field()));
    EXPECT_LT(compare(lit, View::Lit).off, 0.001);
}

TEST_F(SkinPassTest, IsBlackWithoutCaches) {
    LitBySkin lit(glossyRoom());
    lit.update();
    Scene other = lit.scene;
    SkinPart::Light none{std::make_shared<LightCaches>(), {}, {}, {}};
    auto empty = std::make_shared<LightCaches>();
    empty->instances.resize(other.instances.size());
    none.caches = empty;
    IndirectField field;
    field.parts = {std::make_shared<const SkinPart>(none)};
    viewport->setIndirect(field, uploadSkinPart(*device, *viewport, field));
    for (const glm::vec3 p : draw(other, View::Irradiance).rgb)
        EXPECT_EQ(p, glm::vec3(0));
    EXPECT_EQ(uploadSkinPart(*device, *viewport, {}), nullptr);
}

} // namespace
} // namespace limn::skin_pass_test
