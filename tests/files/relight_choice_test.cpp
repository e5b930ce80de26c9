// SPDX-License-Identifier: MIT
#include "engine/files/relight_choice.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace limn::relight_choice_test {
namespace {

namespace fs = std::filesystem;

constexpr RelightTimes kGpuFaster{8, 2}, kCpuFaster{2, 8}, kSame{3, 3};

TEST(RelightChoice, AutoTakesTheFasterAndTheCpuUntilThatIsKnown) {
    EXPECT_EQ(chooseRelight(RelightOn::Auto, true, kGpuFaster), RelightOn::Gpu);
    EXPECT_EQ(chooseRelight(RelightOn::Auto, true, kCpuFaster), RelightOn::Cpu);
    EXPECT_EQ(chooseRelight(RelightOn::Auto, true, kSame), RelightOn::Cpu);
    EXPECT_EQ(chooseRelight(RelightOn::Auto, true, {}), RelightOn::Cpu);
}

TEST(RelightChoice, WhatIsAskedForIsTakenHoweverSlow) {
    EXPECT_EQ(chooseRelight(RelightOn::Gpu, true, kCpuFaster), RelightOn::Gpu);
    EXPECT_EQ(chooseRelight(RelightOn::Gpu, true, {}), RelightOn::Gpu);
    EXPECT_EQ(chooseRelight(RelightOn::Cpu, true, kGpuFaster), RelightOn::Cpu);
}

TEST(RelightChoice, WithoutAGpuItIsTheCpu) {
    for (const RelightOn wanted : {RelightOn::Auto, RelightOn::Cpu, RelightOn::Gpu})
        EXPECT_EQ(chooseRelight(wanted, false, kGpuFaster), RelightOn::Cpu);
}

TEST(RelightChoice, AnotherDeviceDriverOrSizeIsAnotherKey) {
    const std::string key = relightTimesKey("device", 7, "links 4^6");
    EXPECT_EQ(relightTimesKey("device", 7, "links 4^6"), key);
    EXPECT_NE(relightTimesKey("other", 7, "links 4^6"), key);
    EXPECT_NE(relightTimesKey("device", 8, "links 4^6"), key);
    EXPECT_NE(relightTimesKey("device", 7, "links 4^7"), key);
}

class RelightTimesFile : public testing::Test {
protected:
    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }

    const fs::path folder =
        fs::temp_directory_path() / ("limn_relight_times" + std::to_string(getpid()));
    const std::string file = (folder / "below/relight.json").string();
};

TEST_F(RelightTimesFile, RemembersEachKeyAndTheLastTimes) {
    EXPECT_FALSE(rememberedRelightTimes(file, "a"));
    ASSERT_TRUE(rememberRelightTimes(file, "a", kGpuFaster));
    ASSERT_TRUE(rememberRelightTimes(file, "b", kSame));
    EXPECT_EQ(rememberedRelightTimes(file, "a"), kGpuFaster);
    EXPECT_EQ(rememberedRelightTimes(file, "b"), kSame);
    EXPECT_FALSE(rememberedRelightTimes(file, "c"));
    ASSERT_TRUE(rememberRelightTimes(file, "a", kCpuFaster));
    EXPECT_EQ(rememberedRelightTimes(file, "a"), kCpuFaster);
    EXPECT_EQ(rememberedRelightTimes(file, "b"), kSame);
}

TEST_F(RelightTimesFile, ADamagedFileHoldsNothingAndIsReplaced) {
    ASSERT_TRUE(rememberRelightTimes(file, "a", kGpuFaster));
    std::ifstream in(file);
    const std::string good{std::istreambuf_iterator<char>(in), {}};
    for (const std::string& bad :
         {std::string(), std::string("\0\xff", 2), good.substr(0, good.size() / 2),
          std::string("[1]"), std::string("{\"version\":1}"),
          std::string("{\"version\":2,\"times\":{\"a\":{\"cpu_ms\":1,\"gpu_ms\":2}}}"),
          std::string("{\"version\":1,\"times\":[]}"),
          std::string("{\"version\":1,\"times\":{\"a\":3}}"),
          std::string("{\"version\":1,\"times\":{\"a\":{\"cpu_ms\":\"1\",\"gpu_ms\":2}}}"),
          std::string("{\"version\":1,\"times\":{\"a\":{\"cpu_ms\":1}}}"),
          std::string("{\"version\":1,\"times\":{\"a\":{\"cpu_ms\":1,\"gpu_ms\":-2}}}"),
          std::string("{\"version\":1,\"times\":{\"a\":{\"cpu_ms\":1e999,\"gpu_ms\":2}}}")}) {
        std::ofstream(file, std::ios::binary) << bad;
        EXPECT_FALSE(rememberedRelightTimes(file, "a")) << bad;
        ASSERT_TRUE(rememberRelightTimes(file, "a", kCpuFaster)) << bad;
        EXPECT_EQ(rememberedRelightTimes(file, "a"), kCpuFaster) << bad;
    }
}

TEST_F(RelightTimesFile, AFolderThatCannotBeMadeIsAnErrorOfRememberingOnly) {
    fs::create_directories(folder);
    std::ofstream(folder / "below") << "a file";
    EXPECT_FALSE(rememberedRelightTimes(file, "a"));
    EXPECT_FALSE(rememberRelightTimes(file, "a", kSame));
}

} // namespace
} // namespace limn::relight_choice_test
