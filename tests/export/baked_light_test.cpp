// SPDX-License-Identifier: MIT
#include "engine/export/baked_light.h"

#include "engine/export/engine_formats.h"
#include "engine/export/export_table.h"
#include "engine/export/lightmap_error.h"
#include "engine/field/sample_field.h"
#include "engine/gltf/gltf_import.h"
#include "tests/core/temporary_folder.h"
#include "tests/export/known_light.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

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
    Result<BakedLight> light() const { return readBakedLight(path, scene, {}); }
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
            const Exported room({.quantity = quantity}, name);
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
    const Exported room({.encoding = TextureEncoding::Ktx2Half, .bands = 3});
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
        const Exported room({});
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

/// A quad that faces the camera, under an even sky of radiance 1: its irradiance is pi. Every texel
/// holds the same.
Comparison errorOfMap(float irradiance) {
    KnownLight light(constantLight);
    light.scene.sky.radiance = glm::vec3(1);
    light.scene.instances.resize(1);
    const TraceScene trace(light.scene);
    const ExportScene in{light.document, light.scene, trace, light.layout, light.field};
    const LightmapPages pages = onePage(light.scene, light.layout, 1);
    const std::vector<LightmapImage> images = {
        {KnownLight::kTexels, KnownLight::kTexels, 1,
         std::vector<glm::vec3>(std::size_t(KnownLight::kTexels) * KnownLight::kTexels,
                                glm::vec3(irradiance))}};
    LightmapErrorOptions options{.camera = light.scene.cameras.front()};
    options.width = options.height = 16;
    options.paths = 64;
    return *lightmapError(in, pages, images, {}, options, {});
}

TEST(LightmapError, IsThatOfTheTexels) {
    const float pi = std::numbers::pi_v<float>;
    EXPECT_NEAR(errorOfMap(pi).nrmse, 0, 1e-3);
    const Comparison brighter = errorOfMap(1.1f * pi);
    EXPECT_NEAR(brighter.nrmse, 0.1, 1e-3);
    EXPECT_NEAR(brighter.bias, 0.1, 1e-3);
}

} // namespace
} // namespace limn::baked_light_test
