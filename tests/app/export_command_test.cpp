// SPDX-License-Identifier: MIT
#include "tests/app/command_line.h"

namespace {

const std::string kCoarse = " --surfels 500 --rays 64 --links 32 --lightmap 600 ";

TEST_F(CommandLine, ExportListsItsFormatsWithTheSettingsThatTheyRead) {
    const nlohmann::json listed = json("export --list --json");
    ASSERT_GE(listed["formats"].size(), 2U);
    for (const auto& format : listed["formats"]) {
        expectKeys(format, {"name", "label", "summary", "extensions", "settings"});
        EXPECT_NE(limn("export --list").out.find(format["name"].get<std::string>()),
                  std::string::npos);
    }
}

TEST_F(CommandLine, ExportWritesTheFilesThatItsJsonNames) {
    const nlohmann::json made =
        json("export cornell --format gltf --detail 1 --json -o " + path("box.gltf") + kCoarse);
    expectKeys(made, {"format", "seconds", "bytes", "forecast", "files"});
    std::uint64_t bytes = 0;
    for (const auto& file : made["files"]) {
        const std::uint64_t size = fs::file_size(path(file["name"]));
        EXPECT_EQ(file["bytes"], size);
        bytes += size;
    }
    EXPECT_EQ(made["bytes"], bytes);
    EXPECT_NEAR(made["forecast"]["bytes"].get<double>(), double(bytes), 0.6 * double(bytes));
}

TEST_F(CommandLine, ExportRefusesBeforeTheWorkWhatItCannotWrite) {
    expectRefusal("export cornell --format gltf -o " + path("no/such/folder/x.gltf"), "x.gltf");
    expectRefusal("export cornell --format gltf -o " + path("x.png"), ".gltf");
    expectRefusal("export cornell --format gltf --detail 2 -o " + path("x.gltf"), "--detail");
    expectRefusal("export cornell --format limnrt --compress -o " + path("x.limnrt"),
                  "does not use it");
    EXPECT_EQ(limn("export cornell --format nothing -o x.gltf").exit, 2);
    EXPECT_EQ(limn("export cornell").exit, 2);
}

} // namespace
