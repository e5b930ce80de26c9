// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/relight_job.h"

#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/techniques/illuminance/relight/seen_caches.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace limn::relight_job_test {
namespace {

std::shared_ptr<const Scene> lampAt(const Scene& scene, glm::vec3 position) {
    Scene moved = scene;
    moved.lights[0].position = position;
    return std::make_shared<const Scene>(std::move(moved));
}

Viewpoint lookingTo(glm::vec3 target) {
    Viewpoint view;
    view.camera.eye = {2, 1.5f, 2.5f};
    view.camera.target = target;
    return view;
}

struct RelightJobTest : testing::Test {
    std::shared_ptr<const Scene> scene = litRoom(900, 1500);
    std::shared_ptr<const TraceScene> trace = std::make_shared<const TraceScene>(*scene);
    std::shared_ptr<const Bake> made = std::make_shared<const Bake>(*bake(*trace));
    std::shared_ptr<const Precomputed> data = std::make_shared<const BakedIlluminance>(made);
    CacheFootprints footprints = cacheFootprints(*scene, *made);
    Viewpoint a = lookingTo({2, 1.5f, 5}), b = lookingTo({2, 1.5f, 0});

    CacheFlags seen(const Viewpoint& view) const {
        return seenCaches(footprints, view.camera, view.aspect);
    }

    static bool until(const std::function<bool()>& done) {
        for (int i = 0; i < 6000; ++i) {
            if (done())
                return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    }
    static bool rests(const RelightJob& job) {
        const LightingStatus s = job.result().status;
        return s.converged && !s.running;
    }

    /// Relative to the mean, the largest difference of a texel's mean radiance where `which` is.
    double difference(const IndirectField& x, const IndirectField& y,
                      const CacheFlags& which) const {
        double worst = 0, sum = 0;
        for (std::size_t c = 0; c < which.size(); ++c) {
            const std::size_t at = made->caches.texel[c];
            sum += double(y.lightmap[at].x);
            if (which[c] != 0)
                worst = std::max(worst, double(std::abs(x.lightmap[at].x - y.lightmap[at].x)));
        }
        return worst / (sum / double(which.size()));
    }
};

TEST_F(RelightJobTest, LightsWhatIsSeenWhileALightMovesAndAllAtRest) {
    RelightJob job([] {});
    job.setView(a);
    job.setScene(scene);
    job.setBake({data, scene, trace});
    ASSERT_TRUE(until([&] { return rests(job); }));
    const auto moved = lampAt(*scene, {3.2f, 1.8f, 4});
    job.setScene(moved);
    ASSERT_TRUE(until([&] { return rests(job) && job.result().hashedScene == moved; }));
    const Relit relit = job.result();
    EXPECT_GT(counterOf(relit.status.last, "caches_unseen"), 300U)
        << "bounces were for what is seen";
    // Whichever way the camera turns now: a full relight shows no other light.
    Relighter full(made);
    full.relight(*scene, *trace, 64);
    const IndirectField before = full.field();
    full.relight(*moved, *trace, 64);
    const CacheFlags all(made->caches.lightmapCount, 1);
    EXPECT_LT(difference(*relit.field, full.field(), all), 1e-3) << "both converged to 1e-4";
    EXPECT_GT(difference(before, full.field(), seen(b)), 0.1) << "which the old light is not";
}

TEST_F(RelightJobTest, FindsTheLightOfSourcesWhileItRestsAndThenSumsIt) {
    std::atomic<int> summed = 0;
    RelightJob* running = nullptr;
    RelightJob job([&] {
        const LightingReport last = running->result().status.last;
        summed += !last.steps.empty() && last.bounces == 0 && !last.converged;
    });
    running = &job;
    job.setScene(scene);
    job.setBake({data, scene, trace});
    ASSERT_TRUE(until([&] { return rests(job); }));
    Scene brighter = *scene;
    const auto brightened = [&] {
        brighter.lights[0].strength *= 1.1f;
        const auto next = std::make_shared<const Scene>(brighter);
        job.setScene(next);
        const bool rested = until([&] { return rests(job) && job.result().hashedScene == next; });
        EXPECT_TRUE(rested);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return summed > 0;
    };
    EXPECT_TRUE(until(brightened)) << "nothing says when sources are found, so edits go on";
    Relighter full(made);
    full.relight(brighter, *trace, 64);
    EXPECT_LT(
        difference(*job.result().field, full.field(), CacheFlags(made->caches.lightmapCount, 1)),
        1e-3);
}

TEST_F(RelightJobTest, WhatComesIntoViewIsRightWithTheNextField) {
    const auto moved = lampAt(*scene, {3.2f, 1.8f, 4});
    std::atomic<bool> looks = false, looked = false;
    std::vector<std::shared_ptr<const IndirectField>> fields; // of the moved lamp, one a call
    RelightJob* running = nullptr;
    RelightJob job([&] {
        if (!looks)
            return;
        const Relit relit = running->result();
        fields.push_back(relit.field);
        running->setView(b); // the camera turns while the light is not complete; the lamp stands
        looked = !relit.status.running;
    });
    running = &job;
    job.setView(a);
    job.setScene(scene);
    job.setBake({data, scene, trace});
    ASSERT_TRUE(until([&] { return rests(job); }));
    looks = true;
    job.setScene(moved);
    ASSERT_TRUE(until([&] { return looked.load(); }));
    ASSERT_GT(fields.size(), 2U);
    Relighter full(made); // lights all in every call
    full.relight(*scene, *trace, 64);
    full.relight(*moved, *trace, bouncesPerUpdate(64));
    EXPECT_LT(difference(*fields[0], full.field(), seen(a)), 1e-3);
    EXPECT_GT(difference(*fields[0], full.field(), seen(b)), 0.1) << "nobody looks there";
    full.relight(*moved, *trace, bouncesPerUpdate(64));
    EXPECT_LT(difference(*fields[1], full.field(), seen(b)), 1e-3);
}

TEST_F(RelightJobTest, TakesNoMoreBouncesThanTheDocumentAsksFor) {
    for (const std::uint32_t bounces : {1U, 3U}) {
        Scene few = *scene;
        few.relight.maxBounces = bounces;
        const auto shown = std::make_shared<const Scene>(few), moved = lampAt(few, {3, 2, 4});
        RelightJob job([] {});
        job.setScene(shown);
        job.setBake({data, scene, trace});
        ASSERT_TRUE(until([&] { return rests(job); }));
        job.setScene(moved);
        ASSERT_TRUE(until([&] { return rests(job) && job.result().hashedScene == moved; }));
        EXPECT_EQ(job.result().status.bounces, bounces);
        Relighter fresh(made);
        fresh.relight(*moved, *trace, bounces);
        EXPECT_EQ(job.result().field->lightmap, fresh.field().lightmap);
    }
}

TEST_F(RelightJobTest, LightsAllForOverlaysOfLight) {
    RelightJob job([] {});
    job.setView(a);
    job.keepLit(true);
    job.setScene(scene);
    job.setBake({data, scene, trace});
    ASSERT_TRUE(until([&] { return rests(job); }));
    job.setScene(lampAt(*scene, {3.2f, 1.8f, 4}));
    ASSERT_TRUE(until([&] { return rests(job); }));
    EXPECT_GT(job.result().status.calls, 2U);
    EXPECT_EQ(counterOf(job.result().status.last, "caches_unseen"), 0);
}

} // namespace
} // namespace limn::relight_job_test
