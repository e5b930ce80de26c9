// SPDX-License-Identifier: MIT
#include "tests/app/command_line.h"

namespace limn::export_command_test {
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
                  "--compress: the format limnrt does not use it");
    expectRefusal("export cornell --format filament --max-size 512 -o " + path("x.txt"),
                  "--max-size: the format filament does not use it");
    expectRefusal("export cornell --format gltf --compress -o " + path("x.gltf"),
                  "--compress: has no effect without --encoding");
    expectRefusal("export cornell --format lightmap --compress -o " + path("x.exr"),
                  "--compress: has no effect without --encoding");
    expectRefusal("export cornell --format lightmap --layers volume -o " + path("x.ktx2"),
                  "--layers: has no effect without --lightmap-bands");
    EXPECT_EQ(limn("export cornell --format nothing -o x.gltf").exit, 2);
    EXPECT_EQ(limn("export cornell").exit, 2);
}

TEST_F(CommandLine, ExportRefusesToCompressForThreeWhatIsNotKtx2) {
    const std::string export_ = "export cornell --format three --compress" + kCoarse;
    const Outcome run = limn(export_ + "-o " + path("x.gltf")); // nothing moves: there is no grid
    EXPECT_EQ(run.exit, 1);
    EXPECT_NE(run.err.find("--compress: has no effect without --encoding"), std::string::npos)
        << run.err;
    EXPECT_FALSE(fs::exists(path("x.gltf")));
    EXPECT_EQ(limn(export_ + "--lightmap-bands 2 -o " + path("sh.gltf")).exit, 0);
}

TEST_F(CommandLine, ExportCompressesALightmapThatIsKtx2ByItsName) {
    const std::string export_ = "export cornell --format lightmap --detail 1 --json" + kCoarse;
    const nlohmann::json plain = json(export_ + "-o " + path("plain.ktx2"));
    const nlohmann::json packed = json(export_ + "--compress -o " + path("packed.ktx2"));
    EXPECT_LT(packed["bytes"], plain["bytes"]);
}

TEST_F(CommandLine, TransportOfStoredHarmonicsIsRefusedWithTheOptionThatHelps) {
    const Outcome run =
        limn("export cornell --format limnrt --storage sh -o " + path("x.limnrt") + kCoarse);
    EXPECT_EQ(run.exit, 1);
    EXPECT_NE(run.err.find("bake with --storage rtp"), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(path("x.limnrt")));
}

TEST_F(CommandLine, InfoSaysWhatATransportFileHoldsAndWhatIsWrongWithIt) {
    const std::string file = path("box.limnrt");
    json("export cornell --format limnrt --detail 1 --json -o " + file + kCoarse);
    const nlohmann::json info = json("info --json " + file);
    EXPECT_EQ(info["kind"], "transport");
    EXPECT_EQ(info["version"], "2.2");
    EXPECT_NEAR(info["surfels"].get<double>(), 500, 10);
    EXPECT_EQ(info["triangles"], 38);
    EXPECT_EQ(info["bytes"]["total"], fs::file_size(file));
    EXPECT_EQ(info["bytes"]["LINK"], 12 * info["links"].get<std::uint64_t>());
    EXPECT_EQ(info["bytes"]["SPOS"], 12 * info["surfels"].get<std::uint64_t>());
    EXPECT_EQ(info["light_points"], 4);
    for (const char* tag : {"SLPT", "SLNM"})
        EXPECT_EQ(info["bytes"][tag], 48 * info["surfels"].get<std::uint64_t>()) << tag;
    EXPECT_NE(limn("info " + file).out.find("LINK"), std::string::npos);

    const std::string whole = contents(file), broken = path("broken.limnrt");
    write(broken, whole.substr(0, whole.size() / 2));
    expectRefusal("info " + broken, "broken.limnrt: truncated");
    std::string damaged = whole;
    damaged.back() = char(damaged.back() ^ 1);
    write(broken, damaged);
    expectRefusal("info " + broken, "broken.limnrt: section OTRI: damaged");
    write(broken, "{}");
    expectRefusal("info " + broken, "broken.limnrt: not a transport file");
    expectRefusal("info " + path("nowhere.limnrt"), "nowhere.limnrt: no such file");
}

} // namespace
} // namespace limn::export_command_test
