// SPDX-License-Identifier: MIT
// `limn solve`: the strengths that it finds and writes, and what it refuses.
#include "engine/files/project_file.h"
#include "tests/app/command_line.h"

namespace limn::solve_command_test {
namespace {

constexpr const char* kCamera = " --width 64 --height 48";
constexpr const char* kLight = " --light 'point pos=0.3,1,0.2 cd=2'";

TEST_F(CommandLine, SolveWritesTheStrengthThatGivesAPixelItsLight) {
    const std::string project = path("solved.limn"), bake = path("room.limnbake");
    json("bake cornell -o " + bake + " --surfels 1000 --links 16 --rays 64 --lightmap 1000 --json");
    const std::string baked = kCamera + (" --bake " + bake);
    const nlohmann::json out =
        json("solve cornell --goal 32,40=5 --json" + baked + kLight + " -o " + project);
    expectKeys(out, {"quantity", "lights", "goals"});
    expectKeys(out["lights"][0], {"name", "unit", "strength", "solved", "factor"});
    const double after = out["goals"][0]["after"].get<double>();
    EXPECT_NEAR(after, 5, 5e-3);
    EXPECT_GT(std::abs(out["goals"][0]["before"].get<double>() - 5), 0.1);
    // The project has these strengths, and explaining the same pixel finds that light.
    const auto loaded = loadProject(project);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Scene scene = flatten(loaded->document, loaded->assets);
    ASSERT_EQ(scene.lights.size(), out["lights"].size());
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
        EXPECT_NEAR(scene.lights[l].strength, out["lights"][l]["solved"].get<double>(), 1e-4);
    const nlohmann::json pixel =
        json("explain " + project + " --pick 32,40 --quantity irradiance --json" + baked);
    EXPECT_NEAR(pixel["luminance"].get<double>(), 5, 0.05);
}

TEST_F(CommandLine, SolveRefusesHostileValuesByName) {
    const std::string start = std::string("solve cornell") + kCamera + kLight + " --goal ";
    for (const char* goal : {"64,40=5", "3,48=5", "3,4", "3=4", "3,4=-1", "3,4=0", "3,4=inf",
                             "3,4=nan", "3.5,4=1", "-1,4=1", "x,4=1"})
        expectRefusal(start + goal, "--goal");
    expectRefusal(start + "3,4=1 --lights 9", "--lights");
    expectRefusal(start + "3,4=1 -o " + path("x.gltf"), "x.gltf");
    expectRefusal("solve nothing --goal 3,4=1", "nothing");
    EXPECT_EQ(limn("solve cornell").exit, 2);
}

} // namespace
} // namespace limn::solve_command_test
