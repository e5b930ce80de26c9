// SPDX-License-Identifier: MIT
// Panoramas of the sky and of reflections against skies and rooms that are known.
#include "engine/export/surroundings.h"

#include "engine/export/export_table.h"
#include "engine/export/panorama.h"
#include "engine/export/reflection_places.h"
#include "engine/files/ktx2.h"
#include "tests/export/known_light.h"
#include "tests/trace/simple_scene.h"

#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace limn::surroundings_test {
namespace {

std::array<glm::vec3, 9> constantLight(glm::vec3) {
    return KnownLight::probe(0);
}

TEST(Panorama, ItsMiddleFacesXAndItsLeftQuarterMinusZ) {
    constexpr std::uint32_t kWidth = 8, kHeight = 4;
    const auto direction = [](std::size_t row, std::size_t column) {
        return panoramaDirection(kWidth, kHeight, row * kWidth + column);
    };
    const glm::vec3 middle =
        glm::normalize(direction(1, 3) + direction(1, 4) + direction(2, 3) + direction(2, 4));
    EXPECT_LT(glm::distance(middle, glm::vec3(1, 0, 0)), 1e-6f);
    const glm::vec3 left =
        glm::normalize(direction(1, 1) + direction(1, 2) + direction(2, 1) + direction(2, 2));
    EXPECT_LT(glm::distance(left, glm::vec3(0, 0, -1)), 1e-6f);
    EXPECT_GT(direction(0, 0).y, 0.9f);
}

TEST(Panorama, OfABlackSkyHasNoPixels) {
    EXPECT_TRUE(skyPanorama({}).rgb.empty());
    EXPECT_TRUE(skyPanorama({.kind = SkyKind::Gradient}).rgb.empty());
}

TEST(Panorama, ShowsAGradient) {
    const Sky sky{.kind = SkyKind::Gradient,
                  .radiance = glm::vec3(3, 2, 1),
                  .horizon = glm::vec3(1),
                  .ground = glm::vec3(0.5f, 0.25f, 0)};
    const ImageF image = skyPanorama(sky);
    ASSERT_FALSE(image.rgb.empty());
    for (std::size_t k = 0; k < image.rgb.size(); ++k) {
        const float y = panoramaDirection(image.width, image.height, k).y;
        const glm::vec3 expected =
            y > 0 ? glm::mix(sky.horizon, sky.radiance, y) : glm::mix(sky.horizon, sky.ground, -y);
        EXPECT_LT(glm::distance(image.rgb[k], expected), 1e-5f);
    }
}

TEST(Panorama, OfAnImageIsItsMeanWhereItIsSmaller) {
    ImageF pixels{4096, 2048, {}};
    pixels.rgb.resize(std::size_t(4096) * 2048);
    for (std::size_t k = 0; k < pixels.rgb.size(); ++k) // stripes that pixels of the panorama cross
        pixels.rgb[k] = glm::vec3(k % 2 == 0 ? 0.f : 2.f);
    Sky sky{.kind = SkyKind::Image, .image = "stripes.exr"};
    sky.panorama = makeSkyImage(std::move(pixels));
    const ImageF image = skyPanorama(sky);
    ASSERT_EQ(image.width, 1024U);
    double sum = 0;
    for (const glm::vec3& v : image.rgb)
        sum += v.x;
    EXPECT_NEAR(sum / double(image.rgb.size()), 1, 0.01);
}

/// Two closed rooms of one material, side by side along x, with a ball in each.
Scene twoRooms(Document& document) {
    auto assets = std::make_shared<Assets>();
    assets->meshes = {simple::box({0, 0, 0}, {4, 3, 4}, true, 0),
                      simple::box({5, 0, 0}, {8, 3, 4}, true, 0),
                      simple::sphere(0.4f, 2, false, 0)};
    addObject(document, simple::lambert(glm::vec3(0.5f)));
    for (const auto& [mesh, x] :
         {std::pair<std::uint32_t, double>(0, 0), {1, 0}, {2, 2}, {2, 6.5}}) {
        Node node;
        node.meshes = {mesh};
        if (mesh == 2)
            node.transform.translation = glm::dvec3(x, 1.5, 2);
        addObject(document, node);
    }
    return flatten(document, assets);
}

TEST(ReflectionPlaces, SeeEachRoomAndBelongToWhatStandsThere) {
    KnownLight light(constantLight);
    Document document;
    const Scene scene = twoRooms(document);
    const TraceScene trace(scene);
    const LightmapLayout layout = layoutWithoutLightmap(scene);
    const ReflectionPlaces found =
        reflectionPlaces({document, scene, trace, layout, light.field}, 2);
    ASSERT_EQ(found.places.size(), 2U);
    const auto isLeft = [](glm::vec3 p) { return p.x < 4.5f; };
    EXPECT_NE(isLeft(found.places[0]), isLeft(found.places[1]));
    for (const glm::vec3& p : found.places)
        for (const glm::vec3 ball : {glm::vec3(2, 1.5f, 2), glm::vec3(6.5f, 1.5f, 2)})
            EXPECT_GT(glm::distance(p, ball), 0.4f);
    ASSERT_EQ(found.ofInstance.size(), 4U);
    for (const auto& [instance, left] : {std::pair(0U, true), {1U, false}, {2U, true}, {3U, false}})
        EXPECT_EQ(isLeft(found.places[found.ofInstance[instance]]), left) << instance;
}

TEST(ReflectionPlaces, OfOneRoomAreFew) {
    KnownLight light(constantLight);
    Document document;
    auto assets = std::make_shared<Assets>();
    assets->meshes = {simple::box({0, 0, 0}, {4, 3, 4}, true, 0)};
    addObject(document, simple::lambert(glm::vec3(0.5f)));
    Node node;
    node.meshes = {0};
    addObject(document, node);
    const Scene scene = flatten(document, assets);
    const TraceScene trace(scene);
    const LightmapLayout layout = layoutWithoutLightmap(scene);
    const auto places = reflectionPlaces({document, scene, trace, layout, light.field}, 1).places;
    ASSERT_EQ(places.size(), 1U);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GT(places[0][axis], 0);
        EXPECT_LT(places[0][axis], scene.bounds.upper[axis]);
    }
}

TEST(Surroundings, AreNamedInTheFileThatEnginesLoad) {
    KnownLight light(constantLight);
    light.scene.sky.radiance = glm::vec3(1, 2, 1e6f);
    for (const char* name : {"three", "babylon", "playcanvas"}) {
        const auto files = findExportFormat(name)->write(light.view(), {}, "room.gltf", {});
        ASSERT_TRUE(files) << name;
        const auto limn = nlohmann::json::parse(files->front().bytes)["asset"]["extras"]["limn"];
        const auto texels = [&](const std::string& uri) {
            for (const ExportFile& file : *files)
                if (file.name == uri)
                    return decodeKtx2({reinterpret_cast<const std::uint8_t*>(file.bytes.data()),
                                       file.bytes.size()})
                        ->texels;
            ADD_FAILURE() << uri << " is missing";
            return std::vector<glm::vec4>(1);
        };
        EXPECT_EQ(texels(limn["sky"]["uri"])[0],
                  glm::vec4(1, 2, 65504, 1)); // what half floats hold
        ASSERT_FALSE(limn["reflections"].empty());
        for (const auto& reflection : limn["reflections"])
            EXPECT_EQ(texels(reflection["uri"]).size(), 256U * 128);
    }
}

TEST(Surroundings, WithoutASkyAreReflectionsAlone) {
    const KnownLight light(constantLight);
    const auto around = surroundings(light.view(), 0, TextureEncoding::Exr, "room", {});
    ASSERT_TRUE(around);
    EXPECT_TRUE(around->files.empty());
    EXPECT_TRUE(around->json.empty());
}

} // namespace
} // namespace limn::surroundings_test
