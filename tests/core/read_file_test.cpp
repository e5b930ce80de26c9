// SPDX-License-Identifier: MIT
#include "engine/core/read_file.h"

#include "tests/core/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace limn::read_file_test {
namespace {

std::string problem(const std::string& path, std::uint64_t most = 1000) {
    const Result<std::string> read = readFile(path, most);
    return read ? "" : read.error().message;
}

TEST(ReadFile, GivesTheBytesOfAFileAndOfWhatALinkPointsTo) {
    const TemporaryFolder folder;
    const std::string bytes("a\0b\xff", 4);
    writeFile(folder.file("f"), bytes);
    std::filesystem::create_symlink("f", folder.path / "link");
    EXPECT_EQ(readFile(folder.file("f")), bytes);
    EXPECT_EQ(readFile(folder.file("link")), bytes);
    EXPECT_EQ(readFile(folder.file("f"), 4), bytes);
    EXPECT_EQ(problem(folder.file("f"), 3), "its 4 bytes are more than 3");
    writeFile(folder.file("empty"), "");
    EXPECT_EQ(readFile(folder.file("empty")), "");
}

// Each of them would wait for ever or never end.
TEST(ReadFile, RefusesWhatIsNoFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder.path / "link");
    for (const std::string& path :
         {folder.file("pipe"), folder.file("link"), folder.path.string(), std::string("/dev/zero")})
        EXPECT_EQ(problem(path), "not a regular file") << path;
    EXPECT_EQ(problem(folder.file("none")), "no such file");
}

} // namespace
} // namespace limn::read_file_test
