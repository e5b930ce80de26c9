// SPDX-License-Identifier: MIT
// `limn tune`: the project it writes, and what it refuses.
#include "engine/files/project_file.h"
#include "tests/app/command_line.h"

namespace limn::tune_command_test {
namespace {

const std::string kSmall = " --surfels 256,512 --links 8,16 --lightmap 400,800 --rays 64 --bands 3 "
                           "--storage rtp --seconds 20 ";

BakeSettings bakeOf(const std::string& project) {
    const auto loaded = limn::loadProject(project);
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? limn::singleton<limn::BakeSettings>(loaded->document) : BakeSettings{};
}

TEST_F(CommandLine, TuneWritesTheSettingsItFound) {
    const std::string project = path("fitted.limn");
    const nlohmann::json out =
        json("tune cornell --budget-mib 16 --json" + kSmall + "-o " + project);
    EXPECT_EQ(out["kept"], true);
    EXPECT_LE(out["best"]["bytes"].get<double>(), 16 * (1 << 20));
    expectKeys(out["trials"][0],
               {"level", "seconds", "update_ms", "bytes", "nrmse", "bias", "settings"});
    const BakeSettings written = bakeOf(project);
    EXPECT_EQ(out["best"]["settings"]["surfels"], written.surfels);
    EXPECT_EQ(out["best"]["settings"]["links"], written.links);
    EXPECT_EQ(out["best"]["settings"]["lightmap_caches"], written.lightmapCaches);
    EXPECT_EQ(written.rays, 64U);

    // A project that is tuned keeps its own lights, and its settings where nothing fits.
    const std::string before = contents(project);
    const Outcome tight = limn("tune " + project + " --budget-ms 0.001" + kSmall);
    EXPECT_EQ(tight.exit, 1) << tight.err;
    EXPECT_NE(tight.err.find("ms, not 0.001"), std::string::npos) << tight.err;
    EXPECT_EQ(contents(project), before);
    const Outcome lit =
        limn("tune " + project + " --error 5 --light 'point pos=0,1,0 cd=1'" + kSmall);
    EXPECT_EQ(lit.exit, 0) << lit.err;
    EXPECT_NE(lit.out.find("ruled out"), std::string::npos);
    EXPECT_NE(contents(project), before) << "the cheapest settings";
    EXPECT_EQ(contents(project).find("\"point\""), before.find("\"point\""));
    EXPECT_LE(bakeOf(project).surfels, 512U);
}

TEST_F(CommandLine, TuneRefusesHostileValuesByName) {
    const std::string start = "tune cornell -o " + path("x.limn");
    for (const auto& [arguments, word] : {std::pair<std::string, std::string>{"", "--budget-ms"},
                                          {" --budget-ms 0", "--budget-ms"},
                                          {" --budget-ms nan", "--budget-ms"},
                                          {" --budget-ms -3", "--budget-ms"},
                                          {" --budget-mib inf", "--budget-mib"},
                                          {" --budget-mib 4MiB", "--budget-mib"},
                                          {" --error 0", "--error"},
                                          {" --budget-ms 1 --seconds 0", "--seconds"},
                                          {" --budget-ms 1 --surfels 3", "--surfels"},
                                          {" --budget-ms 1 --links 1,x", "--links"}}) {
        const Outcome run = limn(start + arguments);
        EXPECT_EQ(run.exit, 2) << arguments;
        EXPECT_NE(run.err.find(word), std::string::npos) << arguments << ": " << run.err;
    }
    const Outcome none = limn("tune cornell --budget-ms 1");
    EXPECT_EQ(none.exit, 2);
    EXPECT_NE(none.err.find("-o"), std::string::npos) << none.err;
    expectRefusal("tune cornell --budget-ms 1 -o " + path("x.gltf"), "x.gltf");
    expectRefusal("tune nothing --budget-ms 1 -o " + path("x.limn"), "nothing");
    EXPECT_FALSE(fs::exists(path("x.limn")));
}

} // namespace
} // namespace limn::tune_command_test
