// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/links/link_harmonics.h"

#include "engine/core/parallel.h"
#include "engine/math/cone.h"
#include "engine/math/horizon.h"
#include "engine/techniques/illuminance/bake/links/build_links.h"
#include "engine/techniques/illuminance/format/link_storage.h"
#include "tests/techniques/illuminance/bake/traced_room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limn::link_harmonics_test {
namespace {

using namespace simple;

constexpr double kPi = std::numbers::pi;
constexpr int kBands = 4, kCount = kBands * kBands;

/// The nine coefficients, by hand, of radiance 1 from the strip |z| < s, |phi| < p of the sphere.
std::array<double, 9> stripHarmonics(double s, double p) {
    std::array<double, 9> c{};
    c[0] = std::sqrt(1 / (4 * kPi)) * 2 * s * 2 * p;
    c[3] = std::sqrt(3 / (4 * kPi)) * (s * std::sqrt(1 - s * s) + std::asin(s)) * 2 * std::sin(p);
    c[6] = std::sqrt(5 / (16 * kPi)) * (2 * s * s * s - 2 * s) * 2 * p;
    c[8] = std::sqrt(15 / (16 * kPi)) * (2 * s - 2 * s * s * s / 3) * std::sin(2 * p);
    return c;
}

TEST(LinkHarmonics, OfAStripAreTheClosedFormWhichNoConeIs) {
    constexpr int kAcross = 16, kAlong = 128;
    const double s = 0.05, p = kPi / 3, each = 4 * s * p / (kAcross * kAlong);
    float c[9] = {};
    glm::vec3 moment{0};
    for (int i = 0; i < kAcross; ++i)
        for (int k = 0; k < kAlong; ++k) {
            const double z = s * ((i + 0.5) / kAcross * 2 - 1),
                         phi = p * ((k + 0.5) / kAlong * 2 - 1), r = std::sqrt(1 - z * z);
            const glm::vec3 d(r * std::cos(phi), r * std::sin(phi), z);
            addHarmonics(3, d, 0, float(each), c);
            moment += d * float(each);
        }
    float y[9], g[3];
    const double all = 4 * s * p, length = double(glm::length(moment));
    shBasis(3, moment / float(length), y);
    coneFactors(3, float(2 * (1 - length / all)), g);
    const std::array<double, 9> exact = stripHarmonics(s, p);
    double error = 0, ofCone = 0;
    for (int i = 0; i < 9; ++i) {
        const double cone = all * double(g[i == 0 ? 0 : i < 4 ? 1 : 2] * y[i]);
        EXPECT_NEAR(c[i], exact[std::size_t(i)], 1e-4 * exact[0]) << i;
        error += std::pow(double(c[i]) - exact[std::size_t(i)], 2);
        ofCone += std::pow(cone - exact[std::size_t(i)], 2);
    }
    EXPECT_GT(std::sqrt(ofCone), 0.2 * exact[0]) << "a cone is round";
    EXPECT_LT(error, 1e-6 * ofCone);
}

TEST(LinkHarmonics, OfASampleWithAConeAreTheCones) {
    const glm::vec3 d = glm::normalize(glm::vec3(1, -2, 0.5f));
    float c[kCount] = {}, y[kCount], g[kBands];
    addHarmonics(kBands, d, 0.3f, 0.25f, c);
    shBasis(kBands, d, y);
    coneFactors(kBands, 0.3f, g);
    for (int i = 0; i < kCount; ++i)
        EXPECT_NEAR(c[i], 0.25f * g[int(std::sqrt(i))] * y[i], 1e-6f) << i;
}

// The two faces of a gable roof, whose light continues below the horizontal. Light from the zenith
// meets both at 45 degrees, and light from the side meets one of them.
TEST(IrradianceAxis, IsTheMeanOfSeveralNormals) {
    const float a = std::sqrt(0.5f);
    const std::vector<glm::vec3> roof = {{a, a, 0}, {-a, a, 0}};
    for (const glm::vec3 direction : {glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)}) {
        float sh[9];
        shBasis(3, direction, sh);
        std::array<glm::vec3, 9> continued;
        for (std::size_t i = 0; i < 9; ++i)
            continued[i] = glm::vec3(sh[i]);
        const glm::vec3 up(0, 1, 0);
        continueBelow(up, continued.data());
        double mean = 0;
        for (const glm::vec3& n : roof)
            mean += double(shIrradiance(3, continued.data(), n).x) / 2;
        EXPECT_NEAR(IrradianceAxis(3, roof, up).irradiance(sh), mean, 1e-6);
    }
}

TEST(IrradianceAxis, ScalesToTheIrradianceWithinBounds) {
    const glm::vec3 n = glm::normalize(glm::vec3(0.2f, 0.9f, -0.4f)),
                    beside = glm::normalize(glm::cross(n, glm::vec3(1, 0, 0)));
    for (const int bands : {2, 3}) {
        const IrradianceAxis axis(bands, {&n, 1}, n);
        const auto of = [&](glm::vec3 direction) {
            std::array<float, 9> c{};
            addHarmonics(bands, direction, 0, 0.1f, c.data());
            return c;
        };
        // (1/4 + cos/2 + 5/16 P_2) times the transport.
        EXPECT_NEAR(axis.irradiance(of(n).data()), bands == 2 ? 0.075f : 0.10625f, 1e-6f);
        EXPECT_NEAR(axis.irradiance(of(beside).data()), bands == 2 ? 0.025f : 0.009375f, 1e-6f);
        EXPECT_NEAR(axis.gainTo(0.1f, of(n).data()), bands == 2 ? 4 / 3.f : 16 / 17.f, 1e-5f);
        EXPECT_EQ(axis.gainTo(0.1f, of(beside).data()), 2);
        EXPECT_EQ(axis.gainTo(0.1f, std::array<float, 9>().data()), 1);
    }
}

/// A bake of a closed room up to its links, without or with a lamp so small that caches aim at it.
struct Room : TracedRoom {
    static Scene build(bool lit) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0.5f)));
        b.add(box(glm::vec3(0), glm::vec3(2, 2, 3), true));
        if (!lit)
            return b.build();
        Material lamp = lambert(glm::vec3(0));
        lamp.emission = glm::vec3(10);
        b.addMaterial(lamp);
        b.add(box(glm::vec3(0.9f, 1.7f, 1.4f), glm::vec3(1.1f, 1.8f, 1.6f), false));
        Scene scene = b.build();
        scene.instances.back().material = 1;
        return scene;
    }

    explicit Room(bool lit) : TracedRoom(build(lit)) {}

    Caches linked(std::uint32_t links, int bands) const {
        Caches result = caches;
        buildLinks(set.surfels, tree, hits, points, {},
                   {CutCriterion::SolidAngle, links, bands, LinkStorage::Sh}, {}, result);
        return result;
    }
};

const Room& room() {
    static const Room r(true);
    return r;
}

using Harmonics = std::array<double, kCount>;

/// Of one sample, by its definition.
void addSample(glm::vec3 direction, float u, float transport, Harmonics& to) {
    float y[kCount], g[kBands];
    shBasis(kBands, direction, y);
    coneFactors(kBands, u, g);
    for (int i = 0; i < kCount; ++i)
        to[std::size_t(i)] += double(transport) * double(g[int(std::sqrt(i))] * y[i]);
}

/// What a cache sees: per link, by climbing the tree from each sample's sender; and its irradiance.
struct SeenByLink {
    std::vector<Harmonics> harmonics;
    std::vector<double> irradiance, transport;
    std::uint32_t rays = 0, aimed = 0;
};

SeenByLink seenByLink(const Room& r, const Caches& caches, std::uint32_t c) {
    SeenByLink result;
    const std::uint32_t first = caches.linkBegin[c], count = caches.linkBegin[c + 1] - first;
    result.harmonics.resize(count);
    result.irradiance.resize(count);
    result.transport.resize(count);
    const auto add = [&](std::uint32_t node, glm::vec3 d, float u, float transport, float cosine) {
        const auto at = [&] {
            return std::find(caches.shNode.begin() + first, caches.shNode.begin() + first + count,
                             node) -
                   caches.shNode.begin() - first;
        };
        while (at() == std::ptrdiff_t(count) && r.tree.parent[node] != ~0U)
            node = r.tree.parent[node];
        const auto link = std::size_t(at());
        ASSERT_LT(link, count) << "every sample falls under a link";
        addSample(d, u, transport, result.harmonics[link]);
        result.irradiance[link] += double(transport * cosine);
        result.transport[link] += double(transport);
    };
    const CacheRays rays = raysOf(caches, r.points, c, r.hits.rays);
    const std::uint32_t* sender = r.hits.sender.data() + std::size_t(c) * r.hits.rays;
    const auto left = std::count(sender, sender + r.hits.rays, GatherHits::kExcluded);
    const float all = float(r.hits.rays) / float(r.hits.rays - std::uint32_t(left));
    for (std::uint32_t k = 0; k < r.hits.rays; ++k)
        if (sender[k] < GatherHits::kFirstMark) {
            add(sender[k], rays[k], 0, rays.local.solidAngle(k) / float(kPi) * all,
                rays.local[k].z);
            ++result.rays;
        }
    for (std::uint32_t k = r.hits.aimedBegin[c]; k < r.hits.aimedBegin[c + 1]; ++k) {
        const SubtendedSolidAngle v =
            solidAngleOf(r.set.surfels, r.hits.lamps, r.points, caches.kind[c], r.hits.aimed[k]);
        add(r.hits.aimed[k].sender, v.direction, v.transport / r.hits.aimed[k].scale / 2,
            v.transport, v.cosTheta);
        ++result.aimed;
    }
    return result;
}

TEST(LinkHarmonics, AreThoseOfTheSamplesUnderTheNode) {
    const Caches caches = room().linked(24, kBands);
    const auto factors = irradianceFactors();
    std::uint32_t grid = 0, surface = 0, aimed = 0;
    for (std::uint32_t c = 0; c < caches.size(); ++c) {
        const SeenByLink seen = seenByLink(room(), caches, c);
        aimed += seen.aimed;
        const bool hemisphere = caches.kind[c] == CacheKind::Hemisphere;
        float is[kCount], y[kCount];
        shBasis(kBands, caches.normal[c], y);
        for (std::uint32_t k = caches.linkBegin[c]; k < caches.linkBegin[c + 1]; ++k) {
            const std::size_t link = k - caches.linkBegin[c];
            expandLink(caches, c, k, kBands, is);
            double series = 0, irradiance = 0;
            for (int i = 0; i < 9; ++i) {
                const double axis = double(factors[std::size_t(std::sqrt(i))] * y[i]);
                series += axis * seen.harmonics[link][std::size_t(i)];
                irradiance += axis * double(is[i]);
            }
            const double gain = hemisphere ? std::min(seen.irradiance[link] / series, 2.) : 1;
            const double near = 2e-3 * gain * seen.transport[link] + 1e-7; // halfs
            for (int i = 0; i < kCount; ++i)
                ASSERT_NEAR(is[i], gain * seen.harmonics[link][std::size_t(i)], near)
                    << c << " " << i;
            if (hemisphere && gain < 2) {
                ASSERT_NEAR(irradiance, seen.irradiance[link], near) << c;
            } else if (!hemisphere) {
                ASSERT_NEAR(linkWeight(caches, c, k).transport / seen.transport[link], 1, 1e-3);
            }
            ++(hemisphere ? surface : grid);
        }
    }
    EXPECT_GT(surface, 5000U);
    EXPECT_GT(grid, 100U);
    EXPECT_GT(aimed, 1000U);
}

TEST(LinkHarmonics, OfAWhiteFurnaceAreThoseOfConstantRadiance) {
    const Room dark(false);
    const Caches caches = dark.linked(24, kBands);
    std::uint32_t cells = 0, surface = 0;
    for (std::uint32_t c = 0; c < caches.size(); ++c) {
        Harmonics sum{};
        float is[kCount], y[kCount];
        double rounded = 0;
        for (std::uint32_t k = caches.linkBegin[c]; k < caches.linkBegin[c + 1]; ++k) {
            expandLink(caches, c, k, kBands, is);
            for (int i = 0; i < kCount; ++i)
                sum[std::size_t(i)] += double(is[i]);
            rounded += 0x1p-11 * double(is[0]);
        }
        shBasis(kBands, caches.normal[c], y);
        if (caches.kind[c] == CacheKind::Grid) {
            // 1 / pi all around; of the rays' heights, which are in z, the means are exact.
            EXPECT_NEAR(sum[0], 4 * std::sqrt(1 / (4 * kPi)), rounded);
            for (const std::size_t zonal : {2U, 6U, 12U})
                EXPECT_NEAR(sum[zonal], 0, 4 * rounded) << "Y_i0";
            ++cells;
            continue;
        }
        bool flat = true; // else its rays are spread about several normals
        for (std::uint32_t p = dark.points.begin[c]; p < dark.points.begin[c + 1]; ++p)
            flat &= glm::dot(dark.points.normal[p], caches.normal[c]) > 0.9999f;
        if (!flat)
            continue;
        const auto factors = irradianceFactors();
        double irradiance = 0;
        for (int i = 0; i < 9; ++i)
            irradiance += double(factors[std::size_t(std::sqrt(i))] * y[i]) * sum[std::size_t(i)];
        EXPECT_NEAR(irradiance, 1, 2e-3) << c;
        ++surface;
    }
    EXPECT_EQ(cells, 8U);
    EXPECT_GT(surface, 200U);
}

TEST(LinkHarmonics, AreTheSameForAnyNumberOfThreads) {
    const auto with = [](int threads) {
        const ThreadLimit limit(threads);
        return room().linked(24, 3);
    };
    EXPECT_TRUE(with(1) == with(3));
}

} // namespace
} // namespace limn::link_harmonics_test
