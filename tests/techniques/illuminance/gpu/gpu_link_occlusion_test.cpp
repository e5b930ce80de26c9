// SPDX-License-Identifier: MIT
#include "tests/techniques/illuminance/gpu/relit_scene.h"
#include "tests/techniques/illuminance/gpu/rounding.h"

#include <glm/gtc/matrix_transform.hpp>

namespace limn::gpu_link_occlusion_test {
namespace {

/// The court with a dynamic block over its floor that occludes links. Few bounces, so that light
/// does not depend on the light that was.
Scene occludedCourt(LinkStorage storage) {
    Scene scene = court(simple::box(glm::vec3(-0.4f), glm::vec3(0.4f), false, 2));
    scene.relight.dynamicOcclusion = true;
    scene.bake.storage = storage;
    scene.relight.maxBounces = 3;
    return scene;
}

void moveTo(Scene& scene, glm::vec3 place) {
    scene.instances.back().toWorld =
        glm::rotate(glm::translate(glm::mat4(1), place), 0.5f, glm::vec3(0, 1, 0));
}

class GpuLinkOcclusion : public DeviceTest {
protected:
    void prepare(const Scene& with) {
        scene = with;
        moveTo(scene, kPlaces[0]);
        made = baked(TraceScene(scene), scene.bake);
        relighter = gpuRelighter(*device, made);
        cpu = std::make_unique<Relighter>(made, LitBands::All);
    }
    /// As both see the scene now.
    void relight() {
        const TraceScene trace(scene);
        const SurfelValues values = surfelValues(*made, scene, trace);
        SurfelInputs inputs = values.inputs(&scene);
        inputs.settings = scene.relight;
        stats = relighter->relight(inputs, 3);
        cpuStats = cpu->relight(scene, trace, 3);
    }
    void expectSame() const {
        const double terms = maxLinks(made->caches), brightest = largest(cpu->cacheSh());
        expectRounding("caches", distance(relighter->readCacheSh(), cpu->cacheSh()), terms,
                       brightest);
        expectRounding("radiosity", distance(relighter->readRadiosity(), radiosityOf(*cpu)), terms,
                       largest(radiosityOf(*cpu)));
        EXPECT_EQ(stats.linksOccluded, cpuStats.linksOccluded);
        EXPECT_EQ(stats.cachesOccluded, cpuStats.cachesOccluded);
        EXPECT_EQ(stats.bounces, cpuStats.bounces);
    }
    /// Of a changed link: its number and what changes of it.
    std::uint64_t bytesOfLink() const {
        const std::uint32_t coefficients = made->settings.bands * made->settings.bands;
        return 4 + (made->caches.shNode.empty() ? 4 : (coefficients + 1) / 2 * 4);
    }

    static constexpr glm::vec3 kPlaces[] = {
        {3.2f, 0.6f, 3}, {3, 1.2f, 3.5f}, {0.6f, 2, 0.7f}, {3.2f, 0.6f, 3.1f}};

    Scene scene;
    std::shared_ptr<Bake> made;
    std::unique_ptr<GpuRelighter> relighter;
    std::unique_ptr<Relighter> cpu;
    GpuRelightStats stats;
    RelightStats cpuStats;
};

TEST_F(GpuLinkOcclusion,
       GivesTheLightOfTheCpuWhereverAnObjectMovesAndExactlyThatWhichWasWhenItIsGone) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const std::uint32_t bands : {3U, 4U}) { // an odd number of halfs, and an even one
            Scene start = occludedCourt(storage);
            start.bake.bands = bands;
            start.lights.clear(); // the object's shadow would move too
            prepare(start);
            scene.relight.dynamicOcclusion = false;
            relight();
            EXPECT_EQ(stats.linksOccluded, 0U);
            EXPECT_EQ(stats.occlusionMs, 0);
            const std::vector<glm::vec3> unoccluded = relighter->readCacheSh();
            scene.relight.dynamicOcclusion = true;
            std::vector<glm::vec3> first;
            for (const glm::vec3 place : kPlaces) {
                std::printf("storage %d, %u bands\n", int(storage), bands);
                moveTo(scene, place);
                relight();
                EXPECT_GT(stats.linksOccluded, made->caches.linkCount() / 100);
                EXPECT_GT(stats.occlusionMs, 0);
                expectSame();
                if (first.empty())
                    first = relighter->readCacheSh();
            }
            EXPECT_GT(distance(first, unoccluded).max, 0.05 * largest(unoccluded));
            moveTo(scene, kPlaces[0]);
            relight();
            EXPECT_TRUE(relighter->readCacheSh() == first);
            moveTo(scene, glm::vec3(100)); // where it hides nothing
            relight();
            EXPECT_EQ(stats.linksOccluded, 0U);
            EXPECT_TRUE(relighter->readCacheSh() == unoccluded);
            moveTo(scene, kPlaces[1]);
            relight();
            scene.relight.dynamicOcclusion = false;
            relight();
            EXPECT_EQ(stats.linksOccluded, 0U);
            EXPECT_EQ(stats.cachesOccluded, 0U);
            EXPECT_TRUE(relighter->readCacheSh() == unoccluded);
        }
}

TEST_F(GpuLinkOcclusion, SendsTheLinksThatChangedAndNothingWhereNoneDoes) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        prepare(occludedCourt(storage));
        scene.lights.clear();
        scene.relight.dynamicOcclusion = false;
        relight();
        scene.relight.dynamicOcclusion = true;
        relight();
        const std::uint64_t all = stats.linksOccluded;
        EXPECT_EQ(stats.bytesUploaded, all * bytesOfLink());
        const std::uint64_t memory = device->memory.bytesInUse;
        moveTo(scene, kPlaces[0] + glm::vec3(0, 0.01f, 0));
        relight();
        EXPECT_GT(stats.bytesUploaded, 0U);
        EXPECT_LT(stats.bytesUploaded, all * bytesOfLink() / 4);
        EXPECT_EQ(stats.bytesUploaded % bytesOfLink(), 0U);
        EXPECT_EQ(device->memory.bytesInUse, memory);
        relight();
        EXPECT_EQ(stats.bytesUploaded, 0U);
        EXPECT_EQ(stats.occlusionMs, 0);
        moveTo(scene, glm::vec3(100));
        relight();
        moveTo(scene, glm::vec3(101));
        relight();
        relight();
        EXPECT_EQ(stats.bytesUploaded, 0U);
        EXPECT_EQ(device->memory.bytesInUse, memory);
    }
}

TEST_F(GpuLinkOcclusion, AnObjectThatHidesNothingWhereverItMovesCostsNoBounce) {
    Scene start = occludedCourt(LinkStorage::Rtp);
    start.lights.clear();
    prepare(start);
    scene.relight.maxBounces = 100;
    moveTo(scene, glm::vec3(100));
    for (int k = 0; k < 60; ++k)
        relight();
    EXPECT_TRUE(stats.skipped);
    EXPECT_TRUE(cpuStats.skipped);
    moveTo(scene, glm::vec3(101));
    relight();
    EXPECT_TRUE(stats.skipped);
    EXPECT_TRUE(cpuStats.skipped);
    EXPECT_GT(stats.occlusionMs, 0);
    moveTo(scene, kPlaces[0]);
    relight();
    EXPECT_FALSE(stats.skipped);
    EXPECT_GT(stats.bounces, 1U);
    EXPECT_FALSE(cpuStats.skipped);
}

TEST_F(GpuLinkOcclusion, SendsInPartsWhatIsMoreThanFitsAtOnce) {
    Scene start = occludedCourt(LinkStorage::Sh);
    start.bake.bands = 8;
    prepare(start);
    scene.instances.back().toWorld = glm::scale(glm::mat4(1), glm::vec3(100)); // all are within
    relight();
    EXPECT_GT(stats.linksOccluded * bytesOfLink(), 2U << 20);
    expectSame();
    moveTo(scene, kPlaces[1]);
    relight();
    expectSame();
}

} // namespace
} // namespace limn::gpu_link_occlusion_test
