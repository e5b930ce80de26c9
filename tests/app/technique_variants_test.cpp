// SPDX-License-Identifier: MIT
#include "app/bench/technique_variants.h"

#include "app/bench/picture_size.h"
#include "engine/techniques/technique_table.h"

#include <gtest/gtest.h>

namespace limn::technique_variants_test {
namespace {

std::vector<std::string> namesOf(const std::vector<Variant>& variants) {
    std::vector<std::string> names;
    for (const Variant& variant : variants)
        names.push_back(variant.name);
    return names;
}

TEST(TechniqueVariants, AreEveryCombinationOfTheValuesThatVary) {
    const SettingsSweep varied =
        variedSettings({"probes.side=9", "probes.side=16,32", "probes.count=64,256"});
    const std::vector<Variant> variants = variantsOf(*findTechnique("probes"), {}, varied);
    EXPECT_EQ(namesOf(variants),
              (std::vector<std::string>{"count 64, side 16", "count 64, side 32",
                                        "count 256, side 16", "count 256, side 32"}));
    EXPECT_EQ(variants[1].choice.settings,
              (std::map<std::string, double>{{"probes.count", 64}, {"probes.side", 32}}));
    EXPECT_EQ(variants[2].choice.technique, "probes");
}

TEST(TechniqueVariants, SettingsOfBakesVaryWhatIsPrecomputedOnly) {
    const SettingsSweep varied = variedSettings({"surfels=500,1000", "sparse-probes.bands=2"});
    const std::vector<Variant> variants = variantsOf(*findTechnique("sparse-probes"), {}, varied);
    EXPECT_EQ(namesOf(variants),
              (std::vector<std::string>{"bands 2, surfels 500", "bands 2, surfels 1000"}));
    EXPECT_EQ(variants[1].bake.surfels, 1000U);
    EXPECT_EQ(variants[1].bake.links, BakeSettings{}.links);
    for (const char* other : {"ambient", "lpv"})
        EXPECT_EQ(namesOf(variantsOf(*findTechnique(other), {}, varied)),
                  namesOf(variantsOf(*findTechnique(other), {})));
}

TEST(TechniqueVariants, WithoutValuesArePresetsOrStepsOfTheFirstSetting) {
    EXPECT_EQ(namesOf(variantsOf(*findTechnique("illuminance"), {})),
              (std::vector<std::string>{"draft", "medium", "high"}));
    EXPECT_EQ(variantsOf(*findTechnique("probes"), {}).size(), 5U);
}

TEST(TechniqueVariants, ADefectNamesTheSettingAndTheValue) {
    for (const char* good : {"probes.count=64", "surfels=64,128", "storage=sh,rtp", "grid=3x3x3"})
        EXPECT_EQ(variedDefect(good), "") << good;
    for (const auto& [bad, word] : {std::pair("probes.count", "KEY=VALUE"),
                                    {"probes.count=", "probes.count: \"\" is not a number"},
                                    {"probes.count=64,,9", "\"\" is not a number"},
                                    {"probes.count=64.5", "64.5 is not a whole number"},
                                    {"probes.count=nan", "\"nan\" is not a number"},
                                    {"probes.count=1e9", "outside"},
                                    {"probes.nothing=1", "probes.nothing: neither"},
                                    {"=1", "neither"},
                                    {"surfels=3", "surfels: 3 is outside"},
                                    {"storage=zip", "storage: "}})
        EXPECT_NE(variedDefect(bad).find(word), std::string::npos) << variedDefect(bad);
}

TEST(PictureSize, IsTwoPositiveNumbers) {
    EXPECT_EQ(pictureSize("320x180"), glm::uvec2(320, 180));
    for (const char* bad : {"", "320", "320x", "x180", "0x9", "9x0", "-1x9", "1x2x3", "99999x9"})
        EXPECT_FALSE(pictureSize(bad)) << bad;
}

} // namespace
} // namespace limn::technique_variants_test
