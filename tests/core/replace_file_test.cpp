// SPDX-License-Identifier: MIT
#include "engine/core/replace_file.h"

#include "tests/core/full_disk.h"
#include "tests/core/temporary_folder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <random>
#include <thread>
#include <vector>

namespace limn::replace_file_test {
namespace {

namespace fs = std::filesystem;

std::string problem(const Result<void>& result) {
    return result ? "" : result.error().message;
}

TEST(ReplaceFile, WritesANewFileAndReplacesAnOldOneWithItsPermissions) {
    const TemporaryFolder folder;
    const std::string path = folder.file("f");
    EXPECT_EQ(problem(replaceFile(path, "one")), "");
    EXPECT_EQ(fileBytes(path), "one");
    fs::permissions(path, fs::perms(0600));
    EXPECT_EQ(problem(replaceFile(path, "two")), "");
    EXPECT_EQ(fileBytes(path), "two");
    EXPECT_EQ(fs::status(path).permissions(), fs::perms(0600));
    EXPECT_EQ(namesIn(folder.path), std::vector<std::string>{"f"});
}

TEST(ReplaceFile, ALinkIsFollowedOrReplaced) {
    const TemporaryFolder folder;
    writeFile(folder.file("f"), "old");
    fs::create_symlink("f", folder.path / "link");
    EXPECT_TRUE(replaceFile(folder.file("link"), "new"));
    EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
    EXPECT_EQ(fileBytes(folder.file("f")), "new");
    EXPECT_TRUE(replaceFile(folder.file("link"), "own", AtLink::Replace));
    EXPECT_FALSE(fs::is_symlink(folder.path / "link"));
    EXPECT_EQ(fileBytes(folder.file("link")), "own");
    EXPECT_EQ(fileBytes(folder.file("f")), "new");
}

TEST(ReplaceFile, WhatIsNoFileStays) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
    fs::create_directory(folder.path / "sub");
    EXPECT_NE(problem(replaceFile(folder.file("pipe"), "x")).find("not a regular file"),
              std::string::npos);
    EXPECT_NE(problem(replaceFile(folder.file("sub"), "x")).find("not a regular file"),
              std::string::npos);
    EXPECT_NE(problem(replaceFile(folder.file("no/f"), "x")).find("cannot create"),
              std::string::npos);
    EXPECT_TRUE(fs::is_fifo(folder.path / "pipe"));
}

TEST(ReplaceFile, AFullDiskLeavesTheOldFile) {
    const TemporaryFolder folder;
    const std::string path = folder.file("f");
    ASSERT_TRUE(replaceFile(path, "old"));
    std::string said;
    {
        const FullDisk full(1 << 16);
        said = problem(replaceFile(path, std::string(1 << 20, 'x')));
    }
    EXPECT_NE(said.find("f: cannot write: File too large"), std::string::npos) << said;
    EXPECT_EQ(fileBytes(path), "old");
    EXPECT_EQ(namesIn(folder.path), std::vector<std::string>{"f"});
}

TEST(ReplaceFile, ManyWritersLeaveOneWholeFile) {
    const TemporaryFolder folder;
    const std::string path = folder.file("f");
    std::vector<std::thread> writers;
    for (int w = 0; w < 4; ++w)
        writers.emplace_back([&, w] {
            for (int i = 0; i < 20; ++i)
                EXPECT_EQ(problem(replaceFile(path, std::string(50000, char('a' + w)))), "");
        });
    for (std::thread& writer : writers)
        writer.join();
    const std::string bytes = fileBytes(path);
    EXPECT_EQ(bytes, std::string(50000, bytes.empty() ? ' ' : bytes[0]));
    EXPECT_EQ(namesIn(folder.path), std::vector<std::string>{"f"});
}

TEST(ReplaceFile, KilledAtAnyMomentItLeavesAWholeFileAndNothingElse) {
    const TemporaryFolder folder;
    const std::string path = folder.file("f");
    ASSERT_TRUE(replaceFile(path, "a"));
    std::mt19937 random(5);
    for (int round = 0; round < 100; ++round) {
        const pid_t child = fork();
        if (child == 0)
            for (char c = 'a';; c = c == 'z' ? 'a' : char(c + 1))
                if (!replaceFile(path, std::string(200000, c)))
                    _exit(1);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 8000));
        kill(child, SIGKILL);
        int status = 0;
        waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "a write failed";
        const std::string bytes = fileBytes(path);
        ASSERT_FALSE(bytes.empty());
        ASSERT_EQ(bytes, std::string(bytes.size(), bytes[0])) << round;
    }
    ASSERT_TRUE(replaceFile(path, "last"));
    EXPECT_EQ(namesIn(folder.path), std::vector<std::string>{"f"});
}

// As a program does that was killed between two system calls.
TEST(ReplaceFile, ATemporaryFileLeftBehindIsRemoved) {
    const TemporaryFolder folder;
    writeFile(folder.file("f"), "old");
    writeFile(temporaryName(folder.file("f")), "left");
    EXPECT_TRUE(replaceFile(folder.file("f"), "new"));
    EXPECT_EQ(fileBytes(folder.file("f")), "new");
    EXPECT_EQ(namesIn(folder.path), std::vector<std::string>{"f"});
}

} // namespace
} // namespace limn::replace_file_test
