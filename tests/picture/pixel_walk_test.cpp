// SPDX-License-Identifier: MIT
#include "engine/picture/pixel_walk.h"

#include "engine/picture/value_sink.h"
#include "tests/picture/two_plates.h"

#include <gtest/gtest.h>

#include <vector>

namespace limn::pixel_walk_test {
namespace {

/// Keeps the terms that a ValueSink would add, each with all of its factors.
struct TermSink {
    const TraceScene& trace;
    std::vector<std::uint32_t> black; ///< instances that reflect no diffuse light
    glm::vec3 factor{1};
    glm::vec3 background_{0}, emission_{0}, direct{0}, nearDirect{0}, irradiance{0}, radiance{0},
        lobe{0};
    std::size_t near = 0; ///< number of directions of near surfaces

    bool reflects(std::uint32_t instance) const { return std::ranges::count(black, instance) == 0; }
    static void meets(std::uint32_t /*instance*/) {}
    template <class Body>
    void scaled(glm::vec3 multiplier, const Body& body) {
        const glm::vec3 before = factor;
        factor *= multiplier;
        body();
        factor = before;
    }
    template <class Term>
    void add(glm::vec3& sum, const Term& term) {
        ValueSink value{trace};
        term(value);
        sum += factor * value.sum;
    }
    void background(glm::vec3 light) { background_ += factor * light; }
    void emission(glm::vec3 light) { emission_ += factor * light; }
    template <class Response>
    void directLight(const SurfacePoint& p, const LightNumbers& u, const Response& response) {
        add(direct, [&](ValueSink& v) { v.directLight(p, u, response); });
    }
    void nearDirectLight(const SurfacePoint& p, const LightNumbers& u, std::uint32_t via) {
        add(nearDirect, [&](ValueSink& v) { v.nearDirectLight(p, u, via); });
    }
    void fieldIrradiance(const FieldPoint& p, glm::vec3 weight, GatherPart part) {
        add(irradiance, [&](ValueSink& v) { v.fieldIrradiance(p, weight, part); });
    }
    void fieldRadiance(const FieldPoint& p, glm::vec3 direction, glm::vec3 weight) {
        add(radiance, [&](ValueSink& v) { v.fieldRadiance(p, direction, weight); });
        ++near;
    }
    void fieldLobe(const FieldPoint& p, const FieldLobe& l) {
        add(lobe, [&](ValueSink& v) { v.fieldLobe(p, l); });
    }
    void fieldReflection(const FieldPart& /*part*/, const FieldReflection& /*reflection*/) {}

    glm::vec3 total() const {
        return background_ + emission_ + direct + nearDirect + irradiance + radiance + lobe;
    }
};

/// The foot of a lit wall, which glows a little, seen from the plane before it.
struct Foot {
    TwoPlates plates{wall(), 0.6f};
    Scene scene;
    TraceScene trace;
    FieldRenderOptions options;

    Foot() : scene(made(plates)), trace(scene) {
        options.camera = {.eye = {0, 0.15f, 1.5f}, .target = {0, 0.15f, 0}, .fovY = 0.2f};
        options.width = options.height = 4;
        options.nearRays = 8;
    }
    static Scene made(TwoPlates& plates) {
        plates.setField(0, {0, 1, 0}, {1, 2, 3});
        plates.setField(1, {0, 0, 1}, {2, 1, 1});
        plates.builder.scene.materials[1].emission = {0, 0, 0.5f};
        Light lamp;
        lamp.position = {0.4f, 1, 0.8f};
        lamp.strength = 4;
        plates.builder.scene.lights = {lamp};
        plates.builder.scene.sky.radiance = {0, 0, 7};
        return plates.builder.build();
    }
    TermSink terms(PixelSum sum, std::vector<std::uint32_t> black = {}) const {
        TermSink sink{trace, std::move(black)};
        walkPixel(pixelWalk(trace, plates.field, *plates.layout, options, sum, false), sample(),
                  sink);
        return sink;
    }
    glm::vec3 value(PixelSum sum) const {
        ValueSink sink{trace};
        walkPixel(pixelWalk(trace, plates.field, *plates.layout, options, sum, false), sample(),
                  sink);
        return sink.sum;
    }
    PixelSample sample() const {
        return {PixelRays(options.camera, options.width, options.height), 1, 5, 0};
    }
};

constexpr PixelSum kSums[] = {PixelSum::Radiance, PixelSum::DirectDiffuse, PixelSum::BouncedDiffuse,
                              PixelSum::BouncedIrradiance, PixelSum::Irradiance};

TEST(PixelWalk, AFactorCountsForAllTermsThatItsBodyHandsOver) {
    const Foot foot;
    ASSERT_GT(foot.terms(PixelSum::Radiance).near, 0U);
    for (const PixelSum sum : kSums) {
        const glm::vec3 value = foot.value(sum), total = foot.terms(sum).total();
        ASSERT_GT(value.y, 0);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(value[k], total[k], 1e-5f * std::abs(value[k])) << int(sum);
    }
}

TEST(PixelWalk, DiffuseRadianceIsIrradianceTimesAlbedoOverPi) {
    const Foot foot;
    const TermSink all = foot.terms(PixelSum::Irradiance);
    const glm::vec3 reflected(0.6f / glm::pi<float>());
    const auto expectSame = [](glm::vec3 a, glm::vec3 b) {
        EXPECT_LT(glm::length(a - b), 1e-5f * glm::length(b));
    };
    const TermSink direct = foot.terms(PixelSum::DirectDiffuse);
    expectSame(direct.direct, reflected * all.direct);
    EXPECT_EQ(direct.irradiance, glm::vec3(0));
    for (const PixelSum sum : {PixelSum::BouncedDiffuse, PixelSum::BouncedIrradiance}) {
        const TermSink bounced = foot.terms(sum);
        const glm::vec3 factor = sum == PixelSum::BouncedDiffuse ? reflected : glm::vec3(1);
        expectSame(bounced.irradiance, factor * all.irradiance);
        expectSame(bounced.nearDirect, factor * all.nearDirect);
        expectSame(bounced.radiance, factor * all.radiance);
        EXPECT_EQ(bounced.direct + bounced.emission_ + bounced.lobe, glm::vec3(0));
    }
    const TermSink radiance = foot.terms(PixelSum::Radiance);
    expectSame(radiance.irradiance, reflected * all.irradiance);
    EXPECT_EQ(radiance.emission_, glm::vec3(0, 0, 0.5f));
    EXPECT_GT(radiance.lobe.x, 0);
    EXPECT_GT(radiance.direct.x, (reflected * all.direct).x); // the surface is glossy, too
    EXPECT_EQ(all.emission_ + all.lobe, glm::vec3(0));
}

TEST(PixelWalk, WhatReflectsNothingKeepsEmissionAndGloss) {
    const Foot foot;
    const TermSink radiance = foot.terms(PixelSum::Radiance),
                   black = foot.terms(PixelSum::Radiance, {1});
    EXPECT_EQ(black.emission_, radiance.emission_);
    EXPECT_EQ(black.lobe, radiance.lobe);
    EXPECT_EQ(black.irradiance + black.nearDirect + black.radiance, glm::vec3(0));
    EXPECT_GT(black.direct.x, 0);
    EXPECT_LT(black.direct.x, 0.5f * radiance.direct.x);
    // Irradiance is what arrives before the surface reflects it, but its light from a near surface
    // that reflects nothing is missing.
    const TermSink all = foot.terms(PixelSum::Irradiance);
    EXPECT_EQ(foot.terms(PixelSum::Irradiance, {1}).total(), all.total());
    const TermSink blackPlane = foot.terms(PixelSum::Irradiance, {0});
    EXPECT_EQ(blackPlane.nearDirect, glm::vec3(0));
    EXPECT_GT(all.nearDirect.x, 0);
    EXPECT_EQ(blackPlane.radiance, all.radiance);
}

TEST(PixelWalk, BehindAllSurfacesRadianceIsTheSkysAndTheRestIsDark) {
    Foot foot;
    foot.options.camera = {.eye = {0, 1, 5}, .target = {0, 1, 9}, .fovY = 0.2f};
    for (const PixelSum sum : kSums)
        EXPECT_EQ(foot.value(sum), glm::vec3(0, 0, sum == PixelSum::Radiance ? 7 : 0));
}

} // namespace
} // namespace limn::pixel_walk_test
