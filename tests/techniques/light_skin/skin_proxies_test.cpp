// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/proxy_lights.h"

#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/light_skin/proxy_shade.h"
#include "engine/techniques/light_skin/skin_part.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::skin_proxies_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// What a proxy gives at its cache.
float irradianceOf(const ProxyLight& proxy, const GatheringCache& cache, float flux) {
    const glm::vec3 way = proxy.position - cache.position;
    const float r2 = glm::dot(way, way);
    return flux * std::max(glm::dot(glm::normalize(way), cache.normal), 0.f) / (4 * kPi * r2);
}

/// Random lights around a cache, some below its horizon.
GatheringLights randomLights(std::mt19937& random, float low) {
    std::uniform_real_distribution<float> uniform(-1, 1);
    VirtualLights lights;
    for (std::uint32_t i = 0; i < 37; ++i) {
        const glm::vec3 p(3 * uniform(random), low + 1.5f * uniform(random), 3 * uniform(random));
        const glm::vec3 n =
            glm::normalize(-p + glm::vec3(uniform(random), uniform(random), uniform(random)));
        lights.add(p, n, glm::abs(glm::vec3(uniform(random), uniform(random), uniform(random))),
                   0.01f, 0, i);
    }
    ChosenLights chosen = allLights(lights);
    for (float& weight : chosen.weight)
        weight = 1 + 0.5f * uniform(random);
    return gatheringLights(lights, chosen, 1);
}

TEST(SkinProxies, GiveBackWhatTheirCacheReceives) {
    std::mt19937 random(3);
    int tested = 0;
    for (int k = 0; k < 200; ++k) {
        const GatheringLights from = randomLights(random, k % 2 == 0 ? 1.f : -0.8f);
        GatheringCache cache{.position = {0.1f, 0, 0.2f}, .normal = {0, 1, 0}};
        cache.exponent = float(1 + k % 40);
        cache.mirrored = glm::normalize(glm::vec3(0.3f, 1, 0.2f));
        const CacheSums sums = gatherLight(from, cache);
        const ProxyLight diffuse = diffuseProxy(cache, {&sums.diffuse, 1});
        EXPECT_NEAR(irradianceOf(diffuse, cache, diffuse.fluxOfLight * sums.diffuse.light.x),
                    sums.diffuse.light.x, 1e-5f * sums.diffuse.light.x);
        const glm::vec3 way = glm::normalize(diffuse.position - cache.position);
        EXPECT_GE(way.y, kMinProxyCosine * 0.9999f);
        const ProxyLight glossy = glossyProxy(cache, {&sums.glossy, 1});
        const glm::vec3 to = glm::normalize(glossy.position - cache.position);
        if (std::pow(std::max(glm::dot(to, cache.mirrored), 0.f), cache.exponent) < kMinProxyLobe)
            continue; // its limit acts
        ++tested;
        const float lit = irradianceOf(glossy, cache, glossy.fluxOfLight * sums.glossy.light.y) *
                          glossLobe(cache.exponent, cache.mirrored, to);
        EXPECT_NEAR(lit, sums.glossy.light.y, 1e-5f * sums.glossy.light.y);
    }
    EXPECT_GT(tested, 100);
}

// Sums of a cache against a loop over the formulas.
TEST(SkinProxies, GatherWhatTheFormulasSay) {
    VirtualLights lights;
    lights.add({1, 2, 0.5f}, glm::normalize(glm::vec3(-1, -1, 0)), {3, 2, 1}, 0.2f, 0, 0);
    lights.add({-1, 1, 0}, glm::normalize(glm::vec3(1, -2, 0)), {1, 5, 2}, 0.1f, 0, 1);
    lights.add({-1, -1, 0}, glm::normalize(glm::vec3(1, 1, 0)), {9, 9, 9}, 0.1f, 0, 2); // below
    GatheringCache cache{.position = glm::vec3(0),
                         .normal = {0, 1, 0},
                         .mirrored = glm::normalize(glm::vec3(0.2f, 1, 0)),
                         .exponent = 3.5f};
    ChosenLights chosen = allLights(lights);
    chosen.weight = {1, 2, 3};
    const CacheSums sums = gatherLight(gatheringLights(lights, chosen, 0.01f), cache);
    double e = 0, g = 0, w = 0, wg = 0;
    glm::dvec3 first(0);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const glm::dvec3 d(lights.positionOf(i));
        const double r2 = glm::dot(d, d), r = std::sqrt(r2);
        const double leaving = std::max(-glm::dot(glm::dvec3(lights.normalOf(i)), d) / r, 0.);
        const double arriving = std::max(d.y / r, 0.), area = double(lights.area[i]);
        const double transfer = leaving * arriving / (area + std::numbers::pi * r2);
        const double lobe = std::pow(std::max(glm::dot(glm::dvec3(cache.mirrored), d) / r, 0.),
                                     double(cache.exponent));
        const double weight = double(chosen.weight[i]), flux = double(lights.flux[0][i]);
        e += weight * flux * transfer;
        g +=
            weight * flux * transfer * lobe * (double(cache.exponent) + 2) / (2 * std::numbers::pi);
        w += weight * area * (1e-2 + transfer); // 1e-6 / D^2
        wg += weight * area * (1e-2 + transfer * lobe);
        first += d * weight * area * (1e-2 + transfer);
    }
    EXPECT_NEAR(double(sums.diffuse.light.x) / e, 1, 1e-5);
    EXPECT_NEAR(double(sums.glossy.light.x) / g, 1, 1e-5);
    EXPECT_NEAR(double(sums.diffuse.weight) / w, 1, 1e-5);
    EXPECT_NEAR(double(sums.glossy.weight) / wg, 1, 1e-5);
    EXPECT_LT(glm::length(glm::dvec3(sums.diffuse.first) - first), 1e-5 * glm::length(first));
}

/// A square in the plane y = 0 that faces up, with caches.
struct Plane {
    Scene scene;
    std::shared_ptr<LightCaches> caches;
    LightmapLayout layout;

    explicit Plane(float spacing, float roughness = 1, float half = 3) {
        simple::SceneBuilder b;
        Material m = simple::lambert(glm::vec3(0.5f));
        m.roughness = roughness;
        b.addMaterial(m);
        b.add(simple::quad({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0}));
        scene = b.build();
        MeshSkins skins;
        caches = std::make_shared<LightCaches>(skins.place(scene, {spacing, 0.5f, false}));
        layout = layoutWithoutLightmap(scene);
    }
    FieldPoint at(const IndirectField& field, glm::vec3 p, glm::vec3 n = {0, 1, 0}) const {
        return {.field = field,
                .layout = layout,
                .scene = scene,
                .instance = 0,
                .triangle = 0,
                .u = 0,
                .v = 0,
                .position = p,
                .normal = n};
    }
    /// The field of one virtual light for an eye.
    IndirectField lit(const VirtualLights& lights, std::optional<glm::vec3> eye) const {
        const std::vector<float> exponents =
            eye ? glossExponents(scene, *caches) : std::vector<float>();
        std::vector<CacheSums> sums;
        gatherLights(*caches, exponents, gatheringLights(lights, allLights(lights), 1),
                     eye ? &*eye : nullptr, sums);
        SkinPart::Light light{caches, {}, std::vector<glm::vec3>(2 * caches->size()), eye};
        for (std::size_t c = 0; c < caches->size(); ++c) {
            const GatheringCache cache =
                gatheringCache(*caches, exponents, eye ? &*eye : nullptr, c);
            CacheProxies both{diffuseProxy(cache, {&sums[c].diffuse, 1}),
                              glossyProxy(cache, {&sums[c].glossy, 1})};
            light.flux[c] = sums[c].diffuse.light * both.diffuse.fluxOfLight;
            light.flux[caches->size() + c] = sums[c].glossy.light * both.glossy.fluxOfLight;
            light.proxies.push_back(both);
        }
        IndirectField field;
        field.bands = 2;
        field.parts = {std::make_shared<const SkinPart>(std::move(light))};
        return field;
    }
};

/// A light without extent at `p` that faces down.
VirtualLights lightAt(glm::vec3 p) {
    VirtualLights lights;
    lights.add(p, {0, -1, 0}, glm::vec3(1), 1e-8f, 0, 0);
    return lights;
}

// A plane with caches below the light and one away from there, and a point halfway: the proxies' E
// is off by +2.3 % and -4.6 %, E interpolated by +108 % and -2.3 %.
TEST(SkinProxies, InterpolateBetterThanIrradianceDoesNearALight) {
    struct Case {
        float height, proxies, irradiance;
    };
    for (const Case& k : {Case{0.5f, 0.023f, 1.08f}, Case{1, -0.046f, -0.023f}}) {
        const VirtualLights lights = lightAt({0, k.height, 0});
        const GatheringLights from = gatheringLights(lights, allLights(lights), 1);
        glm::vec3 place(0);
        float flux = 0, mean = 0;
        for (const float x : {0.f, 1.f}) {
            const GatheringCache cache{.position = {x, 0, 0}, .normal = {0, 1, 0}};
            const CacheSums sums = gatherLight(from, cache);
            const ProxyLight proxy = diffuseProxy(cache, {&sums.diffuse, 1});
            place += proxy.position / 2.f;
            flux += proxy.fluxOfLight * sums.diffuse.light.x / 2;
            mean += sums.diffuse.light.x / 2;
        }
        const GatheringCache middle{.position = {0.5f, 0, 0}, .normal = {0, 1, 0}};
        const float truth = gatherLight(from, middle).diffuse.light.x;
        const float found = irradianceOf({.position = place}, middle, flux);
        std::printf("height %g: proxies %+.2f %%, irradiance %+.2f %%\n", double(k.height),
                    double(100 * (found / truth - 1)), double(100 * (mean / truth - 1)));
        EXPECT_NEAR(found / truth - 1, k.proxies, 0.001f);
        EXPECT_NEAR(mean / truth - 1, k.irradiance, 0.003f);
    }
}

// The error falls with the square of the caches' distance.
TEST(SkinProxies, LightAPlaneAsTheLightDoes) {
    const VirtualLights lights = lightAt({0.2f, 1, -0.1f});
    const GatheringLights from = gatheringLights(lights, allLights(lights), 1);
    std::vector<double> worst;
    for (const float spacing : {0.08f, 0.04f, 0.02f}) {
        const Plane plane(spacing, 1, 2);
        const IndirectField field = plane.lit(lights, {});
        double largest = 0;
        for (float x = -1.5f; x < 1.5f; x += 0.037f) {
            const glm::vec3 p(x, 0, 0.3f * x);
            const float truth =
                gatherLight(from, {.position = p, .normal = {0, 1, 0}}).diffuse.light.x;
            const float found = sampleIrradiance(plane.at(field, p)).x;
            largest = std::max(largest, std::abs(double(found / truth) - 1));
        }
        std::printf("spacing %g: off by up to %.4f\n", double(spacing), largest);
        worst.push_back(largest);
    }
    EXPECT_LT(worst[1], 0.5 * worst[0]);
    EXPECT_LT(worst[2], 0.5 * worst[1]);
    EXPECT_LT(worst[2], 0.02);
}

// Of facets with exponent 100, the highlight lies where the eye's way is mirrored to the light.
TEST(SkinProxies, PeakAtTheMirroredPoint) {
    const float roughness = std::sqrt(std::sqrt(2.f / 402)); // (2 / alpha^2 - 2) / 4 = 100
    ASSERT_NEAR(glossExponent(roughness), 100, 0.1f);
    const glm::vec3 eye(-1, 1, 0);
    const VirtualLights lights = lightAt({1, 1, 0});
    constexpr float kPixel = 0.04f;
    for (const float spacing : {0.01f, 0.02f, 0.05f, 0.1f}) {
        const Plane plane(spacing, roughness);
        const IndirectField field = plane.lit(lights, eye);
        float peak = 0, best = 0;
        for (int k = -30; k <= 30; ++k) {
            const float x = kPixel * float(k);
            const float light = sampleLobe(plane.at(field, {x, 0, 0.013f}), {0, 1, 0}, 2, {1}).x;
            if (light > best) {
                best = light;
                peak = x;
            }
        }
        std::printf("spacing %g: peak at %g\n", double(spacing), double(peak));
        EXPECT_GT(best, 0);
        EXPECT_LE(std::abs(peak), kPixel * 1.001f);
    }
}

/// Caches at given places.
LightCaches cachesAt(const std::vector<glm::vec3>& places, const std::vector<glm::vec3>& normals,
                     const std::vector<float>& areas) {
    LightCaches caches;
    caches.position = places;
    caches.normal = normals;
    caches.area = areas;
    caches.instance.assign(places.size(), 0);
    return caches;
}

TEST(SkinProxies, AreShadedByHalfWhereADiscAsLargeIsHalfASideOff) {
    EXPECT_NEAR(overlapOf({{0, 0}, 0.2f}, {{0.1f, 0}, 0.2f}) / 0.04f, 0.5f, 1e-6f);
    EXPECT_EQ(overlapOf({{0, 0}, 0.2f}, {{0.1f, -0.3f}, 0.2f}), 0);
    constexpr float kFactor = 0.01f, kDistance = 2, kDisc = 0.8f;
    const float side = std::sqrt(kPi * kFactor), off = side / 2;
    // A proxy straight above with (R / r)^2 = F, and a disc that faces the cache with the same F.
    ProxyLight proxy{.position = {0, 0, kDistance}, .fluxOfLight = 1};
    proxy.deviation.y = kDistance * std::sqrt(kFactor) / 2;
    const glm::vec3 way(off, 0, std::sqrt(1 - off * off));
    const float area = kFactor * kPi * kDisc * kDisc / (way.z - kFactor);
    for (const float distance : {kDisc, 3.f}) { // between, and beyond the proxy
        const LightCaches caches = cachesAt({glm::vec3(0), way * distance}, {{0, 0, 1}, -way},
                                            {0.01f, area * distance * distance / (kDisc * kDisc)});
        const float shade = ShadingDiscs(caches).shadeOf(0, proxy);
        EXPECT_NEAR(shade, distance < kDistance ? 0.5f : 0.f, 1e-3f) << distance;
    }
    // Discs that face away, and a sphere that holds the cache, shade nothing.
    const LightCaches away = cachesAt({glm::vec3(0), way * kDisc}, {{0, 0, 1}, way}, {0.01f, area});
    EXPECT_EQ(ShadingDiscs(away).shadeOf(0, proxy), 0);
    const LightCaches facing =
        cachesAt({glm::vec3(0), way * kDisc}, {{0, 0, 1}, -way}, {0.01f, area});
    proxy.deviation.y = kDistance;
    EXPECT_EQ(ShadingDiscs(facing).shadeOf(0, proxy), 0);
}

// (1 - d / d_max) sqrt(n . n_c), d_max being twice the distance of the farthest where there are
// fewer than 16.
TEST(SkinProxies, AreWeightedByDistanceAndDirection) {
    const glm::vec3 up(0, 0, 1), tilted(0.6f, 0, 0.8f);
    std::vector<glm::vec3> places = {{1, 0, 0}, {0, 2, 0}, {-3, 0, 0}, {0.5f, 0, 0}};
    std::vector<glm::vec3> normals = {up, tilted, up, -up};
    const LightCaches few = cachesAt(places, normals, std::vector<float>(4, 1));
    const std::vector<std::uint32_t> list = {0, 1, 2, 3};
    const SkinWeights four = skinWeights(few, list, glm::vec3(0), up);
    ASSERT_EQ(four.count, 3U) << "one faces away";
    const double w[] = {1 - 1 / 6., (1 - 2 / 6.) * std::sqrt(0.8), 1 - 3 / 6.};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(double(four.weight[i]), w[i] / (w[0] + w[1] + w[2]), 1e-6);
    for (std::size_t k = places.size(); k < 16; ++k) {
        places.emplace_back(0, 0, -4);
        normals.push_back(up);
    }
    std::vector<std::uint32_t> all(16);
    std::iota(all.begin(), all.end(), 0U);
    const SkinWeights full =
        skinWeights(cachesAt(places, normals, std::vector<float>(16, 1)), all, glm::vec3(0), up);
    ASSERT_EQ(full.count, 3U) << "the farthest count for nothing";
    EXPECT_NEAR(full.weight[0] / full.weight[2], (1 - 1 / 4.f) / (1 - 3 / 4.f), 1e-5f);
    // Ways from the eye, mirrored at both places, in the place of normals.
    const glm::vec3 eye(0, 0, 5);
    const SkinWeights glossy = glossyWeights(few, list, glm::vec3(0), up, eye);
    const auto mirrored = [&](std::size_t c) {
        return glm::reflect(glm::normalize(few.position[c] - eye), few.normal[c]);
    };
    const double g0 = w[0] * std::sqrt(double(glm::dot(up, mirrored(0)))),
                 g2 = w[2] * std::sqrt(double(glm::dot(up, mirrored(2))));
    ASSERT_EQ(glossy.cache[0], 0U);
    const std::size_t third = glossy.cache[1] == 2 ? 1 : 2;
    EXPECT_NEAR(double(glossy.weight[0] / glossy.weight[third]), g0 / g2, 1e-5);
}

// The grid of candidates finds what a loop over all caches finds.
TEST(SkinProxies, AreShadedByAllDiscsBetween) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto vector = [&] {
        return glm::vec3(uniform(random), uniform(random), uniform(random));
    };
    LightCaches caches;
    caches.spacing = 0.05f;
    for (int k = 0; k < 1500; ++k) {
        caches.position.push_back(vector() * 2.f);
        caches.normal.push_back(glm::normalize(vector()));
        caches.area.push_back(0.02f * std::abs(uniform(random)));
        caches.instance.push_back(0);
    }
    LightCaches coarse = caches; // one cell holds all of them
    coarse.spacing = 10;
    const ShadingDiscs fine(caches), whole(coarse);
    int shaded = 0;
    for (std::size_t c = 0; c < 300; ++c) {
        ProxyLight proxy{.position = caches.position[c] + caches.normal[c] + 0.5f * vector(),
                         .deviation = glm::vec3(0.05f),
                         .fluxOfLight = 1};
        const float a = fine.shadeOf(c, proxy), b = whole.shadeOf(c, proxy);
        EXPECT_NEAR(a, b, 1e-5f);
        shaded += b > 0 ? 1 : 0;
    }
    EXPECT_GT(shaded, 20);
}

} // namespace
} // namespace limn::skin_proxies_test
