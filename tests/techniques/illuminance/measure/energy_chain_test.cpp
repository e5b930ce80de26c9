// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/measure/energy_chain.h"

#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace limn::energy_chain_test {
namespace {

using namespace simple;

/// A closed box that reflects half of the light and sends the same everywhere: all its irradiance
/// is pi L / (1 - 1/2).
Scene furnace() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1, 2, 0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    Scene scene = b.build();
    scene.bake.surfels = 500;
    scene.bake.lightmapCaches = 300;
    scene.bake.rays = 256;
    scene.bake.links = 32;
    return scene;
}

struct Measured {
    Scene scene = furnace();
    TraceScene trace{scene};

    Measured() = default;
    explicit Measured(Scene other) : scene(std::move(other)) {}

    Bake baked(CutCriterion cut, std::uint32_t links) const {
        BakeSettings settings = scene.bake;
        settings.cut = cut;
        settings.links = links;
        return *bake(trace, {}, nullptr, &settings);
    }
    Bake cut() const { return baked(CutCriterion::Detail, 32); }
    Bake uncut() const { return baked(CutCriterion::SolidAngle, 4096); }

    EnergyChain chain(Bake bake, Bake all) const {
        EnergyOptions options;
        options.camera.eye = {2, 1.5f, 2};
        options.camera.target = {0.3f, 0.2f, 0.5f};
        options.width = 32;
        options.height = 18;
        options.paths = 64;
        StageStore store;
        const BakedSenders senders(trace, scene, bake, store);
        EnergyChain chain =
            measureEnergyChain(trace,
                               {std::make_shared<const Bake>(std::move(bake)),
                                std::make_shared<const Bake>(std::move(all)), senders},
                               options);
        EXPECT_TRUE(chain.complete);
        EXPECT_EQ(chain.pixels, 32U * 18);
        EXPECT_LT(chain.noise, 0.01);
        EXPECT_EQ(chain.steps.size(), 6U);
        return chain;
    }

    /// By name.
    std::map<std::string, EnergyStep> steps(Bake bake, Bake all) const {
        const EnergyChain measured = chain(std::move(bake), std::move(all));
        std::map<std::string, EnergyStep> result;
        for (const EnergyStep& s : measured.steps)
            result[s.name] = s;
        result["emitters"] = measured.emitters;
        return result;
    }
};

/// What leaves a receiver half of its light.
void halveLinks(Caches& caches) {
    for (std::int8_t& exponent : caches.linkExponent)
        ++exponent; // of the scale that the halfs carry
}

TEST(EnergyChain, NothingIsLostInAWhiteFurnace) {
    const Measured m;
    for (const auto& [name, step] : m.steps(m.cut(), m.uncut())) {
        EXPECT_NEAR(step.energy, 1, 0.01) << name;
        EXPECT_LT(step.nrmse, 0.03) << name;
    }
}

TEST(EnergyChain, ALossIsShownAtTheStepThatHasIt) {
    const Measured m;
    Bake dim = m.cut();
    halveLinks(dim.caches);
    const auto steps = m.steps(dim, m.uncut());
    for (const char* name : {"reference", "texels", "surfels", "bounces, uncut"})
        EXPECT_NEAR(steps.at(name).energy, 1, 0.01) << name;
    EXPECT_NEAR(steps.at("cut").energy, 0.5, 0.01);
    EXPECT_NEAR(steps.at("emitters").energy, 0.5, 0.01);
    // E = (pi L + E / 2) / 2 gives 2/3 pi L instead of 2 pi L.
    EXPECT_NEAR(steps.at("bounces").energy, 1 / 3., 0.01);

    Bake dimAll = m.uncut();
    halveLinks(dimAll.caches);
    const auto others = m.steps(m.cut(), dimAll);
    EXPECT_NEAR(others.at("surfels").energy, 0.5, 0.01);
    EXPECT_NEAR(others.at("cut").energy, 1, 0.01);
    EXPECT_NEAR(others.at("bounces, uncut").energy, 1 / 3., 0.01);
    EXPECT_NEAR(others.at("bounces").energy, 1, 0.01);
    EXPECT_NEAR(others.at("emitters").energy, 1, 0.01);
}

// A lamp that reflects nothing covers a wall, so that no other surface reads its texels.
TEST(EnergyChain, TexelsOfLampsAreListedApart) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.addMaterial(lambert(glm::vec3(0), glm::vec3(1)));
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(quad({0.01f, 0, 0}, {0, 3, 0}, {0, 0, 5}, 1));
    Scene scene = b.build();
    scene.bake = furnace().bake;
    const Measured m(scene);
    Bake bright = m.cut();
    for (std::size_t c = 0; c < bright.caches.lightmapCount; ++c)
        if (bright.caches.position[c].x > 0.005f && bright.caches.position[c].x < 0.015f &&
            bright.caches.normal[c].x > 0.9f)
            bright.caches.linkExponent[c] -= 3;
    const EnergyChain chain = m.chain(bright, m.uncut());
    EXPECT_GT(chain.lamps, 20U);
    EXPECT_LT(chain.lamps, chain.pixels - 20);
    ASSERT_EQ(chain.onLamps.size(), chain.steps.size());
    for (std::size_t k = 0; k < chain.steps.size(); ++k) {
        const EnergyStep &step = chain.steps[k], &onLamps = chain.onLamps[k];
        EXPECT_EQ(onLamps.name, step.name);
        EXPECT_NEAR(step.energy, 1, 0.03) << step.name;
        const bool reads = step.name == "cut" || step.name == "bounces";
        EXPECT_NEAR(onLamps.energy, reads ? 8 : 1, reads ? 0.8 : 0.1) << step.name;
    }
    EXPECT_NEAR(chain.emitters.energy, 1, 0.03);
}

TEST(EnergyChain, SendersOfAllDistancesAreRightInAFurnace) {
    const Measured m;
    const std::vector<SendersAt> senders = m.chain(m.cut(), m.uncut()).senders;
    double share = 0;
    float end = 0;
    for (const SendersAt& s : senders) {
        EXPECT_EQ(s.from, end);
        EXPECT_NEAR(s.excess, 0, 1e-3 + 0.02 * s.share) << s.from;
        share += s.share;
        end = s.to;
    }
    EXPECT_EQ(end, std::numeric_limits<float>::infinity());
    EXPECT_NEAR(share, 1, 0.01);
}

// Far outside the box there is no light, and surfels are left with what they emit: pi L of 2 pi L.
TEST(EnergyChain, ALackOfLightIsShownAtEveryDistanceThatHasIt) {
    const Measured m;
    Bake dark = m.cut();
    for (glm::vec3& p : dark.surfels.position)
        p += glm::vec3(100);
    dark.surfels.lightPoints.clear();
    for (const SendersAt& s : m.chain(dark, m.uncut()).senders)
        EXPECT_NEAR(s.excess, -s.share / 2, 1e-3 + 0.02 * s.share) << s.from;
}

TEST(EnergyChain, DistancesOfSendersAreInWidthsOfTheirPatches) {
    const Measured m;
    Bake narrow = m.cut();
    for (float& area : narrow.surfels.area)
        area /= 256;
    const std::vector<SendersAt> wide = m.chain(m.cut(), m.uncut()).senders,
                                 times16 = m.chain(narrow, m.uncut()).senders;
    for (std::size_t k = 0; k + 3 < wide.size(); ++k) { // two ranges are a factor of 16
        EXPECT_EQ(16 * wide[k].to, times16[k + 2].to);
        EXPECT_NEAR(wide[k].share, times16[k + 2].share, k > 0 ? 1e-9 : 0.01) << k;
    }
}

TEST(EnergyChain, ACancelledMeasurementIsNotComplete) {
    const Measured m;
    const std::atomic<bool> cancel = true;
    const Progress progress{.report = {}, .cancel = &cancel};
    const auto bake = std::make_shared<const Bake>(m.cut());
    StageStore store;
    const BakedSenders senders(m.trace, m.scene, *bake, store);
    EXPECT_FALSE(measureEnergyChain(m.trace, {bake, bake, senders}, {}, progress).complete);
}

} // namespace
} // namespace limn::energy_chain_test
