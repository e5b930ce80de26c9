// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/measure/energy_chain.h"

#include "engine/lightmap/atlas_stage.h"
#include "engine/scene/mesh/input_hash.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <utility>

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
    CachePoints points;

    Measured() {
        std::uint64_t rays = 0;
        const auto atlas = atlasStage(trace, scene, hashMeshes(scene), {}, nullptr, rays);
        placeCaches(scene, atlas->atlas, points);
    }
    Bake baked(CutCriterion cut, std::uint32_t links) const {
        BakeSettings settings = scene.bake;
        settings.cut = cut;
        settings.links = links;
        return *bake(trace, {}, nullptr, &settings);
    }
    Bake cut() const { return baked(CutCriterion::Detail, 32); }
    Bake uncut() const { return baked(CutCriterion::SolidAngle, 4096); }

    /// By name.
    std::map<std::string, EnergyStep> steps(Bake bake, Bake all) const {
        EnergyOptions options;
        options.camera.eye = {2, 1.5f, 2};
        options.camera.target = {0.3f, 0.2f, 0.5f};
        options.width = 32;
        options.height = 18;
        options.paths = 64;
        const EnergyChain chain =
            measureEnergyChain(trace,
                               {std::make_shared<const Bake>(std::move(bake)),
                                std::make_shared<const Bake>(std::move(all)), points},
                               options);
        EXPECT_TRUE(chain.complete);
        EXPECT_EQ(chain.pixels, 32U * 18);
        EXPECT_LT(chain.noise, 0.01);
        std::map<std::string, EnergyStep> result;
        for (const EnergyStep& s : chain.steps)
            result[s.name] = s;
        EXPECT_EQ(result.size(), 6U);
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
    // E = (pi L + E / 2) / 2 gives 2/3 pi L instead of 2 pi L.
    EXPECT_NEAR(steps.at("bounces").energy, 1 / 3., 0.01);

    Bake dimAll = m.uncut();
    halveLinks(dimAll.caches);
    const auto others = m.steps(m.cut(), dimAll);
    EXPECT_NEAR(others.at("surfels").energy, 0.5, 0.01);
    EXPECT_NEAR(others.at("cut").energy, 1, 0.01);
    EXPECT_NEAR(others.at("bounces, uncut").energy, 1 / 3., 0.01);
    EXPECT_NEAR(others.at("bounces").energy, 1, 0.01);
}

TEST(EnergyChain, ACancelledMeasurementIsNotComplete) {
    const Measured m;
    const std::atomic<bool> cancel = true;
    const Progress progress{.report = {}, .cancel = &cancel};
    const auto bake = std::make_shared<const Bake>(m.cut());
    EXPECT_FALSE(measureEnergyChain(m.trace, {bake, bake, m.points}, {}, progress).complete);
}

} // namespace
} // namespace limn::energy_chain_test
