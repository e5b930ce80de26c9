// SPDX-License-Identifier: MIT
#include "engine/files/image_file.h"
#include "tests/app/command_line.h"

namespace limn::explain_command_test {
namespace {

constexpr const char* kCamera = " --width 64 --height 64";
constexpr const char* kLight = " --light 'point pos=-1,4,1 cd=10 color=1,0.5,0.2'";

struct ExplainCommand : CommandLine {
    std::string baked() {
        const std::string bake = path("room.limnbake");
        json("bake cornell -o " + bake +
             " --surfels 2000 --links 32 --rays 64 --lightmap 2000 --json");
        return " --bake " + bake;
    }
    static double sumOf(const nlohmann::json& rows, const char* key) {
        double sum = 0;
        for (const nlohmann::json& row : rows)
            if (row["parent"].is_null())
                sum += double(row[key]);
        return sum;
    }
};

TEST_F(ExplainCommand, PrintsTablesThatSumToThePixelOfRender) {
    const std::string scene = std::string(" cornell") + baked() + kCamera + kLight;
    const std::string picture = path("picture.exr");
    json("render" + scene + " --device cpu --json -o " + picture);
    const Result<ImageF> image = readFloatImage(picture);
    ASSERT_TRUE(image) << image.error().message;
    const nlohmann::json told = json("explain" + scene + " --pick 50,55 --json");
    expectKeys(told, {"pick", "width", "height", "light", "unit", "total", "luminance", "objects",
                      "bounces", "ms", "by_origin", "by_sender"});
    for (int k = 0; k < 3; ++k) {
        const double shown = double(image->rgb[55 * 64 + 50][k]);
        EXPECT_NEAR(double(told["total"][std::size_t(k)]), shown, 0.01 * shown);
    }
    for (const char* table : {"by_origin", "by_sender"}) {
        EXPECT_NEAR(sumOf(told[table], "share"), 1, 1e-3) << table;
        EXPECT_NEAR(sumOf(told[table], "luminance"), double(told["luminance"]),
                    1e-3 * double(told["luminance"]))
            << table;
    }
}

TEST_F(ExplainCommand, SaysWhatThePixelWouldBeWithoutALight) {
    const std::string scene = std::string("explain cornell") + baked() + kCamera;
    const nlohmann::json with =
        json(scene + kLight + " --pick 50,55 --mute light:0 --mute sky --json");
    const nlohmann::json without = json(scene + " --pick 50,55 --json");
    EXPECT_EQ(with["without"]["muted"], (nlohmann::json{"light:0", "sky"}));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GT(double(with["total"][k]), 1.1 * double(without["total"][k]));
        // Direct light has fewer samples where other light is brighter.
        EXPECT_NEAR(double(with["without"]["value"][k]), double(without["total"][k]),
                    0.03 * double(without["total"][k]));
    }
}

TEST_F(ExplainCommand, PrintsATableForPeople) {
    const Outcome run = limn(std::string("explain cornell") + baked() + kCamera + kLight +
                             " --pick 50,55 --rows 2 --quantity irradiance --mute surface:3");
    EXPECT_EQ(run.exit, 0) << run.err;
    for (const char* word : {"irradiance", "By origin", "By what sends it", "light:0", "Panel",
                             "more", "Without surface:3"})
        EXPECT_NE(run.out.find(word), std::string::npos) << word << "\n" << run.out;
}

TEST_F(ExplainCommand, RefusesPixelsAndRowsThatAreNotThere) {
    EXPECT_EQ(limn("explain cornell").exit, 2) << "no pixel";
    EXPECT_EQ(limn("explain cornell --pick 5,-1").exit, 2);
    EXPECT_EQ(limn("explain cornell --pick 5").exit, 2);
    EXPECT_EQ(limn("explain cornell --pick 5,5 --quantity colour").exit, 2);
    expectRefusal("explain cornell --pick 64,5" + std::string(kCamera), "--pick");
    const std::string bake = baked();
    for (const char* row : {"light:0", "surface:900", "surface", "surface:-1", "lamp:1"})
        expectRefusal("explain cornell --pick 5,5" + bake + kCamera + " --mute " + row, "--mute");
}

} // namespace
} // namespace limn::explain_command_test
