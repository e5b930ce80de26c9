// SPDX-License-Identifier: MIT
// Lights one document by every technique in turn, again and again.
#include "engine/techniques/technique_table.h"
#include "tests/core/heap_in_use.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/small_session.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace limn::technique_soak_test {
namespace {

struct TechniqueSoak : testing::Test {
    TemporaryFolder folder;
    std::unique_ptr<Session> session;

    void SetUp() override {
        setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
        ASSERT_TRUE(saveProject(folder.file("small.limn"), smallDocument()));
        session = std::make_unique<Session>(SessionOptions{
            .projectsFolder = sourcePath("projects"), .wake = [] {}, .bakeOnOpen = true});
        session->open(folder.file("small.limn"));
        ASSERT_TRUE(rests());
    }

    /// Waits until bake and light are up to date.
    bool rests() {
        return runUntil(*session, [&] {
            const BakeFreshness bake = session->state.bake.freshness;
            return session->idle() && session->state.relight.converged &&
                   (bake == BakeFreshness::UpToDate || bake == BakeFreshness::NotUsed);
        });
    }

    bool lightAt(float x) {
        for (auto& [id, object] : session->state.document.objects)
            if (auto* light = std::get_if<Light>(&object))
                light->position.x = x;
        session->update();
        return rests();
    }

    /// Each technique of the table lights the document with its lamp at three places.
    void round() {
        for (const Technique* technique : techniques()) {
            chooseTechnique(session->state.document, technique->name);
            for (const float x : {-0.3f, 0.f, 0.3f}) {
                ASSERT_TRUE(lightAt(x)) << technique->name << " does not come to rest";
                ASSERT_TRUE(session->field()) << technique->name;
                EXPECT_EQ(session->scene()->technique.technique, technique->name);
                if (technique->precomputation) {
                    EXPECT_STREQ(session->baked().bake->technique().name, technique->name);
                }
            }
        }
    }
};

TEST_F(TechniqueSoak, EveryTechniqueComesToRestAfterEveryOther) {
    round();
    round();
}

/// Ten minutes: for ./check --journeys. A bake, field or trace scene that is kept would take more
/// than kKept a round.
TEST_F(TechniqueSoak, DISABLED_TenMinutesOfSwitchingKeepNoDataOfATechnique) {
    constexpr std::size_t kKept = 4096; // [bytes]
    using Clock = std::chrono::steady_clock;
    ASSERT_EQ(mallopt(M_ARENA_MAX, 1), 1);
    std::size_t early = 0; // most after one of the first rounds
    for (int i = 0; i < 3; ++i) {
        round();
        session->state.log.clear();
        early = std::max(early, heapInUse());
    }
    const auto end = Clock::now() + std::chrono::minutes(10);
    int rounds = 3;
    std::size_t late = 0;
    for (; Clock::now() < end; ++rounds) {
        round();
        session->state.log.clear();
        late = heapInUse();
        EXPECT_LE(late, early + std::size_t(rounds) * kKept) << "after " << rounds << " rounds";
    }
    fmt::print("{} rounds; {:.1f} MiB after the first three, {:.1f} MiB at the end\n", rounds,
               double(early) / (1 << 20), double(late) / (1 << 20));
}

} // namespace
} // namespace limn::technique_soak_test
