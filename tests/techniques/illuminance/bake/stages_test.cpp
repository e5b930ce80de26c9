// SPDX-License-Identifier: MIT
// A bake that reads what earlier ones kept equals the bake that does everything, byte for byte.
#include "engine/core/parallel.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/bake/cut/training_light.h"
#include "engine/techniques/illuminance/bake/rays/light_points.h"
#include "engine/techniques/illuminance/bake/receivers/seen_patches.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "tests/techniques/illuminance/bake/house_on_ground.h"
#include "tests/techniques/illuminance/bake/staged_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <random>
#include <string_view>
#include <thread>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <unistd.h>

namespace limn::stages_test {
namespace {

using namespace simple;
namespace fs = std::filesystem;

/// Rays that look which points of the texels are open and on which side of walls they and the
/// surfels' patches lie, and where patches are seen; again whenever anything moves.
std::uint64_t looksOf(const Scene& scene) {
    const TraceScene trace(scene);
    std::uint64_t rays = 0;
    const auto atlas = atlasStage(trace, scene, hashMeshes(scene), {}, nullptr, rays);
    const SurfelSet set = placeSurfels(scene, scene.bake.surfels, atlas->surfels);
    CachePoints points;
    const Caches caches = placeCaches(scene, atlas->atlas, points);
    OwnerTables owners(scene, set);
    PatchSides sides = findPatchSides(trace, set, owners, {});
    rays += sides.rays;
    owners.part(std::move(sides));
    return rays + findSeenPatches(trace, set, owners, atlas->atlas, caches, points,
                                  scene.bake.rays / 16, {})
                      .rays;
}

std::string notesOf(const Bake& bake) {
    std::string all;
    for (const std::string& note : bake.notes)
        all += note + "\n";
    return all;
}

TEST(Stages, NothingIsTracedWhenOnlyLinksOrBandsChange) {
    StageStore store;
    Scene scene = stagedRoom({});
    const Bake first = baked(scene, &store);
    EXPECT_GT(first.counts.rays, 10000U);
    EXPECT_EQ(first.hash(), baked(scene).hash());
    const Bake again = baked(scene, &store);
    EXPECT_EQ(again.counts.rays, 0U);
    EXPECT_EQ(again.hash(), first.hash());
    scene.bake.links = 8;
    scene.bake.bands = 2;
    const Bake fewer = baked(scene, &store);
    EXPECT_EQ(fewer.counts.rays, 0U);
    EXPECT_EQ(fewer.hash(), baked(scene).hash());
}

/// Another value of a setting, within its range.
void change(std::uint32_t& value, const SettingRange& range) {
    value = value == std::uint32_t(range.upper) ? value - 1 : value + 1;
}
void change(float& value, const SettingRange&) {
    value += 0.25f;
}
void change(glm::uvec3& value, const SettingRange&) {
    value += 1U;
}
void change(bool& value) {
    value = !value;
}
template <class T>
void change(T& value, const SettingChoices& choices) {
    value = T((std::size_t(value) + 1) % choices.names.size());
}

TEST(Stages, TheHashOfABakesInputsHasEverySettingThatABakeDependsOnAndNoOther) {
    const Scene start = stagedRoom({});
    BakeSettings defaults;
    visitBakeSettings(defaults, [&](const Setting& setting, auto&, const auto&...) {
        Scene scene = start;
        visitBakeSettings(scene.bake,
                          [&](const Setting& other, auto& value, const auto&... limits) {
                              if (std::string_view(other.key) == setting.key)
                                  change(value, limits...);
                          });
        EXPECT_NE(bakeInputHash(scene), bakeInputHash(start)) << setting.key;
    });
    const RelightSettings usual;
    visitRelightSettings(usual, [&](const Setting& setting, auto&, const auto&...) {
        Scene scene = start;
        visitRelightSettings(scene.relight,
                             [&](const Setting& other, auto& value, const auto&... limits) {
                                 if (std::string_view(other.key) == setting.key)
                                     change(value, limits...);
                             });
        EXPECT_NE(scene.relight, start.relight) << setting.key;
        EXPECT_EQ(bakeInputHash(scene), bakeInputHash(start)) << setting.key;
    });
}

/// About the number of rays that find where direct light falls on surfels, again whenever other
/// rays meet them: one for each candidate, two to raise the surfel's place, and two to see that no
/// wall hides a chosen point.
std::uint64_t lightPointRaysOf(const Bake& made) {
    return std::uint64_t(kLightCandidates + 2 + 2 * kLightPoints) * made.surfels.size();
}

TEST(Stages, OtherRaysTraceEverything) {
    StageStore store;
    Scene scene = stagedRoom({});
    baked(scene, &store);
    scene.bake.rays = 130;
    const Bake more = baked(scene, &store);
    const Bake full = baked(scene);
    EXPECT_EQ(more.counts.rays, full.counts.rays - looksOf(scene)); // surfels are where they were
    EXPECT_EQ(more.hash(), full.hash());
}

TEST(Stages, MovingABlockTracesOnlyWhatMeetsItAndEqualsAFullBake) {
    const glm::mat4 low = Blocks().low;
    const glm::mat4 moves[] = {
        glm::translate(low, glm::vec3(0.1f, 0, 0.3f)), glm::rotate(low, 0.4f, glm::vec3(0, 1, 0)),
        glm::translate(low, glm::vec3(-1.2f, 0.7f, 1)), // into the other block
    };
    std::vector<Scene> scenes;
    std::vector<Bake> full;
    std::vector<std::uint64_t> looks;
    for (const glm::mat4& move : moves) {
        scenes.push_back(stagedRoom({.low = move}));
        full.push_back(baked(scenes.back()));
        looks.push_back(looksOf(scenes.back()) + lightPointRaysOf(full.back()));
    }
    for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        StageStore store;
        const Bake start = baked(stagedRoom({}), &store);
        for (std::size_t k = 0; k < scenes.size(); ++k) {
            const Bake moved = baked(scenes[k], &store);
            EXPECT_EQ(moved.hash(), full[k].hash());
            EXPECT_LT(moved.counts.rays - looks[k], (full[k].counts.rays - looks[k]) / 2);
            EXPECT_NE(notesOf(moved).find("1 instance moved: "), std::string::npos)
                << notesOf(moved);
        }
        const Bake back = baked(stagedRoom({}), &store);
        EXPECT_EQ(back.hash(), start.hash());
        EXPECT_EQ(back.counts.rays, 0U);
    }
}

// Which parts of the ground have finer texels depends on where the chest stands.
TEST(Stages, MovingAChestInAHouseOnAWideGroundEqualsAFullBake) {
    const auto withChest = [](glm::vec3 at) {
        SceneBuilder b = houseOnGround(1, false);
        b.add(box(glm::vec3(0), glm::vec3(1, 0.6f, 0.5f), false), glm::translate(glm::mat4(1), at));
        Scene scene = b.build();
        scene.bake.surfels = 900;
        scene.bake.lightmapCaches = 2000;
        scene.bake.rays = 64;
        scene.bake.links = 24;
        return scene;
    };
    StageStore store;
    const Bake start = baked(withChest({2, 0, 2}), &store);
    EXPECT_TRUE(std::ranges::any_of(start.lightmap.snaps,
                                    [](std::uint32_t s) { return (s & kFineLookup) != 0; }));
    for (const glm::vec3 at : {glm::vec3(2.2f, 0, 2), glm::vec3(4, 1, 3), glm::vec3(40, 0, 30)}) {
        const Bake moved = baked(withChest(at), &store);
        const ThreadLimit limit(1);
        EXPECT_EQ(moved.hash(), baked(withChest(at)).hash()) << at.x;
    }
    const Bake back = baked(withChest({2, 0, 2}), &store);
    EXPECT_EQ(back.hash(), start.hash());
    EXPECT_EQ(back.counts.rays, 0U);
}

/// Texels of the instance's charts, by their area in the atlas.
double texelsOf(const Bake& bake, const Scene& scene, std::size_t instance) {
    const MeshCharts& charts = bake.lightmap.meshes[scene.instances[instance].mesh];
    const std::vector<glm::vec2>& uv = bake.lightmap.instances[instance].uv;
    double sum = 0;
    for (std::size_t t = 0; t + 2 < charts.indices.size(); t += 3) {
        const glm::dvec2 a(uv[charts.indices[t]]), b(uv[charts.indices[t + 1]]),
            c(uv[charts.indices[t + 2]]);
        sum += std::abs((b - a).x * (c - a).y - (b - a).y * (c - a).x) / 2;
    }
    return sum * bake.lightmap.width * bake.lightmap.height;
}

TEST(Stages, AnObjectOfTwiceTheTexelDensityHasFourTimesTheTexels) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(4), true));
    b.add(box(glm::vec3(1), glm::vec3(2), false));
    Scene scene = b.build();
    scene.bake.surfels = 200;
    scene.bake.rays = 32;
    scene.bake.links = 8;
    scene.bake.texelsPerMetre = 8;
    StageStore store;
    const Bake plain = baked(scene, &store);
    EXPECT_NEAR(texelsOf(plain, scene, 0), 6 * 32 * 32, 0.01);
    EXPECT_NEAR(texelsOf(plain, scene, 1), 6 * 8 * 8, 0.01);
    scene.instances[1].texelDensity = 2;
    EXPECT_NE(bakeInputHash(scene), plain.sceneHash);
    const Bake dense = baked(scene, &store);
    EXPECT_NEAR(texelsOf(dense, scene, 0), 6 * 32 * 32, 0.01);
    EXPECT_NEAR(texelsOf(dense, scene, 1), 6 * 16 * 16, 0.01);
    EXPECT_EQ(dense.hash(), baked(scene).hash());
    // With a number of texels instead, that number stays and the ratio holds.
    scene.bake.texelsPerMetre = 0;
    scene.bake.lightmapCaches = 4000;
    const Bake counted = baked(scene);
    const double room = texelsOf(counted, scene, 0) / 96, block = texelsOf(counted, scene, 1) / 6;
    EXPECT_NEAR(block / room, 4, 0.4); // sides are whole texels
    EXPECT_NEAR(double(counted.caches.lightmapCount), 4000, 400);
    scene.instances[1].texelDensity = 1;
    scene.bake.texelsPerMetre = 8;
    scene.bake.lightmapCaches = plain.settings.lightmapCaches;
    EXPECT_EQ(baked(scene, &store).hash(), plain.hash());
}

TEST(Stages, ABakeIsTheSameWhereverADynamicObjectIs) {
    Blocks blocks;
    const Scene start = stagedRoom(blocks);
    const Bake first = baked(start);
    for (const glm::vec3 at : {glm::vec3(1, 0.5f, 2), glm::vec3(40, -70, 900)}) {
        blocks.ball = glm::translate(glm::mat4(1), at);
        Scene moved = stagedRoom(blocks);
        EXPECT_EQ(bakeInputHash(moved), bakeInputHash(start));
        EXPECT_EQ(baked(moved).hash(), first.hash());
    }
    Scene fixed = stagedRoom({});
    fixed.instances[5].dynamic = false; // the ball
    EXPECT_NE(bakeInputHash(fixed), bakeInputHash(start));
}

std::map<std::string, std::uintmax_t> filesOf(const fs::path& folder) {
    std::map<std::string, std::uintmax_t> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        files[entry.path().string()] = entry.file_size();
    return files;
}

TEST(Stages, ASmallMoveKeepsOnlyTheCachesItChangedAndEqualsAFullBakeWithoutTheRest) {
    const fs::path folder = fs::temp_directory_path() / ("limn_patch" + std::to_string(getpid()));
    const auto bakeWith = [&](const Scene& scene) {
        StageStore store({.folder = folder.string()});
        return baked(scene, &store);
    };
    const auto rooms = [](float x) { // closed ones; a block stands in the small one
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0.5f)));
        b.add(box(glm::vec3(0), glm::vec3(6), true));
        b.add(box(glm::vec3(8, 0, 0), glm::vec3(9, 1, 1), true));
        const std::uint32_t block = b.addMesh(box(glm::vec3(0), glm::vec3(0.3f), false));
        b.addInstance(block, glm::translate(glm::mat4(1), glm::vec3(x, 0.1f, 0.2f)));
        Scene scene = b.build();
        scene.bake.surfels = 600;
        scene.bake.texelsPerMetre = 2;
        scene.bake.rays = 1024;
        scene.bake.links = 16;
        return scene;
    };
    bakeWith(rooms(8.1f));
    const auto before = filesOf(folder);
    std::uintmax_t all = 0, added = 0;
    for (const auto& [name, size] : before)
        all += size;
    const std::uint64_t last = baked(rooms(8.3f)).hash();
    for (const float x : {8.2f, 8.3f}) // the second patches what is patched already
        EXPECT_EQ(bakeWith(rooms(x)).hash(), x == 8.3f ? last : baked(rooms(x)).hash());
    for (const auto& [name, size] : filesOf(folder))
        added += before.contains(name) ? 0 : size;
    EXPECT_LT(added, all); // of two moves
    for (const auto& [name, size] : before)
        fs::remove(name);
    const Bake again = bakeWith(rooms(8.3f));
    EXPECT_GT(again.counts.rays, 0U) << "the files removed were not needed";
    EXPECT_EQ(again.hash(), last);
    fs::remove_all(folder);
}

TEST(Stages, TrainingShadowsAreTracedAgainOnlyNearWhatMoved) {
    Blocks blocks;
    const Scene before = stagedRoom(blocks);
    blocks.tall[3].x += 0.3f;
    const Scene after = stagedRoom(blocks);
    StageStore store;
    const auto traced = [&](const Scene& scene, SurfelSet& set) {
        const TraceScene trace(scene);
        const auto meshes = hashMeshes(scene);
        set = placeSurfels(scene, 900);
        std::uint64_t rays = 0;
        const auto atlas = atlasStage(trace, scene, meshes, {}, &store, rays);
        CachePoints points;
        Caches caches = placeCaches(scene, atlas->atlas, points);
        const OwnerTables owners(scene, set);
        GatherHits hits;
        return traceHits({trace, set, owners, caches, points, Linker::Gather, 128, meshes}, {},
                         &store, hits);
    };
    SurfelSet was, is;
    ASSERT_TRUE(traced(before, was));
    Result<TraceReport> report = traced(after, is);
    ASSERT_TRUE(report);
    ASSERT_TRUE(report->moved);
    EXPECT_EQ(report->moved->places.size(), 2U);
    const TraceScene trace(after);
    const EarlierTraining earlier{traceTraining(TraceScene(before), was.surfels, nullptr, {}),
                                  std::move(*report->moved)};
    const TracedTraining full = traceTraining(trace, is.surfels, nullptr, {});
    const TracedTraining again = traceTraining(trace, is.surfels, &earlier, {});
    EXPECT_EQ(again.irradiance, full.irradiance);
    EXPECT_NE(again.irradiance, earlier.light.irradiance);
    EXPECT_LT(again.rays, full.rays * 2 / 3);
}

TEST(Stages, AnObjectThatComesOrGoesTracesOnlyWhatMeetsIt) {
    StageStore store;
    Scene without = stagedRoom({}), with = stagedRoom({.third = true});
    const Bake start = baked(without, &store);
    const Bake added = baked(with, &store);
    EXPECT_EQ(added.hash(), baked(with).hash());
    EXPECT_NE(notesOf(added).find("1 instance added"), std::string::npos) << notesOf(added);
    without.instances[3].toWorld[3].x += 0.25f; // and another moves
    const Bake removed = baked(without, &store);
    EXPECT_EQ(removed.hash(), baked(without).hash());
    EXPECT_NE(notesOf(removed).find("1 instance moved, 1 removed"), std::string::npos)
        << notesOf(removed);
}

TEST(Stages, OneSideMoreOrAHoleIsMet) {
    StageStore store;
    Scene scene = stagedRoom({});
    baked(scene, &store);
    scene.materials[2].doubleSided = false;
    EXPECT_EQ(baked(scene, &store).hash(), baked(scene).hash());
    scene.materials[0].emission = glm::vec3(1); // too many to aim at
    EXPECT_EQ(baked(scene, &store).hash(), baked(scene).hash());
}

TEST(Stages, CancelledAtAnyMomentTheNextBakeEqualsTheUndisturbedOne) {
    Scene scene = stagedRoom({});
    scene.bake.rays = 1024;
    const auto start = std::chrono::steady_clock::now();
    const Bake undisturbed = baked(scene);
    const auto whole = std::chrono::steady_clock::now() - start;
    StageStore store;
    std::mt19937 random(3);
    int cancelled = 0;
    for (int i = 0; i < 8; ++i) {
        std::atomic<bool> cancel = false;
        std::jthread stopper([&, delay = whole * (random() % 100) / 100] {
            std::this_thread::sleep_for(delay);
            cancel = true;
        });
        // The first is sure to be stopped, late in the trace: nothing of it is stored yet.
        const auto report = [&](const char* stage, float fraction) {
            if (i == 0 && std::string(stage) == "trace" && fraction > 0.8f)
                cancel = true;
        };
        const Result<Bake> result =
            bake(TraceScene(scene), {.report = report, .cancel = &cancel}, &store);
        if (result) {
            EXPECT_EQ(result->hash(), undisturbed.hash());
        } else {
            EXPECT_EQ(result.error().message, "cancelled");
            ++cancelled;
        }
    }
    EXPECT_GT(cancelled, 0);
    const Bake last = baked(scene, &store);
    EXPECT_EQ(last.hash(), undisturbed.hash());
    EXPECT_LT(last.counts.rays, undisturbed.counts.rays);
}

TEST(Stages, HitsThatWouldFillTheMemoryAreRefusedByName) {
    Scene scene = stagedRoom({});
    scene.bake.rays = 65536;
    scene.bake.grid = glm::uvec3(100);
    const Result<Bake> refused = bake(TraceScene(scene));
    ASSERT_FALSE(refused);
    for (const char* word : {"65536 rays", "memory", "lower rays, lightmap or grid"})
        EXPECT_NE(refused.error().message.find(word), std::string::npos) << refused.error().message;
}

} // namespace
} // namespace limn::stages_test
