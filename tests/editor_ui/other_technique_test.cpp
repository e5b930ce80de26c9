// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/other_technique.h"

#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace limn::other_technique_test {
namespace {

struct OtherTechniqueTest : testing::Test {
    std::atomic<int> woken{0};
    OtherTechnique other{[this] { ++woken; }};
    std::shared_ptr<const Scene> scene = litRoom(500, 800);
    Viewpoint view;

    /// Sets a technique until its light rests, as the editor does once a frame.
    bool lit(const std::string& technique) {
        for (int i = 0; i < 6000; ++i) {
            other.set(technique, scene, {}, view);
            if (other.lit().field && !other.busy())
                return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    }
};

TEST_F(OtherTechniqueTest, LightsACopyOfTheScene) {
    EXPECT_FALSE(other.lit().scene);
    EXPECT_EQ(other.text(), "");
    ASSERT_TRUE(lit("lpv"));
    EXPECT_GT(woken, 0);
    EXPECT_EQ(other.lit().scene->technique.technique, "lpv");
    EXPECT_EQ(scene->technique.technique, "illuminance");
    EXPECT_EQ(other.lit().scene->instances.size(), scene->instances.size());
    EXPECT_FALSE(other.lit().field->grid.empty());
    EXPECT_TRUE(other.text().starts_with("Last update: "));
}

TEST_F(OtherTechniqueTest, KeepsItsPointersWhileNothingChanges) {
    ASSERT_TRUE(lit("lpv"));
    const ShownScene before = other.lit();
    other.set("lpv", scene, {}, view);
    EXPECT_EQ(other.lit(), before);
    Scene moved = *scene;
    moved.lights[0].position.x += 0.1f;
    scene = std::make_shared<const Scene>(std::move(moved));
    other.set("lpv", scene, {}, view);
    EXPECT_NE(other.lit().scene, before.scene);
    EXPECT_EQ(other.lit().layout, before.layout) << "no object came or went";
    EXPECT_EQ(other.lit().scene->lights[0].position, scene->lights[0].position);
}

TEST_F(OtherTechniqueTest, FollowsAnotherChoiceAndEnds) {
    ASSERT_TRUE(lit("lpv"));
    ASSERT_TRUE(lit("ambient"));
    EXPECT_EQ(other.lit().scene->technique.technique, "ambient");
    other.set("", scene, {}, view);
    EXPECT_EQ(other.lit(), ShownScene());
    EXPECT_FALSE(other.busy());
}

TEST_F(OtherTechniqueTest, SaysThatABakeIsMissing) {
    other.set("illuminance", scene, {}, view);
    EXPECT_FALSE(other.lit().layout);
    EXPECT_EQ(other.text(), "No bounced light: this technique needs a bake");
}

} // namespace
} // namespace limn::other_technique_test
