// SPDX-License-Identifier: MIT
#include "engine/export/baked_light.h"

#include "engine/export/engine_formats.h"
#include "engine/export/export_table.h"
#include "engine/export/exported_lightmap.h"
#include "engine/export/lightmap_error.h"
#include "engine/field/sample_field.h"
#include "engine/gltf/gltf_import.h"
#include "engine/picture/field_lobe.h"
#include "tests/core/temporary_folder.h"
#include "tests/export/exported_room.h"
#include "tests/export/known_light.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include <nlohmann/json.hpp>

namespace limn::baked_light_test {
namespace {

std::array<glm::vec3, 9> constantLight(glm::vec3) {
    return KnownLight::probe(0);
}

/// Irradiance in the middle of the first triangle of the scene's quad.
glm::vec3 irradianceOf(const BakedLight& light, const Scene& scene, std::uint32_t instance) {
    constexpr float kThird = 1 / 3.f;
    return sampleIrradiance({light.field, light.layout, scene, instance, 0, kThird, kThird,
                             glm::vec3(0), glm::vec3(0, 0, 1)});
}

/// Writes the known light, imports it and reads its lightmap.
struct Exported {
    TemporaryFolder folder;
    ImportedScene imported;
    Scene scene;

    explicit Exported(ExportSettings settings, const char* name = "room.gltf") {
        settings.quality = LightmapQuality::Draft;
        settings.detail = 1;
        const KnownLight light(constantLight);
        const ExportFormat& format = *findExportFormat("gltf");
        const auto files = format.write(light.view(), settings, name, {});
        EXPECT_TRUE(files) << files.error().message;
        EXPECT_TRUE(writeExport(folder.file(name), format, *files));
        imported = *importGltf(folder.file(name));
        scene = flatten(imported.document, imported.assets);
        path = folder.file(name);
    }
    Result<BakedLight> light() { return readBakedLight(path, scene, {}); }
    std::uint32_t quad() const {
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (!scene.meshOf(scene.instances[i]).uv1.empty())
                return i;
        ADD_FAILURE() << "no instance has TEXCOORD_1";
        return 0;
    }
    std::string path;
};

TEST(BakedLight, HasTheIrradianceOfTheTexels) {
    for (const LightmapQuantity quantity :
         {LightmapQuantity::Irradiance, LightmapQuantity::IrradianceOverPi})
        for (const char* name : {"room.gltf", "room.glb"}) {
            Exported room({.quantity = quantity}, name);
            const Result<BakedLight> light = room.light();
            ASSERT_TRUE(light) << light.error().message;
            EXPECT_FALSE(light->hasDirectLight);
            // The triangle's corners are those of texels (0, 7), (7, 7) and (7, 0).
            const glm::vec3 e = irradianceOf(*light, room.scene, room.quad()),
                            known = KnownLight::quadIrradiance(14 / 3.f, 14 / 3.f);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(e[c], known[c], 1e-4f) << name;
        }
}

TEST(BakedLight, ReadsHarmonics) {
    Exported room({.encoding = TextureEncoding::Ktx2Half, .bands = 3});
    const Result<BakedLight> light = room.light();
    ASSERT_TRUE(light) << light.error().message;
    const glm::vec3 e = irradianceOf(*light, room.scene, room.quad()),
                    known = KnownLight::quadIrradiance(14 / 3.f, 14 / 3.f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(e[c], known[c], 5e-3f);
}

TEST(BakedLight, KnowsWhetherDirectLightIsInIt) {
    EXPECT_TRUE(Exported({.direct = true}).light()->hasDirectLight);
}

TEST(BakedLight, SaysWhatIsWrong) {
    const auto messageWith = [](const std::string& what, const std::string& with) {
        Exported room({});
        std::stringstream text;
        text << std::ifstream(room.path).rdbuf();
        std::string json = text.str();
        const std::size_t place = json.find(what);
        EXPECT_NE(place, std::string::npos) << what;
        json.replace(place, what.size(), with);
        std::ofstream(room.path) << json;
        const Result<BakedLight> light = room.light();
        return light ? std::string() : light.error().message;
    };
    EXPECT_NE(messageWith("\"lightmap\"", "\"lightless\"").find("lightmap: is missing"),
              std::string::npos);
    EXPECT_NE(messageWith("\"irradiance\"", "\"joy\"").find("quantity"), std::string::npos);
    EXPECT_NE(messageWith("room-lightmap.exr", "absent.exr").find("absent.exr"), std::string::npos);
    EXPECT_NE(messageWith("\"room-lightmap.exr\"", "\"../out.exr\"").find("lightmap.uri"),
              std::string::npos);
    EXPECT_NE(messageWith("\"room-lightmap.exr\"", "3").find("uri"), std::string::npos);
}

TEST(BakedLight, SaysWhatIsWrongWithSeveralTextures) {
    const auto messageWith = [](const nlohmann::json& uris, const nlohmann::json& page) {
        Exported room({});
        nlohmann::json json;
        std::ifstream(room.path) >> json;
        nlohmann::json& lightmap = json["asset"]["extras"]["limn"]["lightmap"];
        lightmap.erase("uri");
        lightmap["uris"] = uris;
        json["materials"][0]["extras"]["limn"]["lightmapPage"] = page;
        std::ofstream(room.path) << json;
        const Result<BakedLight> light = room.light();
        return light ? std::string() : light.error().message;
    };
    const nlohmann::json name = "room-lightmap.exr", two = {name, name};
    EXPECT_EQ(messageWith(two, 1), "");
    for (const nlohmann::json& uris : {nlohmann::json(7), nlohmann::json::array()})
        EXPECT_NE(messageWith(uris, 0).find("lightmap.uris: is not"), std::string::npos);
    EXPECT_NE(messageWith({name, 7}, 0).find("uris[1]: is missing"), std::string::npos);
    for (const nlohmann::json& page : {nlohmann::json(2), nlohmann::json(-1), nlohmann::json("0")})
        EXPECT_NE(messageWith(two, page).find("materials[0].extras.limn.lightmapPage"),
                  std::string::npos);
}

/// The room's draft with textures of at most `maxSize` texels a side, imported again.
struct ReadRoom {
    ImportedScene imported;
    Scene scene;
    BakedLight light;

    ReadRoom(const ExportedRoom& room, ExportSettings settings, const TemporaryFolder& folder,
             const std::string& name) {
        const std::string path = folder.file(name);
        settings.quality = LightmapQuality::Draft;
        const ExportFormat& format = *findExportFormat("gltf");
        const auto files = format.write(room.view(), settings, name, {});
        EXPECT_TRUE(files && writeExport(path, format, *files));
        imported = *importGltf(path);
        scene = flatten(imported.document, imported.assets);
        const Result<BakedLight> read = readBakedLight(path, scene, {});
        EXPECT_TRUE(read) << read.error().message;
        light = *read;
    }
    glm::vec3 irradiance(const Hit& hit, glm::vec3 n) const {
        return sampleIrradiance({light.field, light.layout, scene, hit.instance, hit.triangle,
                                 hit.u, hit.v, hit.position, n});
    }
};

TEST(BakedLight, ADividedLightmapShowsWhatAWholeOneDoes) {
    auto assets = std::make_shared<Assets>();
    Document document = roomDocument(*assets);
    const ExportedRoom room(std::move(document), assets);
    const TemporaryFolder folder;
    for (const std::uint32_t bands : {1U, 2U}) {
        const ExportSettings settings{.encoding = bands > 1 ? TextureEncoding::Ktx2Half
                                                            : TextureEncoding::Exr,
                                      .bands = bands};
        ExportSettings divided = settings;
        divided.maxSize = 64;
        const ReadRoom whole(room, settings, folder, "whole.gltf"),
            pages(room, divided, folder, "pages.gltf");
        EXPECT_LE(pages.light.layout.width, divided.maxSize);
        EXPECT_GT(pages.light.layout.height, divided.maxSize); // several textures
        const TraceScene traceWhole(whole.scene), tracePages(pages.scene);
        std::mt19937 rng(5);
        std::normal_distribution<float> normal;
        std::size_t compared = 0;
        for (int k = 0; k < 2000; ++k) {
            const glm::vec3 d = glm::normalize(glm::vec3(normal(rng), normal(rng), normal(rng)));
            const Ray ray{{2, 2, 2.5f}, d, 0, 100};
            const Hit a = traceWhole.closestHit(ray), b = tracePages.closestHit(ray);
            ASSERT_EQ(bool(a), bool(b));
            if (!a || !a.frontFace || glm::distance(a.position, b.position) > 1e-4f)
                continue;
            const glm::vec3 one = whole.irradiance(a, -d), other = pages.irradiance(b, -d);
            ++compared;
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(one[c], other[c], 2e-3f * (1 + one[c])) << bands;
        }
        EXPECT_GT(compared, 1900U);
    }
}

/// Exports write the sides of a surface as two surfaces in the same place. A ray meets either.
TEST(BakedLight, ShowsEachSideOfASurfaceByItsOwnTexels) {
    KnownLight known(constantLight);
    known.scene.materials[0].doubleSided = true;
    known.scene.instances.resize(1); // the quad alone, in the light of the sun alone
    known.setLightmap({});
    Light sun{.kind = LightKind::Directional, .strength = 3};
    sun.direction = {0, 0, -1};
    known.scene.lights = {sun};
    const TraceScene whole(known.scene);
    const ExportScene in{known.document, known.scene, whole, known.layout, known.field};
    const ExportFormat& format = *findExportFormat("gltf");
    const TemporaryFolder folder;
    const std::string path = folder.file("sides.gltf");
    const auto files =
        format.write(in, {.texels = 100, .paths = 0, .direct = true}, "sides.gltf", {});
    ASSERT_TRUE(files && writeExport(path, format, *files));
    const ImportedScene imported = *importGltf(path);
    Scene scene = flatten(imported.document, imported.assets);
    EXPECT_EQ(scene.instances.size(), 2U);
    const Result<BakedLight> light = readBakedLight(path, scene, {});
    ASSERT_TRUE(light) << light.error().message;
    EXPECT_EQ(scene.instances.size(), 1U);
    const TraceScene trace(scene);
    const auto shown = [&](float z) {
        const Hit hit = trace.closestHit({{0.9f, 0.9f, z}, {0, 0, z > 0 ? -1 : 1}});
        return sampleIrradiance(
                   fieldPoint(light->field, light->layout, scene, hit, *surfacePoint(trace, hit)))
            .x;
    };
    EXPECT_NEAR(shown(2), 3, 1e-3f);
    EXPECT_NEAR(shown(-2), 0, 1e-3f);
}

/// A quad that faces the camera, under an even sky of radiance 1: its irradiance is pi. Every texel
/// holds the same.
Comparison errorOfMap(float irradiance) {
    KnownLight light(constantLight);
    light.scene.sky.radiance = glm::vec3(1);
    light.scene.instances.resize(1);
    const TraceScene trace(light.scene);
    const ExportScene in{light.document, light.scene, trace, light.layout, light.field};
    WrittenLightmap map;
    map.pages = onePage(light.scene, light.layout, 1);
    const std::vector<LightmapImage> images = {
        {KnownLight::kTexels, KnownLight::kTexels, 1,
         std::vector<glm::vec3>(std::size_t(KnownLight::kTexels) * KnownLight::kTexels,
                                glm::vec3(irradiance))}};
    LightmapErrorOptions options{.camera = light.scene.cameras.front()};
    options.width = options.height = 16;
    options.paths = 64;
    return *lightmapError(in, map, images, {}, options, {});
}

TEST(ExportedLightmap, HasTheDensityThatIsAskedFor) {
    const KnownLight light(constantLight); // its quad is 2 m wide
    for (const float perMetre : {5.f, 20.f}) {
        const Result<ExportedLightmap> map =
            exportedLightmap(light.view(), {.texelsPerMetre = perMetre}, PageCount::Any, {});
        ASSERT_TRUE(map) << map.error().message;
        EXPECT_NEAR(float(map->pages.width), 2 * perMetre, 2);
        EXPECT_NEAR(float(map->pages.height), 2 * perMetre, 2);
        const ExportForecast forecast =
            forecastLightmapOf(light.view(), {.texelsPerMetre = perMetre}, PageCount::Any);
        EXPECT_NEAR(float(forecast.width), 2 * perMetre, 0.1f * 2 * perMetre + 1);
    }
    const auto refused =
        exportedLightmap(light.view(), {.texelsPerMetre = 3000}, PageCount::Any, {});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("--lightmap-texels-per-metre"), std::string::npos);
}

TEST(LightmapError, IsThatOfTheTexels) {
    const float pi = std::numbers::pi_v<float>;
    EXPECT_NEAR(errorOfMap(pi).nrmse, 0, 1e-3);
    const Comparison brighter = errorOfMap(1.1f * pi);
    EXPECT_NEAR(brighter.nrmse, 0.1, 1e-3);
    EXPECT_NEAR(brighter.bias, 0.1, 1e-3);
}

TEST(ExportedSeams, AreTheJumpsBetweenTheTexelsOfCharts) {
    KnownLight light(constantLight); // its quad's triangles as charts of their own, on two pages
    light.scene.instances.resize(1);
    light.layout.meshes[0] = {.sourceVertex = {0, 1, 2, 0, 2, 3},
                              .indices = {0, 1, 2, 3, 4, 5},
                              .chartOfTriangle = {0, 1},
                              .chartUv = {},
                              .chartSize = {}};
    WrittenLightmap map;
    LightmapPages& pages = map.pages;
    pages.count = 2;
    pages.width = 2;
    pages.height = 1;
    pages.instances.resize(1);
    pages.instances[0][0] = {std::vector<glm::vec2>(6, {0.5f, 0.5f}), {0, 1}};
    light.layout.instances[0].uv = pages.instances[0][0].uv;
    const auto page = [](float left, float right) {
        return LightmapImage{2, 1, 1, {glm::vec3(left), glm::vec3(right)}};
    };
    const SeamError seams = exportedSeams(light.view(), map, {page(1, 2), page(1, 4)});
    EXPECT_NEAR(seams.length, 2 * std::sqrt(2.), 1e-5);
    EXPECT_NEAR(seams.jump, 1, 1e-5); // of 1.5 and 2.5
    EXPECT_NEAR(seams.irradiance, 2, 1e-5);
}

} // namespace
} // namespace limn::baked_light_test
