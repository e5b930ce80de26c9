// SPDX-License-Identifier: MIT
// Light at the feet of walls, as a program without snaps reads it from a lightmap.
#include "engine/export/exported_lightmap.h"

#include "engine/export/lightmap_error.h"
#include "engine/reference/path.h"
#include "tests/export/exported_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace limn::house_test {
namespace {

constexpr float kStoreys[2][2] = {{0, 2.6f}, {2.8f, 5.4f}};    // floor and ceiling [m]
constexpr glm::vec2 kAcross(3.1f, 3.25f), kAlong(2.9f, 3.02f); // faces of the inner walls in x, z

/// A house of two storeys with four rooms each. Its inner walls and the slab between the storeys
/// are boxes that pass through each other, the floor and the ceiling. Three rooms have a lamp, one
/// shares it through a door, and the others are sealed.
Document houseDocument(Assets& assets) {
    using namespace simple;
    Document d;
    const auto wall = [](glm::vec3 lower, glm::vec3 upper) { return box(lower, upper, false); };
    assets.meshes = {box(glm::vec3(0), {8, 5.4f, 6}, true),
                     wall({-0.1f, 2.6f, -0.1f}, {8.1f, 2.8f, 6.1f}),
                     wall({kAcross.x, -0.15f, -0.1f}, {kAcross.y, 5.55f, 6.1f}),
                     wall({-0.1f, -0.15f, kAlong.x}, {5, 5.55f, kAlong.y}),
                     wall({5.9f, -0.15f, kAlong.x}, {8.1f, 5.55f, kAlong.y}),
                     wall({4.9f, 2, kAlong.x}, {6, 2.7f, kAlong.y}),
                     wall({4.9f, 4.8f, kAlong.x}, {6, 5.5f, kAlong.y})};
    addObject(d, lambert({0.7f, 0.65f, 0.6f}));
    for (std::uint32_t mesh = 0; mesh < assets.meshes.size(); ++mesh) {
        Node node;
        node.meshes = {mesh};
        addObject(d, node);
    }
    for (const glm::vec3 position :
         {glm::vec3(1.5f, 2, 1.4f), glm::vec3(5.5f, 2, 1.4f), glm::vec3(1.5f, 4.8f, 4.5f)})
        addObject(d, Light{.position = position, .strength = 20});
    addObject(d, Camera{.name = "eye", .eye = {1, 1.5f, 1}, .target = {2, 1, 2}});
    BakeSettings bake;
    bake.surfels = 4000;
    bake.lightmapCaches = 6000;
    bake.rays = 128;
    addObject(d, bake);
    return d;
}

/// What rays meet within 10 cm of the inner walls' edges with floors and ceilings: on these, and on
/// the walls above or below them. No place is near the doors, beside which an edge of light lies.
std::vector<Hit> feet(const TraceScene& trace) {
    std::vector<Hit> hits;
    const auto add = [&](glm::vec3 from, glm::vec3 direction) {
        if (const Hit hit = trace.closestHit({from, direction, 0, 1}); hit && hit.frontFace)
            hits.push_back(hit);
    };
    for (const auto& [floor, ceiling] : kStoreys)
        for (const float away : {0.02f, 0.07f})
            for (const float t : {0.07f, 0.31f, 0.55f, 0.93f})
                for (const bool across : {true, false})
                    for (const int side : {-1, 1}) {
                        const glm::vec2 faces = across ? kAcross : kAlong;
                        const float face = side < 0 ? faces.x : faces.y;
                        const auto place = [&](float beside, float y) {
                            const float p = face + float(side) * beside;
                            return across ? glm::vec3(p, y, 6 * t) : glm::vec3(8 * t, y, p);
                        };
                        const glm::vec3 toWall =
                            across ? glm::vec3(-side, 0, 0) : glm::vec3(0, 0, -side);
                        add(place(away, floor + 0.5f), {0, -1, 0});
                        add(place(away, ceiling - 0.5f), {0, 1, 0});
                        add(place(0.5f, floor + away), toWall);
                        add(place(0.5f, ceiling - away), toWall);
                    }
    return hits;
}

struct House {
    std::shared_ptr<Assets> assets = std::make_shared<Assets>();
    ExportedRoom room{houseDocument(*assets), assets};
    std::vector<Hit> hits = feet(room.trace);
    std::vector<float> truth; ///< grey irradiance at the hits
    float lit = 0;            ///< its mean where there is any

    House() {
        std::size_t count = 0;
        for (const Hit& hit : hits) {
            truth.push_back(trace(hit, 256, 3));
            lit += truth.back();
            count += truth.back() > 0 ? 1 : 0;
        }
        lit /= float(count);
    }
    float trace(const Hit& hit, std::uint32_t paths, std::uint32_t seed) const {
        const Emitters emitters = findEmitters(room.trace);
        const SkyLight sky = findSkyLight(room.scene.sky);
        const PathContext context{room.trace, emitters, sky};
        const SurfacePoint p = *surfacePoint(room.trace, hit);
        std::uint64_t rays = 0;
        glm::vec3 sum(0);
        for (std::uint32_t s = 0; s < paths; ++s)
            sum += sampleIndirectIrradiance(context, p, {seed, s}, rays);
        return (sum.x + sum.y + sum.z) / (3 * float(paths));
    }
    /// Largest excesses of what a lightmap shows over the truth, relative to the mean where there
    /// is light: of all places, and of those that no light reaches.
    struct Excess {
        float worst = 0, leak = 0;
    };
    /// Places where the excess is large by few paths are traced again by many with other noise.
    Excess excessOf(const ExportSettings& settings) const {
        constexpr std::size_t kAgain = 12;
        const Result<ExportedLightmap> map =
            exportedLightmap(room.view(), settings, PageCount::Any, {});
        EXPECT_TRUE(map) << map.error().message;
        struct Place {
            std::size_t hit;
            float shown, excess;
        };
        std::vector<Place> places;
        Excess found;
        for (std::size_t k = 0; k < hits.size(); ++k) {
            const glm::vec3 e = *lookUpExported(room.view(), map->cut.get(), map->pages,
                                                map->images, hits[k], hits[k].geometricNormal);
            const float shown = (e.x + e.y + e.z) / 3;
            places.push_back({k, shown, shown - truth[k]});
            if (!(truth[k] > 0))
                found.leak = std::max(found.leak, shown / lit);
        }
        std::ranges::sort(places, std::ranges::greater{}, &Place::excess);
        for (std::size_t k = 0; k < kAgain; ++k) {
            const float again = trace(hits[places[k].hit], 4096, 4);
            found.worst = std::max(found.worst, (places[k].shown - again) / lit);
        }
        return found;
    }
};

TEST(House, NoLightLeaksAtTheFeetOfWallsThatPassThroughFloors) {
    const House house;
    ASSERT_GT(house.hits.size(), 250U);
    const House::Excess draft = house.excessOf({.quality = LightmapQuality::Draft}),
                        final = house.excessOf({});
    RecordProperty("worst of the draft", std::to_string(draft.worst));
    RecordProperty("worst of the final map", std::to_string(final.worst));
    EXPECT_GT(draft.leak, 0.1f); // what is lit lies on the other side of a wall
    EXPECT_LT(final.leak, 0.5f * draft.leak);
}

} // namespace
} // namespace limn::house_test
