// SPDX-License-Identifier: MIT
#pragma once

#include "tests/editor_ui/small_session.h"

#include <filesystem>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace limn {

/// A project in a folder of its own, and a session that may open it.
struct SessionTest : testing::Test {
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("limn-session-{}", getpid());
    std::string project = (folder / "small.limn").string();

    void SetUp() override {
        std::filesystem::create_directories(folder);
        setenv("XDG_CONFIG_HOME", folder.c_str(), 1);
        ASSERT_TRUE(saveProject(project, smallDocument()));
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    static SessionOptions options() {
        return {sourcePath("projects"), [] {}, true};
    }
    static bool runUntilIdle(Session& session) {
        return runUntil(session, [&] { return session.idle() && session.state.relight.converged; });
    }
    static Light& lamp(Session& session) {
        for (auto& [id, object] : session.state.document.objects)
            if (objectName(object) == "Lamp")
                return std::get<Light>(object);
        throw std::runtime_error("no lamp");
    }
};

} // namespace limn
