// SPDX-License-Identifier: MIT
#include "engine/scene/light/rectangle_light.h"
#include "engine/techniques/illuminance/stress/minimise.h"
#include "engine/techniques/illuminance/stress/scene_change.h"
#include "engine/techniques/illuminance/stress/stress_case.h"
#include "tests/core/sweep.h"
#include "tests/core/temporary_folder.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include <glm/geometric.hpp>

namespace limn::oracle_test {
namespace {

TEST(Oracles, AreMetByFifteenHostileScenes) {
    const TemporaryFolder folder;
    const std::vector<Oracle> oracles = engineOracles();
    std::vector<int> judged(oracles.size());
    for (std::uint64_t seed = 180; seed < 195; seed += kSanitized ? 5 : 1) {
        const CaseResult result = runCase(generatedCase(seed), oracles, {60, folder.path.string()});
        EXPECT_NE(result.end, CaseEnd::Slow) << seed;
        for (std::size_t k = 0; k < oracles.size(); ++k) {
            const Judgement& j = result.judgements[k];
            judged[k] += j.judged;
            EXPECT_FALSE(j.failed()) << oracles[k].name << " of seed " << seed << " is " << j.value
                                     << ", at most " << j.limit << ": " << result.note;
        }
    }
    if (kSanitized)
        return; // three scenes need not have something for each oracle to judge
    for (std::size_t k = 0; k < oracles.size(); ++k)
        EXPECT_GT(judged[k], 0) << oracles[k].name << " was never judged";
}

void expectAllMet(const std::vector<std::uint64_t>& seeds) {
    const TemporaryFolder folder;
    const std::vector<Oracle> oracles = engineOracles();
    for (const std::uint64_t seed : seeds) {
        const CaseResult result = runCase(generatedCase(seed), oracles, {60, folder.path.string()});
        for (std::size_t k = 0; k < oracles.size(); ++k)
            EXPECT_FALSE(result.judgements[k].failed()) << oracles[k].name << " of seed " << seed;
    }
}

// Links of needles and far lamps brought 0 / 0 of their light: not finite, not negative, not read
// back, and not what a baked file may hold.
TEST(Oracles, AreMetByScenesWhoseLinksWereNoNumbers) {
    expectAllMet({2975, 5618, 9075, 9559});
}

// Closed rooms of high albedo at a handful of texels: surfels read more light than was sent, and
// bounces were stopped because light grew, or a furnace was 18 % too bright.
TEST(Oracles, AreMetByScenesWhoseLightGrew) {
    expectAllMet({213, 819, 1409, 1752, 1832, 1944, 2875});
}

// Scenes of millimetres and less: a light that grew no further within 10 um was another one there.
TEST(Oracles, AreMetByScenesSmallerThanAMillimetre) {
    expectAllMet({16, 32, 98, 759, 3256, 4096});
}

/// A closed room with a lamp, of few bounces.
Subject room(const TemporaryFolder& folder) {
    Scene scene = *litRoom(150, 150);
    scene.relight.maxBounces = 8;
    return {3, *bakeAndLight(scene, {}), folder.path.string(), {}};
}

std::set<std::string> failing(const Subject& subject) {
    std::set<std::string> names;
    for (const Oracle& oracle : engineOracles())
        if (oracle.judge(subject).failed())
            names.emplace(oracle.name);
    return names;
}

TEST(Oracles, AreMetByARoom) {
    const TemporaryFolder folder;
    EXPECT_EQ(failing(room(folder)), std::set<std::string>());
}

TEST(Oracles, SeeLightThatIsNoNumberOrLessThanNone) {
    const TemporaryFolder folder;
    Subject subject = room(folder);
    subject.base.light.sh[5].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(failing(subject),
              (std::set<std::string>{"finite", "brightness", "increments", "threads", "file"}));
    subject = room(folder);
    subject.base.light.radiosity[5].y = -1e-6f;
    EXPECT_TRUE(failing(subject).contains("not_negative"));
}

TEST(Oracles, SeeLightThatIsALittleMoreThanItShouldBe) {
    const TemporaryFolder folder;
    Subject subject = room(folder);
    float& number = subject.base.light.sh[7].x;
    number = std::nextafter(number, 1e9f);
    const std::set<std::string> names = failing(subject);
    for (const char* name : {"increments", "threads", "file"})
        EXPECT_TRUE(names.contains(name)) << name;
    subject = room(folder);
    for (glm::vec4& b : subject.base.light.radiosity)
        b *= 1.002f;
    EXPECT_TRUE(failing(subject).contains("scale"));
}

// As a bake has them whose transport is not what the scene says.
TEST(Oracles, SeeLinksThatBringMoreLightThanThereIs) {
    const TemporaryFolder folder;
    Subject subject = room(folder);
    auto bake = std::make_shared<Bake>(*subject.base.bake);
    for (std::int8_t& e : bake->caches.linkExponent)
        e = std::int8_t(e - 5); // 32 times as much
    subject.base.bake = bake;
    subject.base.light =
        lightOf(bake, subject.base.scene, *subject.base.trace, 8, subject.progress);
    const std::set<std::string> names = failing(subject);
    for (const char* name : {"energy", "growth", "furnace_most", "scale", "translation", "axes",
                             "turn", "triangles", "objects", "threads", "rebake"})
        EXPECT_TRUE(names.contains(name)) << name;
    for (const char* linear : {"additivity", "order", "brightness", "increments"})
        EXPECT_FALSE(names.contains(linear)) << linear;
}

TEST(Oracles, SeeSumsThatDependOnTheirOrder) {
    const TemporaryFolder folder;
    Subject subject = room(folder);
    subject.base.scene.lights.push_back(subject.base.scene.lights[0]);
    // Together they are more than floats hold, and each of them is not. Only negative light, which
    // no reader lets through, is not held below kMaxIrradiance.
    for (Light& l : subject.base.scene.lights) {
        l.strength = 3e38f;
        l.color = {1, -1, 1};
    }
    EXPECT_TRUE(failing(subject).contains("additivity"));
}

TEST(SceneChanges, TurnARectangleWithItsScene) {
    Scene scene = *litRoom(64, 64);
    Light& light = scene.lights[0];
    light.kind = LightKind::Rectangle;
    light.direction = glm::normalize(glm::vec3(1, -2, 0.5f));
    light.roll = 0.7f;
    light.size = {2, 0.5f};
    const glm::mat3 turn(glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0));
    const LightRectangle before = lightRectangle(light),
                         after = lightRectangle(turnedScene(scene, turn).lights[0]);
    EXPECT_LT(glm::distance(turn * before.centre, after.centre), 1e-5f);
    EXPECT_LT(glm::distance(turn * before.halfWidth, after.halfWidth), 1e-5f);
    EXPECT_LT(glm::distance(turn * before.halfHeight, after.halfHeight), 1e-5f);
    EXPECT_LT(glm::distance(turn * before.normal, after.normal), 1e-5f);
}

TEST(Minimise, LeavesWhatAnOracleFailsBy) {
    const TemporaryFolder folder;
    StressCase failing;
    for (std::uint64_t seed = 0; failing.document.objects.size() < 12; ++seed)
        failing = generatedCase(seed);
    // Something that only one object of the scene is to blame for.
    std::size_t most = 0;
    for (const Mesh& m : failing.assets->meshes)
        most = std::max(most, m.triangleCount());
    const Oracle oracle{"large", "No mesh is as large as its largest.", [&](const Subject& s) {
                            std::size_t triangles = 0;
                            for (const Instance& i : s.base.scene.instances)
                                triangles =
                                    std::max(triangles, s.base.scene.meshOf(i).triangleCount());
                            return judged(double(triangles), double(most) - 1);
                        }};
    const StressCase small = minimised(failing, oracle, folder.path.string());
    const CaseResult again = runCase(small, {oracle}, {10, folder.path.string()});
    EXPECT_TRUE(again.judgements[0].failed());
    std::size_t nodes = 0, lights = 0;
    for (const auto& [id, object] : small.document.objects) {
        nodes += std::holds_alternative<Node>(object);
        lights += std::holds_alternative<Light>(object);
    }
    EXPECT_EQ(nodes, 1U);
    EXPECT_EQ(lights, 0U);
}

} // namespace
} // namespace limn::oracle_test
