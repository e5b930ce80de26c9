// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/sparse_probes.h"

#include "engine/core/parallel.h"
#include "engine/field/field_reading.h"
#include "engine/field/sample_field.h"
#include "engine/lightmap/texel_points.h"
#include "engine/stages/stage_store.h"
#include "tests/techniques/sparse_probes/lit_by_sparse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::sparse_probes_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A sphere of radius 2 seen from inside, with a lamp of 1 cd in its middle.
Scene litSphere(float albedo) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(albedo)));
    b.add(simple::sphere(2, 3, true));
    b.scene.lights = {pointLight(glm::vec3(0), 1)};
    return b.build();
}

TEST(SparseProbes, ASphereHasTheIrradianceOfOneBounceAndOfAll) {
    LitBySparse s(litSphere(0.5f));
    s.update(1);
    const double once = 0.5 * 4 * kPi / (4 * kPi * 4); // rho phi / (4 pi R^2)
    EXPECT_NEAR(s.mean().x, once, 0.02 * once);
    double worst = 0;
    for (std::size_t r = 0; r < s.bake().receivers.size(); ++r)
        worst = std::max(worst, std::abs(double(s.ofReceiver(r).x) - once) / once);
    EXPECT_LT(worst, 0.08);
    const LightingReport report = s.update();
    EXPECT_TRUE(report.converged);
    std::printf("sphere: one bounce %.4f (worst texel off by %.3f), all %.4f of %.4f\n",
                s.mean().x / 2, worst, s.mean().x, 2 * once);
    EXPECT_NEAR(s.mean().x, 0.5 / (1 - 0.5) / 0.5 * once, 0.02 * 2 * once);
}

TEST(SparseProbes, AFurnaceIsAsBrightAsItsProbesSee) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0), glm::vec3(2, 3, 4)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0.6f, 1}, {1.8f, 1.2f, 1.6f}, false));
    LitBySparse s(b.build());
    s.update();
    double unseen = 0;
    for (std::size_t r = 0; r < s.bake().receivers.size(); ++r) {
        const float u = s.bake().transport.unseen[r];
        unseen += double(u) / double(s.bake().receivers.size());
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(s.ofReceiver(r)[c], kPi * (2 + c) * double(1 - u), 0.02 * kPi * (2 + c));
    }
    std::printf("furnace: mean unseen share %.4f\n", unseen);
    EXPECT_LT(unseen, 0.02);
}

TEST(SparseProbes, ASkyLightsWhatLiesBelowIt) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0)));
    b.add(simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    b.scene.sky.radiance = glm::vec3(1, 2, 3);
    LitBySparse s(b.build(), {}, 100);
    s.update();
    for (std::size_t r = 0; r < s.bake().receivers.size(); ++r)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(s.ofReceiver(r)[c], kPi * (1 + c), 0.1 * kPi * (1 + c));
}

/// Two rooms of 4 x 2 x 4 m with a divider; the left one is lit.
Scene twoRooms(float divider) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.7f)));
    const float h = divider / 2;
    b.add(simple::box({-4 - h, 0, 0}, {-h, 2, 4}, true));
    b.add(simple::box({h, 0, 0}, {4 + h, 2, 4}, true));
    b.scene.lights = {pointLight({-2, 1.5f, 2}, 10)};
    return b.build();
}

TEST(SparseProbes, NoLightLeaksIntoARoomThatIsDark) {
    const float cell = 8.f / 12;
    for (const float cells : {0.05f, 0.25f, 1.f, 2.f}) {
        LitBySparse s(twoRooms(cells * cell), {{"sparse-probes.count", 54}});
        s.update();
        double sum[2] = {0, 0};
        float worst = 0;
        std::size_t count[2] = {0, 0};
        for (std::size_t r = 0; r < s.bake().receivers.size(); ++r) {
            const std::uint32_t room = s.bake().receivers.instance[r];
            sum[room] += double(s.ofReceiver(r).x);
            ++count[room];
            if (room == 1)
                worst = std::max(worst, s.ofReceiver(r).x);
        }
        const double lit = sum[0] / double(count[0]), leak = sum[1] / double(count[1]) / lit;
        std::printf("divider of %.2f cells: leak %.6f of the lit room, worst texel %.6f\n",
                    double(cells), leak, double(worst) / lit);
        EXPECT_GT(lit, 0.1);
        EXPECT_LT(leak, 1e-3);
        EXPECT_LT(double(worst), 0.01 * lit);
    }
}

TEST(SparseProbes, ScaleDoesNotChangeIrradiance) {
    std::vector<double> found;
    for (const float scale : {1e-3f, 1.f, 1e3f}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.6f)));
        const glm::mat4 toWorld = glm::scale(glm::mat4(1), glm::vec3(scale));
        b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true), toWorld);
        b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false), toWorld);
        b.scene.lights = {pointLight(scale * glm::vec3(2, 2.5f, 2), 5 * scale * scale)};
        LitBySparse s(b.build(), {}, 800);
        s.update();
        found.push_back(s.mean().x);
    }
    std::printf("scales of 0.001, 1, 1000: %.5f, %.5f, %.5f\n", found[0], found[1], found[2]);
    EXPECT_GT(found[1], 0.1);
    EXPECT_NEAR(found[0], found[1], 0.01 * found[1]);
    EXPECT_NEAR(found[2], found[1], 0.01 * found[1]);
}

TEST(SparseProbes, LightsAddUpAndTheirColoursNeedNoRay) {
    LitBySparse s(room(), {}, 800);
    s.scene.relight.maxBounces = 2; // each change restarts: the same bounces for all
    s.update(2);
    const glm::dvec3 sum = s.mean();
    glm::dvec3 parts(0);
    for (const std::size_t off : {0U, 1U}) {
        s.scene.lights[off].enabled = false;
        s.update(2);
        parts += s.mean();
        s.scene.lights[off].enabled = true;
    }
    EXPECT_NEAR(sum.x, parts.x, 1e-4 * sum.x);
    s.update(2);
    s.scene.lights[0].color = {2, 0, 1};
    s.scene.lights[1].color = {2, 0, 1};
    const LightingReport report = s.update(2);
    EXPECT_FALSE(report.skipped);
    EXPECT_EQ(counterOf(report, "shadow_rays"), 0);
    EXPECT_NEAR(s.mean().x, 2 * sum.x, 1e-4 * sum.x);
    EXPECT_EQ(s.mean().y, 0);
    EXPECT_NEAR(s.mean().z, sum.z, 1e-4 * sum.z);
}

TEST(SparseProbes, AMovedLampIsTracedAloneAndNothingIsDoneWhileNothingChanges) {
    LitBySparse s(room(), {}, 800);
    EXPECT_EQ(counterOf(s.update(), "lights_traced"), 2);
    const LightingReport idle = s.update();
    EXPECT_TRUE(idle.skipped);
    EXPECT_EQ(counterOf(idle, "shadow_rays") + counterOf(idle, "probe_updates"), 0);
    s.scene.lights[1].position = {3.5f, 2, 4};
    EXPECT_EQ(counterOf(s.update(), "lights_traced"), 1);
    LitBySparse fresh(s.scene, s.scene.technique.settings, 800);
    fresh.update();
    EXPECT_NEAR(s.mean().x, fresh.mean().x, 3e-3 * fresh.mean().x);
    const glm::dvec3 before = s.mean();
    s.scene.materials[0].baseColor = glm::vec4(0.2f, 0.2f, 0.2f, 1);
    s.update();
    EXPECT_LT(s.mean().x, 0.5 * before.x);
}

TEST(SparseProbes, AreTheSameWithAnyNumberOfThreadsAndInEachRun) {
    LitBySparse many(room(), {}, 800);
    many.update();
    const ThreadLimit one(1);
    LitBySparse single(room(), {}, 800);
    single.update();
    EXPECT_EQ(many.prepared.data->hash(), single.prepared.data->hash());
    EXPECT_EQ(many.lightmap(), single.lightmap());
}

TEST(SparseProbes, MovingObjectsAreLitByTheGrid) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0), glm::vec3(1)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::sphere(0.2f, 2, false), glm::translate(glm::mat4(1), glm::vec3(2, 1, 2)), true);
    LitBySparse s(b.build(), {}, 400);
    s.update();
    const IndirectField& field = *s.lighting->field();
    ASSERT_GT(field.cells(), 0U);
    const auto ofBall = [&](glm::vec3 normal) {
        return sampleIrradiance({field, s.bake().lightmap, s.scene, 1, 0, 0, 0,
                                 glm::vec3(2, 1, 2) + 0.2f * normal, normal});
    };
    EXPECT_NEAR(ofBall({0, 1, 0}).x, kPi, 0.02 * kPi);
    EXPECT_NEAR(ofBall({1, 0, 0}).y, kPi, 0.02 * kPi);
}

TEST(SparseProbes, AKeptPrecomputationEqualsAFreshOne) {
    const LitBySparse fresh(room(), {}, 800);
    StageStore store;
    const Precomputation& p = *kSparseProbesTechnique.precomputation;
    const auto first = p.prepare(*fresh.trace, {.store = &store}, {});
    const auto second = p.prepare(*fresh.trace, {.store = &store}, {});
    ASSERT_TRUE(first && second);
    EXPECT_EQ((*first)->hash(), fresh.prepared.data->hash());
    EXPECT_EQ((*second)->hash(), fresh.prepared.data->hash());
    EXPECT_EQ((*second)->report().keptStages,
              (std::vector<std::string>{"charts", "probes", "relight rays", "transport"}));
    EXPECT_EQ(counterOf((*second)->report().counts, "rays"), 0);
    // Other bands need the transport alone.
    TechniqueChoice choice = fresh.scene.technique;
    choice.settings["sparse-probes.bands"] = 3;
    const auto bands = p.prepare(*fresh.trace, {.choice = &choice, .store = &store}, {});
    ASSERT_TRUE(bands);
    EXPECT_EQ((*bands)->report().keptStages,
              (std::vector<std::string>{"charts", "probes", "relight rays"}));
}

TEST(SparseProbes, ACancelledPrecomputationSaysSoAndIsContinued) {
    const LitBySparse fresh(room(), {}, 800);
    const Precomputation& p = *kSparseProbesTechnique.precomputation;
    StageStore store;
    std::atomic<bool> cancel = false;
    Progress progress;
    progress.cancel = &cancel;
    progress.report = [&](const char* stage, float fraction) {
        if (std::string(stage) == "transport" && fraction > 0)
            cancel = true;
    };
    const auto stopped = p.prepare(*fresh.trace, {.store = &store}, progress);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().message, "cancelled");
    const auto resumed = p.prepare(*fresh.trace, {.store = &store}, {});
    ASSERT_TRUE(resumed);
    EXPECT_EQ((*resumed)->hash(), fresh.prepared.data->hash());
    EXPECT_LT(counterOf((*resumed)->report().counts, "rays"),
              counterOf(fresh.prepared.data->report().counts, "rays"));
}

TEST(SparseProbes, OnlyWhatIsReadChangesTheInputs) {
    const Precomputation& p = *kSparseProbesTechnique.precomputation;
    Scene scene = room();
    const std::uint64_t before = p.inputHash(scene);
    scene.lights.clear();
    scene.materials[0].baseColor = glm::vec4(0.1f);
    scene.bake.surfels /= 2;
    scene.technique.settings["sparse-probes.clamp"] = 1;
    EXPECT_EQ(p.inputHash(scene), before);
    for (const auto& [key, value] :
         {std::pair("sparse-probes.count", 30), std::pair("sparse-probes.bands", 2),
          std::pair("sparse-probes.rays", 100), std::pair("sparse-probes.cells", 20),
          std::pair("sparse-probes.unchecked", 1), std::pair("sparse-probes.compression", 5)}) {
        Scene other = scene;
        other.technique.settings[key] = value;
        EXPECT_NE(p.inputHash(other), before) << key;
    }
}

TEST(SparseProbes, CompressedTheyLightAlikeInLessMemoryAndAreKept) {
    const std::map<std::string, double> settings = {{"sparse-probes.compression", 10}};
    LitBySparse plain(room(), {}, 6000), packed(room(), settings, 6000);
    plain.update();
    packed.update();
    EXPECT_TRUE(packed.bake().transport.coefficients.empty());
    EXPECT_LT(transportBytes(packed.bake()), 0.5 * transportBytes(plain.bake()));
    EXPECT_EQ(totalOf(packed.prepared.data->report().bytes) -
                  totalOf(plain.prepared.data->report().bytes),
              transportBytes(packed.bake()) - transportBytes(plain.bake()));
    double squares = 0, sum = 0;
    const std::size_t n = plain.bake().receivers.size();
    for (std::size_t r = 0; r < n; ++r) {
        const glm::dvec3 exact(plain.ofReceiver(r)), d = glm::dvec3(packed.ofReceiver(r)) - exact;
        squares += glm::dot(d, d) / double(n);
        sum += (exact.x + exact.y + exact.z) / (std::sqrt(3.) * double(n));
    }
    EXPECT_LT(std::sqrt(squares) / sum, 0.1) << "more than may be lost";
    EXPECT_GT(squares, 0) << "something was lost";
    StageStore store;
    const Precomputation& p = *kSparseProbesTechnique.precomputation;
    ASSERT_TRUE(p.prepare(*packed.trace, {.store = &store}, {}));
    const auto again = p.prepare(*packed.trace, {.store = &store}, {});
    ASSERT_TRUE(again);
    EXPECT_EQ((*again)->hash(), packed.prepared.data->hash());
    EXPECT_EQ((*again)->report().keptStages.back(), "compression");
    const std::string path = testing::TempDir() + "limn_sparse_compressed_test.limnbake";
    ASSERT_TRUE(packed.prepared.data->write(path));
    const auto read = p.read(path, {});
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ((*read)->hash(), packed.prepared.data->hash());
}

// Of a few hundred texels that see many probes, next to nothing can be left out.
TEST(SparseProbes, ACompressionThatSavesNothingIsNotUsed) {
    const LitBySparse s(room(), {{"sparse-probes.compression", 1}}, 400);
    EXPECT_TRUE(s.bake().compressed.empty());
    EXPECT_FALSE(s.bake().transport.coefficients.empty());
    EXPECT_EQ(sparseDefect(s.bake(), &s.scene), "");
}

TEST(SparseProbes, ACompressionThatDoesNotFitIsADefect) {
    const LitBySparse s(room(), {{"sparse-probes.compression", 20}}, 600);
    ASSERT_FALSE(s.bake().compressed.empty());
    const auto broken = [&](const auto& change) {
        SparseBake bake = s.bake();
        change(bake);
        return !sparseDefect(bake, &s.scene).empty();
    };
    EXPECT_FALSE(broken([](SparseBake&) {}));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.receiver[0] = b.compressed.receiver[1]; }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.receiver.pop_back(); }));
    EXPECT_TRUE(broken([](SparseBake& b) { ++b.compressed.rank[0]; }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.rank.clear(); }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.probe[0] = kNoProbe; }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.left[0] = 0x7c00; }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.right[0] = 0x7e00; }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.receiverBegin[1] = 0; }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.probeBegin.back() += 1; }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.leftBegin[0] = 1; }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed.rightBegin.pop_back(); }));
    EXPECT_TRUE(broken([](SparseBake& b) { b.compressed = {}; })) << "nothing else is there";
}

TEST(SparseProbes, ADamagedFileIsRefused) {
    const LitBySparse s(room(), {}, 200);
    const std::string path = testing::TempDir() + "limn_sparse_probes_test.limnbake";
    ASSERT_TRUE(s.prepared.data->write(path));
    std::string bytes;
    {
        std::ifstream file(path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(file), {});
    }
    const auto refused = [&](const std::string& changed) {
        std::ofstream(path, std::ios::binary) << changed;
        return !kSparseProbesTechnique.precomputation->read(path, {});
    };
    EXPECT_FALSE(refused(bytes));
    EXPECT_TRUE(refused(bytes.substr(0, bytes.size() - 5)));
    EXPECT_TRUE(refused(bytes.substr(0, 12)));
    std::string flipped = bytes;
    flipped[bytes.size() / 2] = char(flipped[bytes.size() / 2] ^ 1);
    EXPECT_TRUE(refused(flipped));
}

/// With transport that is compressed by so many per cent.
void explainsWhereTheirLightComesFrom(double compression) {
    Scene scene = room();
    scene.sky.radiance = glm::vec3(1);
    scene.materials.push_back(simple::lambert(glm::vec3(0.5f), glm::vec3(3)));
    scene.instances[1].material = 1;
    LitBySparse s(scene, {{"sparse-probes.compression", compression}}, 800);
    ASSERT_EQ(s.bake().compressed.empty(), compression == 0);
    s.scene.relight.tolerance = 0.01f;
    s.update(200);
    const Instance& walls = s.scene.instances[0];
    const WorldPoint at = worldPoint(s.scene, walls, {0, glm::vec2(0.3f)});
    const FieldPoint point{*s.lighting->field(), s.bake().lightmap, s.scene, 0, 0, 0.3f, 0.3f,
                           at.position,          at.normal};
    FieldReading reading;
    addIrradiance(point, glm::vec3(1), reading);
    const glm::vec3 is = sampleIrradiance(point);
    const Explanation why = s.lighting->explain(s.scene, reading, {});
    ASSERT_GT(is.x, 0.1f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(totalOf(why.byOrigin)[c], is[c], 2e-3f * is[c]);
        EXPECT_NEAR(totalOf(why.bySender)[c], is[c], 2e-3f * is[c]);
    }
    EXPECT_GE(why.byOrigin.size(), 4U);
    // Without the block's light there is as much less as its row says.
    double emitted = 0;
    for (const LightRow& row : why.byOrigin)
        if (row.kind == LightRowKind::Surface)
            emitted += double(row.value.x);
    s.scene.materials[1].emission = glm::vec3(0);
    s.update(200);
    EXPECT_NEAR(double(is.x - sampleIrradiance(point).x), emitted, 5e-3 * double(is.x));
}

TEST(SparseProbes, ExplainWhereTheirLightComesFrom) {
    explainsWhereTheirLightComesFrom(0);
}

TEST(SparseProbes, ExplainWhereTheirCompressedLightComesFrom) {
    explainsWhereTheirLightComesFrom(20);
}

TEST(SparseProbes, NothingToLightAndStrangeLightsAreHarmless) {
    const Scene empty{.assets = std::make_shared<Assets>()};
    EXPECT_FALSE(kSparseProbesTechnique.precomputation->prepare(TraceScene(empty), {}, {}));
    Scene scene = room();
    scene.lights[0].strength = 1e10f;
    scene.lights[1].position = {1.4f, 0.6f, 1.3f}; // inside the block
    Light panel;
    panel.kind = LightKind::Rectangle;
    panel.position = {2, 2.9f, 2};
    scene.lights.push_back(panel);
    LitBySparse s(scene, {{"sparse-probes.clamp", 1}}, 400);
    s.update();
    for (const glm::vec4 c : s.lightmap())
        for (int k = 0; k < 4; ++k)
            EXPECT_TRUE(std::isfinite(c[k]));
    s.scene.lights.clear();
    s.update(64);
    s.update(64);
    EXPECT_LT(s.mean().x, 1e-3 * 1e10);
}

} // namespace
} // namespace limn::sparse_probes_test
