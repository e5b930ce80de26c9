// SPDX-License-Identifier: MIT
#include "engine/core/user_folder.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace limn {
namespace {

TEST(UserFolder, FollowsItsVariableElseTheHomeFolderAndIgnoresRelativePaths) {
    setenv("HOME", "/h", 1);
    setenv("XDG_STATE_HOME", "/v", 1);
    EXPECT_EQ(userFolder(UserFolder::State), "/v/limn");
    for (const char* relative : {"", "state", "./state"}) {
        setenv("XDG_STATE_HOME", relative, 1);
        EXPECT_EQ(userFolder(UserFolder::State), "/h/.local/state/limn") << relative;
    }
    unsetenv("XDG_CONFIG_HOME");
    unsetenv("XDG_CACHE_HOME");
    EXPECT_EQ(userFolder(UserFolder::Config), "/h/.config/limn");
    EXPECT_EQ(userFolder(UserFolder::Cache), "/h/.cache/limn");
    unsetenv("HOME");
    EXPECT_EQ(userFolder(UserFolder::Config), "");
}

} // namespace
} // namespace limn
