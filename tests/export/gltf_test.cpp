// SPDX-License-Identifier: MIT
// What is exported as glTF is imported again as the same scene.
#include "engine/export/gltf_scene.h"

#include "engine/core/percent_encoding.h"
#include "engine/export/export_table.h"
#include "engine/export/lightmap_image.h"
#include "engine/field/sample_field.h"
#include "engine/files/image_file.h"
#include "engine/gltf/gltf_import.h"
#include "engine/lightmap/atlas.h"
#include "engine/math/sh.h"
#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "tests/core/temporary_folder.h"
#include "tests/export/exported_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace limn::gltf_test {
namespace {

class Gltf : public testing::Test {
protected:
    Gltf() {
        auto assets = std::make_shared<Assets>();
        Document d = roomDocument(*assets);
        room = std::make_unique<ExportedRoom>(std::move(d), assets);
    }
    /// Exports, writes and imports.
    ImportedScene reimported(ExportSettings settings = {}, const char* name = "room.gltf") {
        settings.quality = LightmapQuality::Draft; // the light of the field, without rays
        const ExportFormat& format = *findExportFormat("gltf");
        files = *format.write(room->view(), settings, name, {});
        const Result<void> written = writeExport(folder.file(name), format, files);
        EXPECT_TRUE(written) << written.error().message;
        Result<ImportedScene> read = importGltf(folder.file(name), {}, {.joinsBacks = false});
        EXPECT_TRUE(read) << read.error().message;
        EXPECT_TRUE(read->repairs.empty()) << read->repairs.front();
        return std::move(*read);
    }
    /// Compares the lights that are on by what they send to some points.
    void expectSameLights(const Scene& scene) const {
        ASSERT_EQ(scene.lights.size(), 4U);
        std::mt19937 random(3);
        std::uniform_real_distribution<float> component(-1, 1);
        for (const Light& light : scene.lights) {
            const auto same = std::ranges::find(room->scene.lights, light.name, &Light::name);
            ASSERT_NE(same, room->scene.lights.end());
            EXPECT_EQ(light.kind, same->kind);
            EXPECT_FLOAT_EQ(light.range, same->range);
            for (int i = 0; i < 200; ++i) {
                const glm::vec3 p = same->position + glm::vec3(component(random), component(random),
                                                               component(random));
                const glm::vec3 up(0, 1, 0);
                const auto arrives = [&](const Light& l) {
                    return l.kind == LightKind::Rectangle
                               ? l.color * l.strength *
                                     rectangleIrradiance(lightRectangle(l), p, up)
                               : sampleLight(l, p).irradiance;
                };
                const glm::vec3 expected = arrives(*same);
                EXPECT_LT(glm::distance(arrives(light), expected),
                          1e-3f * glm::length(expected) + 1e-5f)
                    << light.name << " " << i;
            }
        }
    }
    nlohmann::json json() const { return nlohmann::json::parse(files.front().bytes); }

    std::unique_ptr<ExportedRoom> room;
    TemporaryFolder folder;
    std::vector<ExportFile> files;
};

TEST_F(Gltf, IsImportedAgainWithTheSameLightsAndCameras) {
    const ImportedScene again = reimported();
    const Scene scene = flatten(again.document, again.assets);
    ASSERT_EQ(scene.cameras.size(), 1U);
    const Camera& camera = scene.cameras[0];
    EXPECT_LT(glm::distance(camera.eye, room->scene.cameras[0].eye), 1e-5f);
    EXPECT_FLOAT_EQ(camera.fovY, room->scene.cameras[0].fovY);
    EXPECT_GT(glm::dot(glm::normalize(camera.target - camera.eye),
                       glm::normalize(room->scene.cameras[0].target - camera.eye)),
              0.99999f);
    expectSameLights(scene);
}

/// Lights with profiles are read as one light, though those who know no profile find another.
TEST_F(Gltf, IsImportedAgainWithTheSameProfiles) {
    auto profile = std::make_shared<LightProfile>();
    *profile = {
        .name = "Lamp, \"half\"", .peak = 250, .lastVertical = 120, .rows = 5, .columns = 4};
    for (int i = 0; i < 20; ++i)
        profile->share.push_back(i == 7 ? 1.f : 0.04f * float(i));
    for (Light& light : room->scene.lights)
        if (light.kind == LightKind::Point || light.kind == LightKind::Spot) {
            light.profile = {profile};
            light.direction = glm::normalize(glm::vec3(0.4f, -1, 0.3f));
            light.roll = 0.6f;
        }
    const ImportedScene again = reimported();
    expectSameLights(flatten(again.document, again.assets));
    EXPECT_EQ(json()["extensions"]["EXT_lights_ies"]["lights"].size(), 1U);
    EXPECT_EQ(json()["extensions"]["KHR_lights_punctual"]["lights"].size(), 3U);
}

TEST_F(Gltf, IsOpenedAgainWithTheSameSidesOfSurfaces) {
    reimported();
    const Result<ImportedScene> again = importGltf(folder.file("room.gltf"));
    ASSERT_TRUE(again) << again.error().message;
    const Scene scene = flatten(again->document, again->assets);
    const auto areas = [](const Scene& s) {
        glm::dvec2 sum(0); // of one-sided and of two-sided surfaces
        for (const Instance& i : s.instances)
            sum[isTwoSided(s.materialOf(i)) ? 1 : 0] += worldArea(s, i);
        return sum;
    };
    const glm::dvec2 now = areas(scene), before = areas(room->scene);
    EXPECT_NEAR(now.x, before.x, 1e-4 * before.x);
    EXPECT_NEAR(now.y, before.y, 1e-4 * before.y);
    EXPECT_GT(before.y, 0);
}

TEST_F(Gltf, IsImportedAgainWithTheSameSurfaces) {
    const ImportedScene again = reimported();
    const Scene scene = flatten(again.document, again.assets);
    double area = 0, expected = 0, emitted = 0, expectedEmitted = 0;
    for (const Instance& i : scene.instances) {
        EXPECT_FALSE(isTwoSided(scene.materialOf(i))); // both sides are there
        area += worldArea(scene, i);
        emitted += worldArea(scene, i) * double(scene.materialOf(i).emission.y);
    }
    for (const Instance& i : room->scene.instances) {
        const Material& m = room->scene.materialOf(i);
        expected += worldArea(room->scene, i) * (isTwoSided(m) ? 2 : 1);
        expectedEmitted += worldArea(room->scene, i) * double(m.emission.y);
    }
    EXPECT_NEAR(area, expected, 1e-4 * expected);
    EXPECT_NEAR(emitted, expectedEmitted, 1e-4 * expectedEmitted);
    for (const Material& m : scene.materials)
        if (m.emission.y > 0) {
            EXPECT_FLOAT_EQ(m.metallic, 0.5f);
            EXPECT_FLOAT_EQ(m.roughness, 0.25f);
        }
}

TEST_F(Gltf, PackedFilesHoldAllButTheLightmap) {
    auto textured = std::make_shared<Assets>(*room->scene.assets);
    textured->images.push_back(
        {.name = "colours", .width = 2, .height = 1, .rgba = {9, 99, 199, 255, 1, 2, 3, 255}});
    room->scene.assets = textured;
    room->scene.materials[0].baseColorTexture.image = 0;
    const ImportedScene parts = reimported(), packed = reimported({}, "packed.glb");
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[0].name, "packed.glb");
    EXPECT_EQ(files[0].bytes.size() % 4, 0U);
    EXPECT_EQ(files[1].name, "packed-lightmap.exr");
    const Scene a = flatten(parts.document, parts.assets),
                b = flatten(packed.document, packed.assets);
    ASSERT_EQ(a.instances.size(), b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
        EXPECT_EQ(a.instances[i].toWorld, b.instances[i].toWorld);
        EXPECT_EQ(a.meshOf(a.instances[i]).positions, b.meshOf(b.instances[i]).positions);
        EXPECT_EQ(a.meshOf(a.instances[i]).indices, b.meshOf(b.instances[i]).indices);
        EXPECT_EQ(a.materialOf(a.instances[i]), b.materialOf(b.instances[i]));
    }
    EXPECT_EQ(a.lights, b.lights);
    EXPECT_GT(a.assets->images.size(), 0U);
    ASSERT_EQ(a.assets->images.size(), b.assets->images.size());
    for (std::size_t i = 0; i < a.assets->images.size(); ++i)
        EXPECT_EQ(a.assets->images[i].rgba, b.assets->images[i].rgba);
}

TEST_F(Gltf, GlassComesBackAsItWas) {
    Material& glass = room->scene.materials[1];
    glass.name = "glass";
    glass.transmission = 0.75f;
    glass.ior = 1.3f;
    glass.thickness = 0.02f;
    const ImportedScene again = reimported();
    const Scene scene = flatten(again.document, again.assets);
    std::size_t found = 0;
    for (const Material& m : scene.materials) {
        const bool isGlass = m.name == glass.name;
        found += isGlass ? 1 : 0;
        EXPECT_EQ(m.transmission, isGlass ? 0.75f : 0);
        EXPECT_EQ(m.ior, isGlass ? 1.3f : 1.5f);
        EXPECT_EQ(m.thickness, isGlass ? 0.02f : 0);
    }
    EXPECT_GT(found, 0U);
    const nlohmann::json used = json()["extensionsUsed"];
    for (const char* name :
         {"KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume"})
        EXPECT_EQ(std::ranges::count(used, name), 1) << name;
}

/// Bilinear lookup as a graphics card does it, row 0 at the top.
glm::vec3 lookup(const ImageF& image, glm::vec2 uv) {
    LightmapLayout texture;
    texture.width = image.width;
    texture.height = image.height;
    const Bilinear at = bilinearAt(texture, uv);
    glm::vec3 sum(0);
    for (int k = 0; k < 4; ++k)
        sum += image.rgb[at.texel[k]] * at.weight[k];
    return sum;
}

/// Irradiance that the bake holds at a point of the exported surface, found by the trace scene.
glm::vec3 bakedIrradiance(const ExportedRoom& room, glm::vec3 p, glm::vec3 n) {
    const Hit hit = room.trace.closestHit({p + n * 0.01f, -n, 0, 0.02f});
    if (!hit)
        return glm::vec3(-1);
    return sampleIrradiance({room.relighter.field(), room.baked->lightmap, room.scene, hit.instance,
                             hit.triangle, hit.u, hit.v, hit.position, n, !hit.frontFace});
}

/// Relative mean error of the light that the exported textures hold on the imported surfaces.
double errorOfLight(const ExportedRoom& room, const ImportedScene& imported,
                    const nlohmann::json& gltf, const std::vector<ImageF>& pages) {
    const Scene scene = flatten(imported.document, imported.assets);
    std::mt19937 rng(3);
    std::uniform_real_distribution<float> unit(0, 1);
    double error = 0, sum = 0;
    int points = 0;
    for (int k = 0; k < 4000; ++k) {
        const Instance& instance = scene.instances[rng() % scene.instances.size()];
        const Mesh& mesh = scene.meshOf(instance);
        EXPECT_EQ(mesh.uv1.size(), mesh.positions.size());
        const nlohmann::json& extras = gltf["materials"][instance.material]["extras"]["limn"];
        const ImageF& map = pages.at(extras.value("lightmapPage", std::size_t(0)));
        const std::size_t t = rng() % mesh.triangleCount();
        const float root = std::sqrt(unit(rng)), v = unit(rng) * root, u = 1 - root;
        const auto [a, b, c] = mesh.triangle(t);
        const glm::vec2 uv = mesh.uv1[a] * (1 - u - v) + mesh.uv1[b] * u + mesh.uv1[c] * v;
        const glm::vec3 p(instance.toWorld * glm::vec4(trianglePoint(mesh, t, {u, v}), 1));
        const glm::vec3 geometric =
            glm::normalize(instance.normalToWorld * triangleNormal(mesh, t));
        const glm::vec3 n = shadingNormal(mesh, instance, t, {u, v}, geometric);
        const glm::vec3 expected = bakedIrradiance(room, p, n);
        if (expected.x < 0)
            continue;
        error += double(glm::length(lookup(map, uv) - expected));
        sum += double(glm::length(expected));
        ++points;
    }
    EXPECT_GT(points, 3500);
    return error / sum;
}

TEST_F(Gltf, ItsLightmapHoldsTheLightOfItsSurfaces) {
    const ImportedScene again = reimported();
    const Result<ImageF> map = readFloatImage(folder.file("room-lightmap.exr"));
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_LT(errorOfLight(*room, again, json(), {*map}), 0.02);
}

TEST_F(Gltf, ALightmapAboveTheLimitIsDividedOverTextures) {
    const ImportedScene again = reimported({.maxSize = 64});
    const nlohmann::json lightmap = json()["asset"]["extras"]["limn"]["lightmap"];
    EXPECT_FALSE(lightmap.contains("uri"));
    ASSERT_GT(lightmap["uris"].size(), 1U);
    EXPECT_EQ(lightmap["uris"][1], "room-lightmap-2.exr");
    std::vector<ImageF> pages;
    for (const std::string name : lightmap["uris"]) {
        const Result<ImageF> map = readFloatImage(folder.file(name));
        ASSERT_TRUE(map) << map.error().message;
        EXPECT_LE(std::max(map->width, map->height), 64U);
        pages.push_back(*map);
    }
    EXPECT_LT(errorOfLight(*room, again, json(), pages), 0.02);
}

TEST_F(Gltf, AChartAboveTheLimitIsNamedByItsObject) {
    LightmapLayout layout = room->baked->lightmap;
    layout.width *= 100; // a hundred times as many texels
    layout.height *= 100;
    const ExportScene all = room->view();
    const ExportScene in{all.document, all.scene, all.trace, layout, all.field};
    const auto refused = exportPages(in, {.maxSize = 64});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("\"node 0"), std::string::npos)
        << refused.error().message;
}

TEST_F(Gltf, TexelsHoldTheQuantityAskedFor) {
    ExportSettings settings{.detail = 1};
    const auto texels = [&](LightmapQuantity quantity) {
        settings.quantity = quantity;
        reimported(settings);
        return readFloatImage(folder.file("room-lightmap.exr"))->rgb;
    };
    const std::vector<glm::vec3> e = texels(LightmapQuantity::Irradiance),
                                 overPi = texels(LightmapQuantity::IrradianceOverPi),
                                 radiance = texels(LightmapQuantity::Radiance);
    const float pi = std::numbers::pi_v<float>;
    std::size_t walls = 0;
    for (std::size_t t = 0; t < e.size(); ++t) {
        EXPECT_NEAR(overPi[t].x * pi, e[t].x, 1e-5f * e[t].x);
        EXPECT_LE(radiance[t].x, overPi[t].x * 0.7001f);
        walls += std::abs(radiance[t].x - 0.7f * overPi[t].x) < 1e-4f * overPi[t].x;
    }
    EXPECT_GT(walls, e.size() / 2);
}

TEST_F(Gltf, DirectLightIsAddedWhereAskedFor) {
    reimported({.detail = 1});
    const ImageF without = *readFloatImage(folder.file("room-lightmap.exr"));
    reimported({.direct = true, .detail = 1});
    const ImageF with = *readFloatImage(folder.file("room-lightmap.exr"));
    // The lights' direct irradiance, summed over texels of nearly equal area, is about that of the
    // surfels.
    double added = 0;
    for (std::size_t t = 0; t < with.rgb.size(); ++t) {
        EXPECT_GE(with.rgb[t].y, without.rgb[t].y * 0.9999f);
        added += double(with.rgb[t].y - without.rgb[t].y);
    }
    EXPECT_GT(added, 0);
}

TEST(DirectLightInALightmap, IsThatOfASunLimitedToTheBands) {
    Document d;
    addObject(d, simple::lambert(glm::vec3(0.5f)));
    Node node;
    node.meshes = {0};
    addObject(d, node);
    Light sun{.name = "sun", .kind = LightKind::Directional, .strength = 4};
    sun.direction = glm::normalize(glm::vec3(0.6f, -0.8f, 0));
    addObject(d, sun);
    BakeSettings bake;
    bake.surfels = 64;
    bake.lightmapCaches = 100;
    bake.rays = 16;
    addObject(d, bake);
    auto assets = std::make_shared<Assets>();
    assets->meshes = {simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})};
    const ExportedRoom floor(d, assets);
    // A_l (2 l + 1) / (4 pi) P_l(0.8) for l = 0, 1, 2
    const std::array<double, 3> bandsOfCosine = {0.25, 0.4, 0.3125 * (1.5 * 0.64 - 0.5)};
    double limited = bandsOfCosine[0];
    for (const std::uint32_t bands : {2U, 3U}) {
        limited += bandsOfCosine[bands - 1];
        const auto image =
            lightmapImage(floor.view(), {.direct = true, .bands = bands, .detail = 1}, {});
        ASSERT_TRUE(image) << image.error().message;
        ASSERT_EQ(image->layers, bands * bands);
        const std::size_t texels = std::size_t(image->width) * image->height;
        for (std::size_t t = 0; t < texels; ++t) {
            std::array<glm::vec3, 9> c{};
            for (std::size_t i = 0; i < image->layers; ++i)
                c[i] = image->rgb[i * texels + t];
            EXPECT_NEAR(shIrradiance(int(bands), c.data(), {0, 1, 0}).x, 4 * limited, 1e-4);
        }
    }
    const auto one = lightmapImage(floor.view(), {.direct = true, .detail = 1}, {});
    ASSERT_TRUE(one);
    EXPECT_NEAR(one->rgb.front().x, 4 * 0.8, 1e-4);
}

TEST_F(Gltf, KeepsTheRulesOfTheFormat) {
    reimported();
    const nlohmann::json j = json();
    EXPECT_EQ(j["asset"]["version"], "2.0");
    for (const auto& view : j["bufferViews"])
        EXPECT_EQ(view["byteOffset"].get<int>() % 4, 0);
    EXPECT_EQ(j["buffers"][0]["byteLength"], files[1].bytes.size());
    for (const auto& mesh : j["meshes"])
        for (const auto& primitive : mesh["primitives"]) {
            const auto& attributes = primitive["attributes"];
            const auto& position = j["accessors"][attributes["POSITION"].get<std::size_t>()];
            EXPECT_EQ(position["min"].size(), 3U);
            EXPECT_EQ(position["max"].size(), 3U);
            for (const auto& [name, accessor] : attributes.items())
                EXPECT_EQ(j["accessors"][accessor.get<std::size_t>()]["count"], position["count"])
                    << name;
        }
    for (const char* extension : {"KHR_lights_punctual", "KHR_materials_emissive_strength"})
        EXPECT_NE(std::ranges::find(j["extensionsUsed"], extension), j["extensionsUsed"].end());
    EXPECT_EQ(j["asset"]["extras"]["limn"]["lightmap"]["uri"], "room-lightmap.exr");
}

TEST_F(Gltf, LowersTheDetailUntilTheLightmapFitsItsLimit) {
    LightmapLayout layout;
    layout.width = 1000;
    layout.height = 1500;
    EXPECT_EQ(*lightmapDetail(layout, {.detail = 5, .maxSize = 8192}), 5U);
    EXPECT_EQ(*lightmapDetail(layout, {.detail = 9, .maxSize = 8192}), 5U);
    EXPECT_EQ(*lightmapDetail(layout, {.detail = 9, .maxSize = 1500}), 1U);
    EXPECT_FALSE(lightmapDetail(layout, {.detail = 9, .maxSize = 1499}));
}

TEST_F(Gltf, EscapesNamesOfFiles) {
    EXPECT_EQ(percentEncoded("a room #1.bin"), "a%20room%20%231.bin");
    EXPECT_EQ(percentEncoded("z\xc3\xbcrich.bin"), "z%C3%BCrich.bin");
}

TEST_F(Gltf, IsTheSameEveryTime) {
    const ExportFormat& format = *findExportFormat("gltf");
    const auto first = *format.write(room->view(), {}, "a.gltf", {}),
               second = *format.write(room->view(), {}, "a.gltf", {});
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t k = 0; k < first.size(); ++k)
        EXPECT_EQ(first[k].bytes, second[k].bytes) << first[k].name;
}

TEST_F(Gltf, SaysWhatItCannotHold) {
    const ExportFormat& format = *findExportFormat("gltf");
    const auto messageOf = [&](const ExportSettings& settings) {
        const auto written = format.write(room->view(), settings, "a.gltf", {});
        return written ? std::string() : written.error().message;
    };
    EXPECT_NE(messageOf({.detail = 2}).find("odd"), std::string::npos);
    EXPECT_NE(messageOf({.quality = LightmapQuality::Draft, .maxSize = 8}).find("--max-size"),
              std::string::npos);
    std::atomic<bool> cancel = true;
    EXPECT_FALSE(format.write(room->view(), {}, "a.gltf", {.report = {}, .cancel = &cancel}));
}

} // namespace
} // namespace limn::gltf_test
