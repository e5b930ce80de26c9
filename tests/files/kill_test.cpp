// SPDX-License-Identifier: MIT
// Killed at any moment, each writer leaves one whole file, and nothing beside it.
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "engine/files/relight_choice.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake_file.h"
#include "tests/core/temporary_folder.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <random>
#include <set>
#include <thread>

namespace limn::kill_test {
namespace {

using namespace std::chrono_literals;

/// Writes one of two contents to a path.
using Write = std::function<bool(const std::string& path, int which)>;

/// Twenty kills of a process that writes the two by turns, as fast as it can.
void killWriter(const char* name, const Write& write) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    const std::string path = folder.file(name);
    std::set<std::string> whole;
    for (const int which : {0, 1}) {
        ASSERT_TRUE(write(path, which));
        whole.insert(fileBytes(path));
    }
    ASSERT_EQ(whole.size(), 2U);
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        const pid_t child = fork();
        if (child == 0)
            for (int which = 0;; which = 1 - which)
                if (!write(path, which))
                    _exit(1);
        std::this_thread::sleep_for(1us * (random() % 12000));
        kill(child, SIGKILL);
        int status = 0;
        waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "a write failed";
        ASSERT_TRUE(whole.contains(fileBytes(path))) << "round " << round;
    }
    ASSERT_TRUE(write(path, 0));
    EXPECT_EQ(namesIn(folder.path).size(), 1U);
}

TEST(Kill, LeavesWholePictures) {
    killWriter("p.png", [](const std::string& path, int which) {
        Image image{.width = 64, .height = 64, .rgba = std::vector<std::uint8_t>(64 * 64 * 4)};
        for (std::size_t i = 0; i < image.rgba.size(); ++i)
            image.rgba[i] = std::uint8_t(i * (which + 3) >> 2);
        return writePng(path, image).has_value();
    });
    killWriter("p.exr", [](const std::string& path, int which) {
        const ImageF image{64, 64, std::vector<glm::vec3>(64 * 64, glm::vec3(float(which)))};
        return writeExr(path, image).has_value();
    });
}

TEST(Kill, LeavesWholeProjects) {
    Document document;
    for (int i = 0; i < 100; ++i)
        addObject(document, Light{});
    killWriter("p.limn", [&](const std::string& path, int which) {
        Document other = document;
        if (which)
            addObject(other, Light{});
        return saveProject(path, other).has_value();
    });
}

TEST(Kill, LeavesWholeBakes) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f), glm::vec3(1)));
    b.add(simple::box(glm::vec3(0), glm::vec3(2), true));
    Scene scene = b.build();
    scene.bake.surfels = 64;
    scene.bake.lightmapCaches = 60;
    scene.bake.rays = 16;
    Bake made = *bake(TraceScene(scene));
    made.seconds.clear();
    killWriter("b.limnbake", [&](const std::string& path, int which) {
        Bake other = made;
        other.counts.rays = std::uint64_t(which);
        return writeBake(path, other).has_value();
    });
}

TEST(Kill, LeavesWholeRelightTimes) {
    killWriter("relight.json", [](const std::string& path, int which) {
        return rememberRelightTimes(path, "here", {1.0 + which, 2}).has_value();
    });
}

TEST(Kill, LeavesWholeStages) {
    const TemporaryFolder folder;
    const std::string stages[] = {std::string(50000, 'a'), std::string(60000, 'b')};
    std::mt19937 random(4);
    for (int round = 0; round < 20; ++round) {
        const pid_t child = fork();
        if (child == 0) {
            StageStore store({.folder = folder.path.string()});
            for (int which = 0;; which = 1 - which)
                store.put(7, stages[which]);
        }
        std::this_thread::sleep_for(1us * (random() % 12000));
        kill(child, SIGKILL);
        int status = 0;
        waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status));
        StageStore store({.folder = folder.path.string()});
        const std::optional<std::string> found = store.find(7);
        ASSERT_TRUE(!found || *found == stages[0] || *found == stages[1]) << round;
    }
    StageStore store({.folder = folder.path.string()});
    store.put(7, stages[0]);
    store.flush();
    EXPECT_EQ(namesIn(folder.path).size(), 1U);
}

} // namespace
} // namespace limn::kill_test
