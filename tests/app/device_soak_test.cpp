// SPDX-License-Identifier: MIT
// Draws one document, lit by every technique in turn on the device, again and again.
#include "app/editor/render_worker.h"

#include "engine/lightmap/atlas.h"
#include "engine/techniques/device/device_table.h"
#include "engine/techniques/technique_table.h"
#include "tests/core/heap_in_use.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace limn::device_soak_test {
namespace {

/// A technique with the same room at three places of its lamp.
struct Turn {
    const Technique* technique;
    std::array<std::shared_ptr<const Scene>, 3> scenes;
    std::shared_ptr<const Precomputed> made; ///< null where it precomputes nothing
    std::shared_ptr<const LightmapLayout> layout;
    const OverlayKind* overlay; ///< one of its light
};

struct DeviceSoak : testing::Test {
    std::unique_ptr<RenderWorker> worker;
    std::shared_ptr<const Scene> room = litRoom(300, 400);
    std::shared_ptr<const TraceScene> trace = std::make_shared<const TraceScene>(*room);
    std::vector<Turn> turns;

    void SetUp() override {
        for (const Technique* technique : techniques()) {
            Turn turn{technique, {}, {}, {}, {}};
            for (std::size_t k = 0; k < turn.scenes.size(); ++k) {
                Scene scene = *room;
                scene.technique.technique = technique->name;
                scene.lights[0].position.x += 0.1f * float(k);
                turn.scenes[k] = std::make_shared<const Scene>(std::move(scene));
            }
            if (const Precomputation* p = technique->precomputation)
                turn.made = *p->prepare(TraceScene(*turn.scenes[0]), {}, {});
            turn.layout =
                turn.made ? std::shared_ptr<const LightmapLayout>{turn.made, &turn.made->layout()}
                          : std::make_shared<const LightmapLayout>(
                                layoutWithoutLightmap(*turn.scenes[0]));
            const auto kind = std::ranges::find_if(technique->overlays, [](const OverlayKind& k) {
                return k.showsLight && k.pick != OverlayPick::Required;
            });
            turn.overlay = kind == technique->overlays.end() ? nullptr : &*kind;
            turns.push_back(turn);
        }
    }

    PictureRequest requestOf(const Turn& turn, std::size_t place) const {
        PictureRequest request;
        request.scene = turn.scenes[place];
        request.layout = turn.layout;
        request.options.camera.eye = {2, 1.5f, 2.5f};
        request.options.camera.target = {2, 1.2f, 3.5f};
        request.options.width = request.options.height = 64;
        request.technique = turn.technique;
        request.lit = turn.made ? BakedScene{turn.made, turn.scenes[0], trace} : BakedScene{};
        request.relight = lightsOnDevice(*turn.technique);
        return request;
    }

    /// Draws until the light rests, then refines the picture.
    void draw(const PictureRequest& request) {
        const std::atomic<bool> hurry = false;
        worker->draw(request, hurry);
        for (int k = 0; worker->bouncing() && k < 1000; ++k)
            worker->draw(request, hurry);
        EXPECT_FALSE(worker->bouncing()) << request.technique->name;
        EXPECT_EQ(worker->refusal, "") << request.technique->name;
        while (worker->refining())
            worker->refine(hurry);
    }

    /// Each technique draws the room with its lamp at three places, and an overlay of its light.
    void round() {
        for (const Turn& turn : turns) {
            for (std::size_t place = 0; place < turn.scenes.size(); ++place)
                draw(requestOf(turn, place));
            if (!turn.overlay || !lightsOnDevice(*turn.technique))
                continue;
            PictureRequest request = requestOf(turn, 2);
            request.overlay.kind = turn.overlay;
            request.overlaySource = turn.made;
            request.overlayScene = turn.made ? turn.scenes[0] : nullptr;
            draw(request);
            if (!turn.made) {
                request.overlaySource = worker->snapshot;
                request.overlayScene = worker->snapshotScene;
                draw(request);
            }
            EXPECT_TRUE(worker->overlay) << turn.overlay->name;
        }
        EXPECT_EQ(worker->device->validationMessages(), std::vector<std::string>());
    }

    std::uint64_t deviceBytes() {
        worker->device->waitIdle();
        worker->device->collect();
        return worker->device->memory.bytesInUse;
    }
};

TEST_F(DeviceSoak, SwitchingTechniquesKeepsNothingOnTheDevice) {
    worker = std::make_unique<RenderWorker>(true);
    round();
    round();
    const std::uint64_t before = deviceBytes();
    round();
    EXPECT_EQ(deviceBytes(), before);
}

/// Ten minutes: for ./check --journeys. Light, field or snapshot of a technique that is kept would
/// take more than kKept a round. Without validation, whose layer itself keeps some 50 KB a round.
TEST_F(DeviceSoak, DISABLED_TenMinutesOfSwitchingKeepNothing) {
    constexpr std::size_t kKept = 4096; // [bytes]
    using Clock = std::chrono::steady_clock;
    worker = std::make_unique<RenderWorker>(false);
    ASSERT_EQ(mallopt(M_ARENA_MAX, 1), 1); // the driver's threads keep their own arenas
    std::size_t early = 0;                 // most after one of the first rounds
    for (int i = 0; i < 5; ++i) {
        round();
        early = std::max(early, heapInUse());
    }
    const std::uint64_t onDevice = deviceBytes(), reserved = worker->device->memory.bytesReserved;
    const auto end = Clock::now() + std::chrono::minutes(10);
    std::size_t rounds = 5, late = 0;
    for (; Clock::now() < end; ++rounds) {
        round();
        late = heapInUse();
        EXPECT_LE(late, early + rounds * kKept) << "after " << rounds << " rounds";
        EXPECT_EQ(deviceBytes(), onDevice);
    }
    EXPECT_EQ(worker->device->memory.bytesReserved, reserved);
    constexpr double kMiB = 1 << 20;
    fmt::print(
        "{} rounds; heap {:.2f} MiB after the first five, {:.2f} at the end; device {:.2f}\n",
        rounds, double(early) / kMiB, double(late) / kMiB, double(onDevice) / kMiB);
}

} // namespace
} // namespace limn::device_soak_test
