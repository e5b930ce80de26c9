// SPDX-License-Identifier: MIT
#include "engine/gallery/gallery.h"

#include "engine/core/hash.h"
#include "engine/gallery/blocks.h"
#include "engine/gallery/coloured_street.h"
#include "engine/gallery/hostile_scene.h"
#include "engine/gallery/random_stream.h"
#include "engine/math/sampling.h"
#include "engine/reference/reference.h"
#include "engine/scene/reach.h"
#include "tests/core/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <glm/geometric.hpp>

namespace limn::gallery_test {
namespace {

constexpr std::uint64_t kSeeds = 200, kTraced = kSanitized ? 40 : kSeeds;

bool finite(glm::vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

std::size_t countTriangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& i : scene.instances)
        count += scene.meshOf(i).triangleCount();
    return count;
}

/// What the importer guarantees of a mesh.
void expectSound(const Mesh& mesh) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_TRUE(mesh.uv0.empty() || mesh.uv0.size() == mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        ASSERT_TRUE(finite(mesh.positions[i]));
        ASSERT_NEAR(glm::length(mesh.normals[i]), 1, 1e-4);
    }
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        ASSERT_LT(std::max({a, b, c}), mesh.positions.size());
        const glm::vec3 p = mesh.positions[a];
        ASSERT_GT(glm::length(glm::cross(glm::dvec3(mesh.positions[b] - p),
                                         glm::dvec3(mesh.positions[c] - p))),
                  0);
    }
}

/// Share of the directions from the eye in which the nearest surface shows its back, and how near
/// the nearest is, in diagonals of the scene.
struct Around {
    double backs = 0, nearest = 1;
};
Around lookAround(const TraceScene& trace, glm::vec3 eye) {
    const DirectionSet directions(256, true, 1);
    const double diagonal = double(glm::length(trace.scene().bounds.size()));
    Around around;
    for (std::uint32_t i = 0; i < directions.count; ++i) {
        const Hit hit = trace.closestHit({eye, directions[i]});
        if (!hit)
            continue;
        around.backs += hit.frontFace ? 0 : 1.0 / directions.count;
        around.nearest = std::min(around.nearest, double(hit.t) / diagonal);
    }
    return around;
}

ImageF irradiance(const TraceScene& trace, const Camera& camera, std::uint32_t width,
                  std::uint32_t samples) {
    ReferenceOptions options;
    options.view = View::Irradiance;
    options.camera = camera;
    options.width = width;
    options.height = width * 9 / 16;
    options.samplesPerPixel = samples;
    return renderReference(trace, options).image;
}

double shareOfLitPixels(const ImageF& image) {
    return double(std::count_if(image.rgb.begin(), image.rgb.end(),
                                [](glm::vec3 p) { return p.x + p.y + p.z > 0; })) /
           double(image.rgb.size());
}

TEST(HostileScenes, AreTheSameForTheSameSeedAndKeepWhatTheImporterGuarantees) {
    std::set<LightKind> lights;
    std::size_t objects = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const HostileScene scene = hostileScene(seed), again = hostileScene(seed);
        EXPECT_TRUE(scene.document == again.document);
        EXPECT_TRUE(scene.assets->meshes == again.assets->meshes);
        for (const Mesh& m : scene.assets->meshes) {
            EXPECT_EQ(m.normals.size(), m.positions.size());
            EXPECT_EQ(m.indices.size() % 3, 0U);
            for (const std::uint32_t i : m.indices)
                ASSERT_LT(i, m.positions.size());
            for (const glm::vec3 n : m.normals)
                ASSERT_NEAR(glm::length(n), 1, 1e-5);
        }
        for (const auto& [id, object] : scene.document.objects) {
            if (const Light* light = std::get_if<Light>(&object))
                lights.insert(light->kind);
            objects += std::holds_alternative<Node>(object);
        }
        EXPECT_EQ(reachDefect(flatten(scene.document, scene.assets)), "");
    }
    EXPECT_EQ(lights.size(), 4U);
    EXPECT_GT(objects, 400U);
}

} // namespace

TEST(Gallery, EverySeedGivesASoundLitSceneWithACameraInTheOpen) {
    for (std::uint64_t seed = 0; seed < kTraced; ++seed) {
        const GeneratedScene made = generateScene(seed);
        SCOPED_TRACE(std::to_string(seed) + " " +
                     std::string(kSceneKindNames[std::size_t(made.kind)]) + " " + made.description);
        const Scene scene = flatten(made.document, made.assets);
        ASSERT_GT(countTriangles(scene), 5u);
        ASSERT_LT(countTriangles(scene), 60000u);
        for (const Mesh& mesh : made.assets->meshes)
            expectSound(mesh);
        ASSERT_EQ(scene.cameras.size(), 1u);
        const Camera& camera = scene.cameras.front();
        ASSERT_TRUE(finite(camera.eye) && finite(camera.target));
        const TraceScene trace(scene);
        const Around around = lookAround(trace, camera.eye);
        EXPECT_LT(around.backs, 0.1);
        EXPECT_GT(around.nearest, 1e-4);
        const ImageF picture = irradiance(trace, camera, 16, 32);
        EXPECT_EQ(std::count_if(picture.rgb.begin(), picture.rgb.end(),
                                [](glm::vec3 p) { return !finite(p); }),
                  0);
        EXPECT_GT(shareOfLitPixels(picture), 0.3); // of few samples
    }
}

TEST(Gallery, NoLightReachesTheSealedRoom) {
    std::size_t rooms = 0;
    for (std::uint64_t seed = 0; seed < kTraced; ++seed) {
        if (SceneKind(seed % kSceneKindNames.size()) != SceneKind::TwoRooms)
            continue;
        const GeneratedScene made = generateScene(seed);
        SCOPED_TRACE(std::to_string(seed) + " " + made.description);
        ASSERT_TRUE(made.darkCamera);
        const TraceScene trace(flatten(made.document, made.assets));
        // A wall without thickness between the rooms shows its back here.
        EXPECT_LT(lookAround(trace, made.darkCamera->eye).backs, 0.5);
        EXPECT_EQ(shareOfLitPixels(irradiance(trace, *made.darkCamera, 32, 64)), 0);
        ++rooms;
    }
    EXPECT_GT(rooms, kTraced / 20);
}

// The sun lights planes, car and ground; the fronts of the houses opposite see no sun.
TEST(Gallery, TheColouredStreetLightsTheHousesOppositeByItsPlanes) {
    const GeneratedScene made = colouredStreet();
    for (const Mesh& mesh : made.assets->meshes)
        expectSound(mesh);
    const Scene scene = flatten(made.document, made.assets);
    ASSERT_EQ(scene.lights.size(), 1U);
    const TraceScene trace(scene);
    const glm::vec3 toSun = -scene.lights[0].direction;
    const auto inSun = [&](glm::vec3 p, glm::vec3 normal) {
        return glm::dot(normal, toSun) > 0 && !trace.occluded({trace.clearOf(p, normal), toSun});
    };
    for (const float x : {12.f, 21.f, 30.f}) {
        EXPECT_TRUE(inSun({x, 2, -4.4f}, {0, 0, 1})) << "a plane";
        EXPECT_FALSE(inSun({x, 3, 5}, {0, 0, -1})) << "the house opposite";
        EXPECT_FALSE(trace.blocked({x, 2, -4.3f}, {x, 3, 4.9f})) << "they see each other";
    }
    EXPECT_TRUE(inSun({17, 1.5f, -3}, {0, 1, 0})) << "the car";
    EXPECT_TRUE(std::ranges::any_of(scene.instances, [](const Instance& i) { return i.dynamic; }));
    EXPECT_LT(lookAround(trace, scene.cameras.at(0).eye).backs, 0.1);
}

TEST(Gallery, TheSameSeedGivesTheSameScene) {
    for (const std::uint64_t seed : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 4321}) {
        const GeneratedScene a = generateScene(seed), b = generateScene(seed);
        EXPECT_EQ(a.document, b.document);
        EXPECT_EQ(a.assets->meshes, b.assets->meshes);
        EXPECT_EQ(a.assets->images, b.assets->images);
        EXPECT_NE(a.document, generateScene(a.kind, seed + 1000).document);
    }
}

TEST(Gallery, SeedsDifferInEverythingThatIsDrawn) {
    std::set<std::string> descriptions;
    std::set<LightKind> lights;
    std::set<SkyKind> skies;
    std::map<bool, int> glowing, textured, doubleSided;
    float smallest = 1e9f, largest = 0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const GeneratedScene made = generateScene(seed);
        const Scene scene = flatten(made.document, made.assets);
        descriptions.insert(made.description);
        for (const Light& light : scene.lights)
            lights.insert(light.kind);
        skies.insert(scene.sky.kind);
        bool glows = false;
        for (const Material& m : scene.materials) {
            glows |= m.emission != glm::vec3(0);
            ++textured[m.baseColorTexture.image >= 0];
            ++doubleSided[m.doubleSided];
            for (int c = 0; c < 3; ++c) {
                ASSERT_GE(m.baseColor[c], 0.05f - 1e-6f);
                ASSERT_LE(m.baseColor[c], 0.9f);
            }
        }
        ++glowing[glows];
        const float size = glm::length(scene.bounds.size());
        smallest = std::min(smallest, size);
        largest = std::max(largest, size);
    }
    EXPECT_GT(descriptions.size(), 120u);
    EXPECT_EQ(lights.size(), 4u);
    EXPECT_EQ(skies.size(), 2u);
    for (const auto* both : {&glowing, &textured, &doubleSided})
        for (const bool value : {false, true})
            EXPECT_GT(both->count(value) ? both->at(value) : 0, 10);
    EXPECT_LT(smallest, 0.3f);
    EXPECT_GT(largest, 1000.f);
}

TEST(RandomStream, IsSplitMix64) {
    // The first numbers of the published generator from the state 1234567.
    RandomStream stream(1234567);
    for (const std::uint64_t expected :
         {6457827717110365317U, 3203168211198807973U, 9817491932198370423U, 4593380528125082431U,
          16408922859458223821U})
        EXPECT_EQ(stream.bits(), expected);
}

TEST(Blocks, ARoomInASolidIsClosedOnBothSides) {
    Blocks blocks;
    blocks.fill({-1, -1, -1}, {4, 3, 5}, kSolid);
    blocks.fill({0, 0, 0}, {3, 2, 4}, kFirstRoom);
    Mesh mesh;
    blocks.build(0.7, [&](Facing) -> Mesh& { return mesh; });
    glm::dvec3 sum(0);
    double area = 0, volume = 0;
    std::map<std::tuple<float, float, float, float, float, float>, int> edges;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto corners = mesh.triangle(t);
        glm::dvec3 p[3];
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = glm::dvec3(mesh.positions[corners[k]]);
        const glm::dvec3 twice = glm::cross(p[1] - p[0], p[2] - p[0]);
        sum += twice;
        area += glm::length(twice) / 2;
        volume += glm::dot(p[0], twice) / 6;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 a(p[k]), b(p[(k + 1) % 3]);
            ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
            --edges[{b.x, b.y, b.z, a.x, a.y, a.z}];
        }
    }
    EXPECT_LT(glm::length(sum), 1e-9);
    EXPECT_NEAR(area, 2 * (5 * 4 + 4 * 6 + 6 * 5) + 2 * (3 * 2 + 2 * 4 + 4 * 3), 1e-6);
    EXPECT_NEAR(volume, 5 * 4 * 6 - 3 * 2 * 4, 1e-6); // outward, and inward in the room
    for (const auto& [edge, count] : edges)
        EXPECT_EQ(count, 0); // each edge once in either direction: closed, without T-junctions
}

TEST(Blocks, AnOpeningLeavesOutASheetAndNothingElse) {
    for (const bool open : {false, true}) {
        Blocks blocks;
        blocks.fill({0, 0, 0}, {3, 2, 4}, kFirstRoom);
        if (open)
            blocks.open({1, 0.5, -0.1}, {2, 1.5, 0.1});
        Mesh mesh;
        blocks.build(1e9, [&](Facing) -> Mesh& { return mesh; });
        double area = 0, volume = 0;
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
            const auto [a, b, c] = mesh.triangle(t);
            const glm::dvec3 p(mesh.positions[a]);
            const glm::dvec3 twice =
                glm::cross(glm::dvec3(mesh.positions[b]) - p, glm::dvec3(mesh.positions[c]) - p);
            area += glm::length(twice) / 2;
            volume += glm::dot(p, twice) / 6;
        }
        EXPECT_NEAR(area, 2 * (3 * 2 + 2 * 4 + 4 * 3) - (open ? 1 : 0), 1e-6);
        EXPECT_NEAR(volume, -3 * 2 * 4, 1e-6); // faces look in; the hole lies in the plane z = 0
    }
}

} // namespace limn::gallery_test
