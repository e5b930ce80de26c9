// SPDX-License-Identifier: MIT
// Kept stages with right checksums and wrong contents: whoever can write to the folder leads no
// bake astray.
#include "engine/techniques/illuminance/format/bake_defect.h"
#include "tests/core/temporary_folder.h"
#include "tests/techniques/illuminance/bake/staged_room.h"
#include "tests/techniques/illuminance/bake/window_room.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::stage_rules_test {
namespace {

namespace fs = std::filesystem;

/// The room with a wall, baked with few surfels and texels: there are many bakes of it here.
Scene smallRoom(float blockAt) {
    Scene scene =
        stagedRoom({.low = glm::translate(glm::mat4(1), glm::vec3(blockAt, 0, 1)), .wall = true});
    scene.bake.surfels = 100;
    scene.bake.texelsPerMetre = 0;
    scene.bake.lightmapCaches = 64;
    scene.bake.rays = 32;
    scene.bake.links = 12;
    scene.bake.grid = {2, 2, 2};
    return scene;
}

/// A stage's file has its key behind the magic and two words.
std::vector<std::uint64_t> keysIn(const fs::path& folder) {
    std::vector<std::uint64_t> keys;
    for (const auto& entry : fs::directory_iterator(folder))
        std::memcpy(&keys.emplace_back(), fileBytes(entry.path().string()).data() + 16, 8);
    return keys;
}

/// The stages of a few scenes, and what they hold.
class KeptStages : public testing::Test {
protected:
    void keep(const Scene& scene) {
        {
            StageStore store({.folder = m_folder.path.string()});
            m_hash = baked(scene, &store).hash();
        }
        StageStore store({.folder = m_folder.path.string()});
        for (const std::uint64_t key : keysIn(m_folder.path)) {
            const std::optional<std::string> bytes = store.find(key);
            ASSERT_TRUE(bytes);
            if (!bytes->empty())
                m_stages[key] = *bytes;
        }
    }
    /// A bake from all the stages, one of which is another.
    Bake withStage(const Scene& scene, std::uint64_t key, const std::string& bytes) const {
        StageStore store;
        for (const auto& [other, kept] : m_stages)
            store.put(other, other == key ? bytes : kept);
        return baked(scene, &store);
    }
    /// Overwrites each stage at a few places. The bake must equal that from intact stages.
    void expectMadeAgain(const Scene& scene);

    TemporaryFolder m_folder;
    std::map<std::uint64_t, std::string> m_stages;
    std::uint64_t m_hash = 0;
};

/// `bytes` with the eight at `at` overwritten by `value`.
std::string overwritten(std::string bytes, std::size_t at, std::uint64_t value) {
    at = std::min(at, bytes.size());
    std::memcpy(bytes.data() + at, &value, std::min<std::size_t>(8, bytes.size() - at));
    return bytes;
}

// As an index, a length, a float or a double, 0x7f7f… is out of every range.
void KeptStages::expectMadeAgain(const Scene& scene) {
    keep(scene);
    ASSERT_GT(m_stages.size(), 8U);
    for (const auto& [key, bytes] : m_stages)
        for (std::size_t k = 0; k < 12; ++k) {
            const std::size_t at = bytes.size() * k / 12 / 4 * 4;
            const Bake again = withStage(scene, key, overwritten(bytes, at, 0x7f7f7f7f7f7f7f7f));
            EXPECT_EQ(again.hash(), m_hash) << std::hex << key << std::dec << " at " << at;
        }
}

TEST_F(KeptStages, WhatIsOutOfRangeIsMadeAgain) {
    expectMadeAgain(smallRoom(2.5f));
}

TEST_F(KeptStages, SkyThroughAWindowThatIsOutOfRangeIsMadeAgain) {
    Scene scene = roomWithWindow(1);
    scene.bake.surfels = 100;
    scene.bake.lightmapCaches = 150;
    scene.bake.rays = 32;
    scene.bake.links = 12;
    expectMadeAgain(scene);
}

TEST_F(KeptStages, WhatIsWithinItsRangeMakesABakeThatCanBeFollowed) {
    const Scene scene = smallRoom(2.5f);
    keep(scene);
    std::uint32_t state = 7;
    for (const auto& [key, bytes] : m_stages)
        for (const std::uint64_t value : {std::uint64_t(0), ~std::uint64_t(0), std::uint64_t(1),
                                          std::uint64_t(0x3f000000'3f000000)}) {
            state = state * 1664525 + 1013904223;
            const std::size_t at = state % bytes.size() / 4 * 4;
            EXPECT_EQ(bakeDefect(withStage(scene, key, overwritten(bytes, at, value)), &scene), "")
                << std::hex << key << std::dec << " at " << at;
        }
}

// An earlier trace, of which only the rays that meet what moved are traced again.
TEST_F(KeptStages, AnEarlierTraceOutOfRangeIsNotUsed) {
    keep(smallRoom(2.5f));
    const Scene moved = smallRoom(2.2f);
    StageStore none;
    const std::uint64_t right = baked(moved, &none).hash();
    for (const auto& [key, bytes] : m_stages)
        for (std::size_t k = 0; k < 6; ++k) {
            const std::size_t at = bytes.size() * k / 6 / 4 * 4;
            EXPECT_EQ(withStage(moved, key, overwritten(bytes, at, 0x7f7f7f7f7f7f7f7f)).hash(),
                      right)
                << std::hex << key << std::dec << " at " << at;
        }
}

} // namespace
} // namespace limn::stage_rules_test
