// SPDX-License-Identifier: MIT
// Light that a program keeps and mixes is that of all sources together.
#include "engine/runtime/limn_kept_light.h"
#include "tests/runtime/open_file.h"
#include "tests/techniques/illuminance/relight/lit_room.h"
#include "tests/techniques/illuminance/relight/relit.h"

#include <limits>

namespace limn::kept_light_test {
namespace {

/// A room with a lamp and a grid, as a file. `chroma`: bands that keep colour, 0: all.
std::string roomOf(std::uint32_t chroma) {
    Scene scene = *litRoom(600, 500);
    scene.bake.grid = {2, 2, 2};
    scene.bake.chromaBands = chroma;
    return fileOf(*bakeOf(TraceScene(scene)), scene);
}

const std::string& room() {
    static const std::string bytes = roomOf(0);
    return bytes;
}

/// Root of the mean squared difference, relative to that of `b`.
double difference(const std::vector<float>& a, const std::vector<float>& b) {
    double squares = 0, all = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        squares += (double(a[i]) - double(b[i])) * (double(a[i]) - double(b[i]));
        all += double(b[i]) * double(b[i]);
    }
    return std::sqrt(squares / all);
}

/// Two lamps at different places.
std::vector<limnrt_light> lamps(const OpenFile& file) {
    std::vector<limnrt_light> two(2, limnrt_file_lights(file)[0]);
    two[1].position[0] += 0.7f;
    two[1].position[1] -= 0.5f;
    return two;
}

/// Results of the lightmap, then of the grid.
std::vector<float> resultsOf(const OpenFile& file) {
    std::vector<float> all = file.lightmapSh();
    const limnrt_counts c = file.counts();
    std::vector<float> grid(std::size_t(4) * c.grid[0] * c.grid[1] * c.grid[2] * c.bands * c.bands);
    limnrt_grid_sh(file, grid.data());
    all.insert(all.end(), grid.begin(), grid.end());
    return all;
}

std::vector<float> litBy(const OpenFile& file, const std::vector<limnrt_light>& lights) {
    EXPECT_EQ(limnrt_set_lights(file, lights.data(), std::uint32_t(lights.size())), 1);
    limnrt_reset(file);
    limnrt_converge(file, 1000);
    EXPECT_EQ(limnrt_converged(file), 1);
    return resultsOf(file);
}

struct KeptLight : testing::Test {
    limnrt_options options{.max_kept = 3};
    OpenFile file{room(), &options};
    std::vector<limnrt_light> lights = lamps(file);

    /// Keeps the light of the first lamp in slot 0, of the second in slot 1.
    void keepBoth() {
        for (std::uint32_t k = 0; k < 2; ++k) {
            litBy(file, {lights[k]});
            EXPECT_EQ(limnrt_keep(file, k), 1);
        }
    }
};

TEST_F(KeptLight, MixesToTheLightOfAllSources) {
    ASSERT_TRUE(file) << file.message;
    EXPECT_EQ(limnrt_set_tolerance(file, 1e-6f), 1);
    keepBoth();
    for (const auto& [first, second] : {std::pair(glm::vec3(1), glm::vec3(1)),
                                        {glm::vec3(0.3f), glm::vec3(0)},
                                        {glm::vec3(2, 0.5f, 0), glm::vec3(0.1f, 1, 4)}}) {
        std::vector<limnrt_light> coloured = lights;
        for (int k = 0; k < 3; ++k) {
            coloured[0].color[k] *= first[k];
            coloured[1].color[k] *= second[k];
        }
        const std::vector<float> expected = litBy(file, coloured);
        const float rgb[6] = {first.x, first.y, first.z, second.x, second.y, second.z};
        ASSERT_EQ(limnrt_mix(file, rgb, 2), 1);
        const std::vector<float> mixed = resultsOf(file);
        // 16 bits a number, and bounces that end within 1e-6.
        EXPECT_LT(difference(mixed, expected), 5e-5);
        const float up[3] = {0, 1, 0}, middle[3] = {2, 1.5f, 2};
        float sampled[3];
        EXPECT_EQ(limnrt_sample_grid(file, middle, up, sampled), 1);
        EXPECT_GT(sampled[0] + sampled[1] + sampled[2], 0);
    }
}

// Where bands are grey, so are the factors with which their light is exact.
TEST(KeptLightOfGreyBands, MixesToTheLightOfAllSources) {
    const std::string bytes = roomOf(1);
    const limnrt_options options{.max_kept = 2};
    const OpenFile file(bytes, &options);
    ASSERT_EQ(file.counts().chroma_bands, 1U);
    const std::vector<limnrt_light> two = lamps(file);
    for (std::uint32_t k = 0; k < 2; ++k) {
        litBy(file, {two[k]});
        EXPECT_EQ(limnrt_keep(file, k), 1);
    }
    std::vector<limnrt_light> weaker = two;
    weaker[0].strength *= 3;
    weaker[1].strength *= 0.25f;
    const std::vector<float> expected = litBy(file, weaker);
    const float rgb[6] = {3, 3, 3, 0.25f, 0.25f, 0.25f};
    ASSERT_EQ(limnrt_mix(file, rgb, 2), 1);
    EXPECT_LT(difference(resultsOf(file), expected), 2e-4);
}

TEST_F(KeptLight, LeavesTheScenesOwnLight) {
    keepBoth();
    const std::vector<float> own = litBy(file, lights);
    const float half[6] = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
    ASSERT_EQ(limnrt_mix(file, half, 2), 1);
    const std::vector<float> mixed = resultsOf(file);
    EXPECT_NE(mixed, own);
    EXPECT_EQ(limnrt_converged(file), 1) << "the scene's own light has not changed";
    EXPECT_EQ(limnrt_mix(file, nullptr, 0), 1);
    EXPECT_EQ(resultsOf(file), own);
    ASSERT_EQ(limnrt_mix(file, half, 2), 1);
    limnrt_step(file);
    const std::vector<float> bounced = resultsOf(file);
    EXPECT_LT(difference(bounced, own), 1e-4) << "a bounce ends the mix";
    // What is mixed may be kept, too.
    ASSERT_EQ(limnrt_mix(file, half, 2), 1);
    EXPECT_EQ(limnrt_keep(file, 2), 1);
    const float third[9] = {0, 0, 0, 0, 0, 0, 1, 1, 1};
    ASSERT_EQ(limnrt_mix(file, third, 3), 1);
    const std::vector<float> again = resultsOf(file);
    EXPECT_LT(difference(again, mixed), 5e-5);
}

TEST_F(KeptLight, RefusesWhatIsNotThere) {
    const std::vector<float> own = litBy(file, lights);
    EXPECT_EQ(limnrt_keep(file, 3), 0) << "beyond max_kept";
    EXPECT_EQ(limnrt_keep(file, 0), 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float wrong : {nan, -1.f, 2e10f, std::numeric_limits<float>::infinity()}) {
        const float rgb[3] = {1, wrong, 1};
        EXPECT_EQ(limnrt_mix(file, rgb, 1), 0);
    }
    const float two[6] = {1, 1, 1, 0, 0.1f, 0}, many[12] = {};
    EXPECT_EQ(limnrt_mix(file, two, 2), 0) << "nothing is kept there";
    EXPECT_EQ(limnrt_mix(file, nullptr, 1), 0);
    EXPECT_EQ(limnrt_mix(file, many, 4), 0) << "beyond max_kept";
    EXPECT_EQ(resultsOf(file), own) << "nothing has changed";
    EXPECT_EQ(limnrt_mix(file, many, 3), 1) << "empty slots of no light";
    for (const float value : resultsOf(file))
        EXPECT_TRUE(value == 0 || value == 1) << "black, and where charts lie";
}

TEST_F(KeptLight, BlackAndFaintLightIsKept) {
    litBy(file, {});
    EXPECT_EQ(limnrt_keep(file, 0), 1);
    std::vector<limnrt_light> faint = {lights[0]};
    faint[0].strength = 1e-12f;
    const std::vector<float> light = litBy(file, faint);
    EXPECT_EQ(limnrt_keep(file, 1), 1);
    const float rgb[6] = {1, 1, 1, 1, 1, 1};
    ASSERT_EQ(limnrt_mix(file, rgb, 2), 1);
    EXPECT_LT(difference(resultsOf(file), light), 5e-5);
}

TEST(KeptLightOptions, TakeMemoryForEachSlotAlone) {
    limnrt_options options{.max_kept = 5000};
    EXPECT_EQ(OpenFile(room(), &options).message, "options: max_kept out of range");
    options.max_kept = 2;
    const OpenFile none(room()), two(room(), &options);
    const limnrt_counts c = none.counts();
    const std::uint64_t slot = std::uint64_t(c.caches) * (4 + 6 * c.bands * c.bands);
    EXPECT_NEAR(double(two.counts().memory - c.memory), double(2 * slot), 512);
    const float rgb[3] = {1, 1, 1};
    EXPECT_EQ(limnrt_keep(none, 0), 0);
    EXPECT_EQ(limnrt_mix(none, rgb, 1), 0);
}

} // namespace
} // namespace limn::kept_light_test
