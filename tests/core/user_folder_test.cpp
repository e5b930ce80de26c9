// SPDX-License-Identifier: MIT
#include "engine/core/user_folder.h"

#include "tests/core/temporary_folder.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace limn::user_folder_test {
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

TEST(UserFolder, DocumentsAreWhereTheUserSaysElseInDocumentsElseAtHome) {
    const TemporaryFolder home;
    setenv("HOME", home.path.c_str(), 1);
    unsetenv("XDG_CONFIG_HOME");
    EXPECT_EQ(documentsFolder(), home.path);
    for (const char* name : {"Documents", "Dokumente", ".config"})
        std::filesystem::create_directory(home.path / name);
    EXPECT_EQ(documentsFolder(), home.file("Documents"));
    const auto configured = [&](const std::string& text) {
        writeFile(home.file(".config/user-dirs.dirs"), text);
        return documentsFolder();
    };
    EXPECT_EQ(configured("# comment\nXDG_DOCUMENTS_DIR=\"$HOME/Dokumente\"\n"),
              home.file("Dokumente"));
    EXPECT_EQ(configured("XDG_DOCUMENTS_DIR=\"" + home.file("Dokumente") + "\""),
              home.file("Dokumente"));
    for (const char* unusable :
         {"XDG_DOCUMENTS_DIR=\"Dokumente\"", "XDG_DOCUMENTS_DIR=\"$HOME/none\"",
          "XDG_DOCUMENTS_DIR=\"", "XDG_DOCUMENTS_DIR=", ""})
        EXPECT_EQ(configured(unusable), home.file("Documents")) << unusable;
}

} // namespace
} // namespace limn::user_folder_test
