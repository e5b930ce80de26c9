// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/baked_illuminance.h"

#include <gtest/gtest.h>

namespace limn {
namespace {

std::string sizeClassOf(std::size_t links) {
    Bake bake;
    bake.caches.links.resize(links);
    return BakedIlluminance(std::make_shared<const Bake>(std::move(bake))).sizeClass();
}

TEST(BakedIlluminance, TimesCarryOverToBakesOfAboutAsManyLinks) {
    EXPECT_EQ(sizeClassOf(1000), sizeClassOf(1001));
    EXPECT_NE(sizeClassOf(1000), sizeClassOf(4000));
}

TEST(BakedIlluminance, TracingTakesAsLongAsItsRaysAndTheRestAsItsSurfels) {
    Bake before;
    before.settings.rays = 64;
    before.settings.surfels = 100;
    before.seconds = {{"surfels", 1}, {"trace", 2}, {"cut", 3}};
    BakeSettings wanted = before.settings;
    wanted.rays = 1024;
    wanted.surfels = 200;
    const BakedIlluminance baked(std::make_shared<const Bake>(std::move(before)));
    EXPECT_EQ(baked.expectedSeconds(wanted),
              (StageSeconds{{"surfels", 2}, {"trace", 32}, {"cut", 12}}));
}

} // namespace
} // namespace limn
