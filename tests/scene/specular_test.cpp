// SPDX-License-Identifier: MIT
#include "engine/scene/surface/specular.h"

#include "engine/math/sampling.h"

#include "engine/math/lobe.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/scene/surface/reflection_lobe.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_access.hpp>

namespace limn::specular_test {
namespace {

const glm::vec3 kUp(0, 1, 0);

glm::vec3 atElevation(float sine) {
    return {std::sqrt(1 - sine * sine), sine, 0};
}

/// Calls with directions above the horizon and their solid angles, dense about the mirrored one.
template <class F>
void overLobe(glm::vec3 toEye, F use) {
    constexpr int kRings = 600, kSpokes = 180;
    const float pi = std::numbers::pi_v<float>;
    const glm::mat3 basis = basisAround(glm::reflect(-toEye, kUp));
    for (int i = 0; i < kRings; ++i) {
        const float t = (float(i) + 0.5f) / kRings, theta = pi * t * t * t,
                    width = 3 * pi * t * t / kRings;
        for (int j = 0; j < kSpokes; ++j) {
            const float phi = 2 * pi * (float(j) + 0.5f) / kSpokes;
            const glm::vec3 d = basis * glm::vec3(std::sin(theta) * std::cos(phi),
                                                  std::sin(theta) * std::sin(phi), std::cos(theta));
            if (d.y > 0)
                use(d, std::sin(theta) * width * 2 * pi / kSpokes);
        }
    }
}

Material dielectric(float roughness) {
    Material m;
    m.roughness = roughness;
    return m;
}

Material metal(float roughness) {
    Material m = dielectric(roughness);
    m.metallic = 1;
    return m;
}

} // namespace

TEST(Specular, IsReciprocal) {
    const Gloss gloss{{0.9f, 0.5f, 0.1f}, 0.4f};
    const glm::vec3 a = glm::normalize(glm::vec3(1, 0.5f, 0.2f)),
                    b = glm::normalize(glm::vec3(-0.3f, 1, 0.8f));
    EXPECT_LT(glm::length(specularBrdf(gloss, kUp, a, b) - specularBrdf(gloss, kUp, b, a)), 1e-5f);
}

// The density times the weight is what is to be integrated; what the density misses of 1 goes below
// the horizon, to where a weight of 0 goes.
TEST(Specular, SamplesHaveTheirWeight) {
    const glm::vec3 n = glm::normalize(glm::vec3(1, -2, 0.5f));
    const glm::mat3 basis = basisAround(n);
    for (const float roughness : {0.3f, 0.6f, 1.f})
        for (const float NoV : {0.1f, 0.5f, 0.999f}) {
            const Gloss gloss{{0.9f, 0.5f, 0.1f}, roughness};
            const glm::vec3 toEye = basis * glm::vec3(std::sqrt(1 - NoV * NoV), 0, NoV);
            for (int k = 0; k < 100; ++k) {
                const glm::vec2 u(radicalInverse(std::uint32_t(k), 2),
                                  radicalInverse(std::uint32_t(k), 3));
                const SpecularSample s = sampleSpecular(gloss, n, toEye, u);
                if (s.weight == glm::vec3(0))
                    continue;
                ASSERT_NEAR(glm::length(s.toLight), 1, 1e-5f);
                const glm::vec3 f =
                    specularBrdf(gloss, n, toEye, s.toLight) * glm::dot(n, s.toLight);
                const float pdf = specularPdf(roughness, n, toEye, s.toLight);
                EXPECT_LT(glm::length(s.weight * pdf - f), 2e-3f * glm::length(f) + 1e-5f)
                    << roughness << " " << NoV << " " << k;
            }
        }
}

TEST(Specular, SamplesReflectWhatTheBrdfDoes) {
    for (const float roughness : {0.1f, 0.3f, 0.5f, 0.7f, 0.9f})
        for (const float NoV : {0.1f, 0.4f, 0.8f, 1.f}) {
            const Gloss gloss{{1, 0.5f, 0}, roughness};
            const glm::vec3 toEye = atElevation(NoV);
            glm::vec3 share(0);
            glm::mat3 moments(0); // of the first channel, so that directions count too
            constexpr std::uint32_t count = 1 << 14;
            double below = 0;
            for (std::uint32_t i = 0; i < count; ++i) {
                const SpecularSample s = sampleSpecular(
                    gloss, kUp, toEye, {(float(i) + 0.5f) / count, radicalInverse(i, 2)});
                share += s.weight / float(count);
                below += s.weight == glm::vec3(0);
                moments += glm::outerProduct(s.toLight, s.toLight) * (s.weight.x / float(count));
            }
            glm::vec3 expected(0);
            glm::mat3 expectedMoments(0);
            double density = 0;
            overLobe(toEye, [&](glm::vec3 d, float solidAngle) {
                const glm::vec3 f = specularBrdf(gloss, kUp, toEye, d) * (d.y * solidAngle);
                expected += f;
                expectedMoments += glm::outerProduct(d, d) * f.x;
                density += double(specularPdf(roughness, kUp, toEye, d) * solidAngle);
            });
            EXPECT_LT(glm::length(share - expected), 4e-3f) << roughness << " " << NoV;
            for (int c = 0; c < 3; ++c)
                EXPECT_LT(glm::length(moments[c] - expectedMoments[c]), 4e-3f)
                    << roughness << " " << NoV;
            EXPECT_NEAR(density, 1 - below / count, 4e-3) << roughness << " " << NoV;
        }
}

TEST(Specular, AMirrorReflectsAllByFresnelsTerm) {
    for (const float NoV : {0.3f, 0.7f, 1.f}) {
        const SpecularSample s =
            sampleSpecular({{1, 0.04f, 0}, 0}, kUp, atElevation(NoV), {0.3f, 0.8f});
        const float fresnel = std::pow(1 - NoV, 5.f);
        EXPECT_LT(glm::length(s.weight - glm::vec3(1, 0.04f + 0.96f * fresnel, fresnel)), 6e-3f);
        const glm::vec3 mirrored = glm::reflect(-atElevation(NoV), kUp);
        EXPECT_LT(glm::length(s.toLight - mirrored), 6e-3f) << "alpha = 0.002";
    }
}

// Against the integral of the BRDF itself: how much is reflected, to where in the mean, and how
// wide.
TEST(ReflectionLobe, IsThatOfTheBrdf) {
    for (const float roughness : {0.1f, 0.22f, 0.3f, 0.5f, 0.7f, 0.9f, 1.f})
        for (const float NoV : {0.1f, 0.2f, 0.5f, 0.77f, 0.95f, 1.f}) {
            SCOPED_TRACE(testing::Message() << "roughness " << roughness << ", NoV " << NoV);
            const glm::vec3 toEye = atElevation(NoV);
            const ReflectionLobe lobe = reflectionLobe(roughness, NoV);
            const glm::vec3 axis = lobeAxis(lobe, kUp, glm::reflect(-toEye, kUp));
            double white = 0, black = 0;
            glm::dvec3 mean(0);
            std::array<double, kMaxBands> s{};
            overLobe(toEye, [&](glm::vec3 d, float solidAngle) {
                const glm::vec3 f = specularBrdf({{1, 0, 0}, roughness}, kUp, toEye, d);
                const double weight = double(f.x * d.y * solidAngle);
                white += weight;
                black += double(f.y * d.y * solidAngle);
                mean += weight * glm::dvec3(d);
                for (unsigned l = 0; l < s.size(); ++l)
                    s[l] +=
                        weight * std::legendre(l, std::clamp(double(glm::dot(d, axis)), -1., 1.));
            });
            EXPECT_NEAR(lobe.share.x + lobe.share.y, white, 0.01);
            EXPECT_NEAR(lobe.share.y, black, 0.005);
            EXPECT_LT(glm::length(glm::dvec3(axis * lobe.factors[1]) - mean / white), 0.006);
            for (std::size_t l = 0; l < s.size(); ++l)
                EXPECT_NEAR(lobe.factors[l], s[l] / white, 0.01) << "s_" << l;
        }
}

// A smooth surface: the lobe is narrow, and of its slopes' distribution, whose transform is
// k alpha K_1(k alpha), reflection doubles the angle: s_l = x K_1(x), x = (2l + 1) alpha.
TEST(ReflectionLobe, OfAPolishedSurfaceHasTheTransformOfGgx) {
    for (const float roughness : {0.1f, 0.15f, 0.2f}) {
        const ReflectionLobe lobe = reflectionLobe(roughness, 1);
        for (std::size_t l = 1; l < lobe.factors.size(); ++l) {
            const double x = double((2 * float(l) + 1) * roughness * roughness);
            EXPECT_NEAR(lobe.factors[l], x * std::cyl_bessel_k(1, x), 0.012)
                << roughness << " " << l;
        }
    }
}

TEST(ReflectionLobe, TableIsWhatIsRead) {
    constexpr std::size_t n = kReflectionNodes;
    const std::span<const glm::vec4> table = reflectionTable();
    ASSERT_EQ(table.size(), n * n * kReflectionLayers);
    for (const std::size_t x : {std::size_t(0), std::size_t(7), n - 1})
        for (const std::size_t y : {std::size_t(0), std::size_t(12), n - 1}) {
            const float root = float(x) / float(n - 1), roughness = float(y) / float(n - 1);
            const ReflectionLobe lobe = reflectionLobe(roughness, root * root);
            const glm::vec4 a = table[y * n + x], c = table[(2 * n + y) * n + x];
            EXPECT_NEAR(lobe.share.x, a.x, 1e-5f);
            EXPECT_NEAR(lobe.towards.y, a.w, 1e-5f);
            EXPECT_NEAR(lobe.factors[7], c.y, 1e-5f);
        }
}

TEST(ReflectionLobe, KernelsAreNowhereFarBelowZero) {
    for (int bands = 3; bands <= kMaxBands; ++bands)
        for (float roughness = 0; roughness < 1.01f; roughness += 0.05f)
            for (const float NoV : {0.1f, 0.3f, 0.6f, 1.f}) {
                const auto s = windowedFactors(reflectionLobe(roughness, NoV).factors, bands);
                double middle = 0, least = 0;
                for (int i = 0; i <= 180; ++i) {
                    double k = 0;
                    for (unsigned l = 0; l < unsigned(bands); ++l)
                        k += (2 * l + 1) * double(s[l]) *
                             std::legendre(l, std::cos(std::numbers::pi * i / 180));
                    middle = i == 0 ? k : middle;
                    least = std::min(least, k / middle);
                }
                // The window's tenth, of a lobe that is not quite a blur; those too wide for a
                // window are not round, and ring a little of their own.
                EXPECT_GT(least, roughness < 0.35f ? -0.11 : -0.15)
                    << bands << " " << roughness << " " << NoV;
            }
}

TEST(ReceiverBands, PlainSurfacesNeedThree) {
    const Assets none;
    for (const float roughness : {0.5f, 0.7f, 1.f})
        EXPECT_EQ(receiverBands(none, dielectric(roughness), 8), 3) << roughness;
    EXPECT_EQ(receiverBands(none, metal(1), 8), 3);
    EXPECT_EQ(receiverBands(none, metal(1), 2), 2) << "there are no more";
}

TEST(ReceiverBands, GrowWithPolishAndReflectance) {
    const Assets none;
    // Seen at 45 degrees s_3, s_4, s_5 are 0.25, 0.12, 0.06. By l^-3, 0.211, 0.161 and 0.131 of
    // them are lost: three bands lose 0.056 of what is reflected, 0.77 of all; four bands 0.022.
    EXPECT_EQ(receiverBands(none, metal(0.6f), 8), 4);
    // s_3 ... s_7 are 0.42, 0.28, 0.18, 0.12, 0.08: of 0.87, five bands lose 0.028 and six 0.016.
    EXPECT_EQ(receiverBands(none, metal(0.5f), 8), 6);
    EXPECT_EQ(receiverBands(none, metal(0.5f), 5), 5) << "there are no more";
    EXPECT_EQ(receiverBands(none, metal(0.3f), 8), 8);
    Material grey = metal(0.6f);
    grey.baseColor = {0.6f, 0.6f, 0.6f, 1}; // of 0.46, 0.056 are 0.026: a little more than may be
    EXPECT_EQ(receiverBands(none, grey, 8), 4);
    Material dark = metal(0.6f);
    dark.baseColor = {0.1f, 0.05f, 0, 1};
    EXPECT_EQ(receiverBands(none, dark, 8), 3);
    // A polished floor reflects 7 % of the light round it.
    EXPECT_GT(receiverBands(none, dielectric(0.25f), 8), 3);
}

TEST(ReceiverBands, LookAtTheTextureButForOddTexels) {
    Assets assets;
    assets.images.push_back({"rough", 32, 32, {}});
    std::vector<std::uint8_t>& rgba = assets.images[0].rgba;
    for (int i = 0; i < 32 * 32; ++i)
        rgba.insert(rgba.end(), {255, 255, 255, 255}); // rough metal
    Material m = metal(1);
    m.metallicRoughnessTexture.image = 0;
    const auto polish = [&](int row, int columns) -> const Assets& {
        for (int x = 0; x < columns; ++x)
            rgba[std::size_t(row * 32 + x) * 4 + 1] = 64;
        return assets;
    };
    EXPECT_EQ(receiverBands(polish(0, 0), m, 8), 3);
    polish(0, 2);
    EXPECT_EQ(receiverBands(polish(1, 2), m, 8), 3) << "two texels of 1024 are less than 1 %";
    for (int y = 0; y < 16; ++y)
        polish(y, 32);
    EXPECT_EQ(receiverBands(assets, m, 8), 8);
    m.metallic = 0;
    EXPECT_EQ(receiverBands(assets, m, 8), 4) << "as a floor of that polish";
}

TEST(ReceiverBands, OfASceneAreThoseOfWhatIsInIt) {
    simple::SceneBuilder b;
    b.addMaterial(dielectric(1));
    b.addMaterial(metal(0.6f));
    b.add(simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    Scene scene = b.build();
    EXPECT_EQ(receiverBands(scene, 8), 3) << "nothing is made of the metal";
    scene.instances[0].material = 1;
    EXPECT_EQ(receiverBands(scene, 8), 4);
}

} // namespace limn::specular_test
