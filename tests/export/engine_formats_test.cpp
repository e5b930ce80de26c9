// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/export/export_table.h"
#include "engine/export/lightmap_image.h"
#include "engine/export/sh_conventions.h"
#include "engine/files/ktx2.h"
#include "engine/math/sh.h"
#include "tests/core/temporary_folder.h"
#include "tests/export/gltf_rules.h"
#include "tests/export/known_light.h"
#include "tests/field/second_grid.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

namespace limn::engine_formats_test {
namespace {

using Json = nlohmann::json;

std::array<glm::vec3, 9> constantLight(glm::vec3) {
    return KnownLight::probe(0);
}

/// A different number for every cell, coefficient and channel.
std::array<glm::vec3, 9> distinctLight(glm::vec3 p) {
    std::array<glm::vec3, 9> c;
    for (int i = 0; i < 9; ++i)
        c[std::size_t(i)] = float(i) + glm::vec3(0, 0.25f, 0.5f) + p * 0.125f;
    return c;
}

std::string nameFor(const ExportFormat& format) {
    return format.extensions.empty() ? "room" : "room" + std::string(format.extensions.front());
}

std::vector<ExportFile> exported(const KnownLight& light, const ExportFormat& format,
                                 ExportSettings settings = {}) {
    settings.quality = LightmapQuality::Draft; // the light that the field has
    auto files = format.write(light.view(), settings, nameFor(format), {});
    EXPECT_TRUE(files) << format.name << ": " << files.error().message;
    return files ? *files : std::vector<ExportFile>{{"", ""}};
}

const std::string& bytesOf(const std::vector<ExportFile>& files, const std::string& name) {
    for (const ExportFile& file : files)
        if (file.name == name)
            return file.bytes;
    ADD_FAILURE() << name << " is missing";
    return files.front().bytes;
}

std::span<const std::uint8_t> span(const std::string& bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

} // namespace

TEST(EngineFormats, EveryFormatWritesTheSameBytesTwiceUnderNamesOfOneStem) {
    const KnownLight light(distinctLight);
    for (const ExportFormat* format : formatsOfLight()) {
        const auto once = exported(light, *format), twice = exported(light, *format);
        ASSERT_EQ(once.size(), twice.size());
        EXPECT_EQ(once.front().name, nameFor(*format));
        for (std::size_t i = 0; i < once.size(); ++i) {
            EXPECT_EQ(once[i].name, twice[i].name);
            EXPECT_EQ(once[i].bytes, twice[i].bytes) << once[i].name;
            EXPECT_TRUE(once[i].name.starts_with("room")) << once[i].name;
            EXPECT_FALSE(once[i].bytes.empty()) << once[i].name;
        }
    }
}

TEST(EngineFormats, APartThatNoFormatHoldsIsRefusedByName) {
    const TemporaryFolder folder;
    KnownLight light(constantLight);
    light.field.parts = {std::make_shared<SecondGrid>(light.field)};
    for (const ExportFormat* format : exportFormats()) {
        const auto files =
            exportLight(folder.file(nameFor(*format)), *format, light.view(), {}, {});
        ASSERT_FALSE(files) << format->name;
        EXPECT_NE(files.error().message.find("second grid"), std::string::npos)
            << files.error().message;
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST(EngineFormats, EveryGltfFileKeepsTheRules) {
    const KnownLight light(distinctLight);
    int checked = 0;
    for (const ExportFormat* format : formatsOfLight()) {
        const auto files = exported(light, *format);
        for (const ExportFile& file : files)
            if (file.name.ends_with(".gltf")) {
                ++checked;
                for (const std::string& problem : GltfRules::problems(files, file.name))
                    ADD_FAILURE() << format->name << ", " << file.name << ": " << problem;
            }
    }
    EXPECT_GE(checked, 8);
}

TEST(EngineFormats, FilesNamedInsideAFileAreExported) {
    const KnownLight light(distinctLight);
    for (const ExportFormat* format :
         {&kThreeFormat, &kBabylonFormat, &kPlaycanvasFormat, &kBlenderFormat}) {
        const auto files = exported(light, *format);
        const Json limn = Json::parse(files.front().bytes)["asset"]["extras"]["limn"];
        bytesOf(files, limn["lightmap"]["uri"]);
        if (limn.contains("grid"))
            bytesOf(files, Json::parse(bytesOf(files, limn["grid"]["uri"]))["texture"]);
    }
}

TEST(EngineFormats, LoadersNameTheExport) {
    const KnownLight light(constantLight);
    const auto files = exported(light, kThreeFormat);
    const std::string& loader = bytesOf(files, "room-three.js");
    EXPECT_NE(loader.find("room.gltf"), std::string::npos);
    EXPECT_EQ(loader.find("ROOM"), std::string::npos);
}

TEST(EngineFormats, LightmapsHoldTheQuantityOfTheirEngine) {
    const KnownLight light(constantLight);
    const float pi = std::numbers::pi_v<float>;
    for (const auto& [format, factor] : {std::pair(&kBabylonFormat, KnownLight::kAlbedo / pi),
                                         std::pair(&kPlaycanvasFormat, 1 / pi)}) {
        ExportSettings settings;
        settings.quantity = LightmapQuantity::Radiance; // PlayCanvas knows no other than its own
        settings.detail = 1;
        const auto files = exported(light, *format, settings);
        const auto texture = decodeKtx2(span(bytesOf(files, "room-lightmap.ktx2")));
        ASSERT_TRUE(texture) << texture.error().message;
        for (std::uint32_t y = 0; y < 8; ++y)
            for (std::uint32_t x = 0; x < 8; ++x) {
                const glm::vec3 e = factor * KnownLight::quadIrradiance(float(x), float(y));
                const glm::vec4 t = texture->texels[y * 8 + x];
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(t[c], e[c], 1e-3f * e[c] + 1e-6f) << format->name;
            }
    }
}

TEST(EngineFormats, TwoBandsHaveTheIrradianceOfThreeAtTheSurfacesNormal) {
    KnownLight light(constantLight);
    const std::array<glm::vec3, 9> all = KnownLight::probe(6); // 3 z^2 - 1, along the quad's normal
    light.setLightmap(all);
    const auto image = lightmapImage(light.view(), {.bands = 2, .detail = 1}, {});
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->layers, 4U);
    const std::size_t texels = std::size_t(image->width) * image->height;
    const glm::vec3 n(0, 0, 1);
    for (std::size_t t = 0; t < texels; ++t) {
        std::array<glm::vec3, 4> two;
        for (std::size_t i = 0; i < 4; ++i)
            two[i] = image->rgb[i * texels + t];
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(shIrradiance(2, two.data(), n)[c], shIrradiance(3, all.data(), n)[c], 1e-5);
        for (std::size_t i = 1; i < 4; ++i)
            EXPECT_EQ(two[i], all[i]); // the change with the normal stays
    }
}

TEST(EngineFormats, TheGridsTextureIsLaidOutAsItsDescriptionSays) {
    const KnownLight light(distinctLight);
    const auto files = exported(light, kGridFormat, {.compress = true});
    const Json json = Json::parse(files.front().bytes);
    const auto texture = decodeKtx2(span(bytesOf(files, json["texture"])));
    ASSERT_TRUE(texture) << texture.error().message;
    const glm::uvec3 n(4, 3, 5);
    EXPECT_EQ(json["size"], Json({4, 3, 5}));
    EXPECT_EQ(texture->shape, (Ktx2Shape{.width = 4, .height = 3, .depth = 49, .zstd = true}));
    const auto texel = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        return texture->texels[(z * n.y + y) * n.x + x];
    };
    for (std::uint32_t z = 0; z < n.z; ++z)
        for (std::uint32_t y = 0; y < n.y; ++y)
            for (std::uint32_t x = 0; x < n.x; ++x)
                for (std::uint32_t k = 0; k < 27; ++k) {
                    const std::size_t cell = (z * n.y + y) * n.x + x;
                    const float expected = light.field.grid[k / 3 * 60 + cell][int(k % 3)];
                    const glm::vec4 t = texel(x, y, k / 4 * (n.z + 2) + 1 + z);
                    EXPECT_NEAR(t[int(k % 4)], expected, 0.004f);
                }
    for (std::uint32_t t = 0; t < 7; ++t) {
        EXPECT_EQ(texel(2, 1, t * 7), texel(2, 1, t * 7 + 1));
        EXPECT_EQ(texel(2, 1, t * 7 + 6), texel(2, 1, t * 7 + 5));
    }
}

TEST(EngineFormats, AGridBeyondHalfFloatsIsWrittenInFloats) {
    for (const float scale : {1e6f, 1e-6f}) {
        const KnownLight light([&](glm::vec3 p) {
            auto c = distinctLight(p);
            for (glm::vec3& v : c)
                v *= scale;
            return c;
        });
        const auto files = exported(light, kGridFormat);
        const auto shape = readKtx2Shape(span(bytesOf(files, "room.ktx2")));
        ASSERT_TRUE(shape);
        EXPECT_EQ(shape->format, Ktx2Format::Rgba32f);
    }
}

TEST(EngineFormats, TheMeanOfTheGridIsItsMean) {
    const KnownLight light(distinctLight);
    const Json json = Json::parse(exported(light, kGridFormat).front().bytes);
    for (std::size_t i = 0; i < 9; ++i) // cells lie about the origin, where p is 0
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(json["mean"][i][c].get<float>(), float(i) + 0.25f * float(c), 1e-5f);
}

TEST(EngineFormats, ImageBasedLightsAreMirroredForEitherWorld) {
    const KnownLight light(distinctLight);
    const auto files = exported(light, kIblFormat);
    const auto coefficients = [&](const std::string& name) {
        const Json gltf = Json::parse(bytesOf(files, name));
        EXPECT_EQ(gltf["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"], 0);
        const Json& l = gltf["extensions"]["EXT_lights_image_based"]["lights"][0];
        for (const Json& face : l["specularImages"][0])
            EXPECT_LT(face.get<std::size_t>(), gltf["images"].size());
        return l["irradianceCoefficients"];
    };
    const Json left = coefficients("room.gltf"), right = coefficients("room-right-handed.gltf");
    // Harmonics odd in x, x: 3, xy: 4, xz: 7, are mirrored in one, those odd in z, z: 2, yz: 5,
    // xz: 7, in the other.
    const std::array<float, 9> ratio = {1, 1, -1, -1, -1, -1, 1, 1, 1};
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_EQ(left[i][1].get<float>(), ratio[i] * right[i][1].get<float>()) << i;
}

TEST(EngineFormats, FilamentsTextHasNineColours) {
    const KnownLight light(constantLight);
    std::istringstream text(exported(light, kFilamentFormat).front().bytes);
    std::string line;
    for (int i = 0; i < 9; ++i) {
        ASSERT_TRUE(std::getline(text, line));
        float r = -1, g = -1, b = -1;
        ASSERT_EQ(std::sscanf(line.c_str(), "(%f, %f, %f); //", &r, &g, &b), 3) << line;
        EXPECT_NEAR(r, i == 0 ? 1 : 0, 1e-6f); // radiance 1 from everywhere
        EXPECT_EQ(r, b);
    }
    EXPECT_FALSE(std::getline(text, line));
}

TEST(EngineFormats, TheNumbersInJsonAreThoseOfTheField) {
    const KnownLight light(distinctLight);
    const Json json = Json::parse(exported(light, kJsonFormat).front().bytes);
    const Json& lightmap = json["lightmap"];
    ASSERT_EQ(lightmap["sh"].size(), 9U * 64 * 3);
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t t = 0; t < 64; ++t)
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(lightmap["sh"][(i * 64 + t) * 3 + c].get<float>(),
                            light.field.lightmap[i * 64 + t][int(c)], 1e-5f);
    const Json& grid = json["grid"];
    ASSERT_EQ(grid["sh"].size(), 9U * 60 * 3);
    EXPECT_EQ(grid["sh"][(4 * 60 + 17) * 3 + 2].get<float>(), light.field.grid[4 * 60 + 17].z);
    EXPECT_EQ(json["instances"][0]["uv"].size(), 8U);
    EXPECT_TRUE(json["instances"][1]["uv"].empty());
    EXPECT_EQ(json["meshes"][0]["sourceVertex"].size(), 4U);
    EXPECT_EQ(json["cameras"][0]["name"], "eye");
}

TEST(EngineFormats, WithoutAGridThereIsNoProbe) {
    KnownLight light(constantLight);
    light.field.grid.clear();
    light.field.gridSize = glm::uvec3(0);
    for (const ExportFormat* format : {&kGridFormat, &kFilamentFormat, &kIblFormat}) {
        const auto files = format->write(light.view(), {}, nameFor(*format), {});
        ASSERT_FALSE(files) << format->name;
        EXPECT_TRUE(files.error().message.starts_with("the light has no grid"));
    }
    for (const ExportFormat* format :
         {&kThreeFormat, &kBabylonFormat, &kPlaycanvasFormat, &kGodotFormat, &kJsonFormat})
        EXPECT_TRUE(format->write(light.view(), {}, nameFor(*format), {})) << format->name;
}

TEST(EngineFormats, ForecastsCountALightmapOnlyWhereOneIsWritten) {
    KnownLight small(constantLight), large(constantLight);
    large.layout.width = large.layout.height = 1024;
    const auto grown = [&](const ExportFormat& format) {
        return format.forecast(large.view(), {}).bytes > format.forecast(small.view(), {}).bytes;
    };
    for (const ExportFormat* format : {&kIblFormat, &kFilamentFormat, &kGridFormat})
        EXPECT_FALSE(grown(*format)) << format->name;
    for (const ExportFormat* format : {&kThreeFormat, &kBlenderFormat, &kGodotFormat})
        EXPECT_TRUE(grown(*format)) << format->name;
}

TEST(EngineFormats, TheForecastOfAGridIsTheSizeOfItsTexture) {
    const KnownLight light(constantLight, {12, 10, 14});
    const auto files = exported(light, kGridFormat);
    const auto bytes = double(bytesOf(files, "room.ktx2").size());
    EXPECT_NEAR(double(kGridFormat.forecast(light.view(), {}).bytes), bytes, 0.01 * bytes);
}

TEST(EngineFormats, ACancelledExportSaysSoAndWritesNothing) {
    const KnownLight light(constantLight);
    const std::atomic<bool> stop = true;
    const TemporaryFolder folder;
    for (const ExportFormat* format : exportFormats()) {
        const auto files = exportLight(folder.file(nameFor(*format)), *format, light.view(), {},
                                       {.report = {}, .cancel = &stop});
        ASSERT_FALSE(files) << format->name;
        EXPECT_EQ(files.error().message, "cancelled") << format->name;
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

} // namespace limn::engine_formats_test
