// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/export/gltf_scene.h"
#include "engine/export/grid_texture.h"
#include "engine/files/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limn {

using Json = nlohmann::ordered_json;

static constexpr std::array<std::string_view, 1> kExtensions = {".gltf"};

/// Babylon.js takes powers of two from 2 on.
static constexpr std::uint32_t kFaceSize = 4;

/// A picture of one colour, encoded as Babylon.js' RGBD: linear colour = (rgb / 255)^2.2 / alpha.
static Result<std::string> rgbdPng(const glm::vec3& color) {
    const float most = std::max({color.x, color.y, color.z, 1e-6f});
    const float divisor = std::clamp(std::floor(255 / std::max(most, 1.f)), 1.f, 255.f) / 255;
    Image image;
    image.name = "specular";
    image.width = image.height = kFaceSize;
    for (std::uint32_t texel = 0; texel < kFaceSize * kFaceSize; ++texel) {
        for (int c = 0; c < 3; ++c) {
            const float v = std::pow(std::clamp(color[c] * divisor, 0.f, 1.f), 1 / 2.2f);
            image.rgba.push_back(std::uint8_t(std::lround(255 * v)));
        }
        image.rgba.push_back(std::uint8_t(std::lround(255 * divisor)));
    }
    return encodePng(image);
}

/// The glTF file with the extension's light in its scene. The extension demands images of the
/// reflected light; they show the probe's mean colour from everywhere.
static Json withLight(Json gltf, const Sh3& mean, BabylonWorld world, const std::string& image) {
    Json& images = gltf["images"];
    const std::size_t number = images.size();
    images.push_back({{"uri", uriOf(image)}});
    Json faces = Json::array();
    for (int face = 0; face < 6; ++face)
        faces.push_back(number);
    Json light = {{"name", "Limn"},
                  {"intensity", 1},
                  {"rotation", {0, 0, 0, 1}},
                  {"irradianceCoefficients", shJson(imageBasedLight(mean, world))},
                  {"specularImageSize", kFaceSize},
                  {"specularImages", Json::array({std::move(faces)})}};
    gltf["extensionsUsed"].push_back("EXT_lights_image_based");
    gltf["extensions"]["EXT_lights_image_based"]["lights"] = Json::array({std::move(light)});
    gltf["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return gltf;
}

static Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings&,
                                             const std::string& name, const Progress& progress) {
    if (const Result<void> exists = checkGrid(scene.field); !exists)
        return tl::make_unexpected(exists.error());
    Result<std::vector<ExportFile>> files =
        gltfFiles(scene, {}, name, progress);
    if (!files)
        return files;
    const Sh3 mean = meanProbe(scene.field);
    const std::string stem = stemOf(name), image = stem + "-specular.png";
    Result<std::string> png = rgbdPng(glm::max(mean[0] * kShConstants[0], glm::vec3(0)));
    if (!png)
        return tl::make_unexpected(png.error());
    const Json gltf = Json::parse(files->front().bytes);
    const auto text = [&](BabylonWorld world) {
        return withLight(gltf, mean, world, image).dump(1) + "\n";
    };
    files->front().bytes = text(BabylonWorld::LeftHanded);
    files->push_back({stem + "-right-handed.gltf", text(BabylonWorld::RightHanded)});
    files->push_back({image, std::move(*png)});
    return files;
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings&) {
    return {.bytes = gltfBytes(scene)};
}

constinit const ExportFormat kIblFormat = {
    .name = "ibl",
    .label = "glTF with image-based light",
    .summary = "glTF whose scene carries the grid's mean light by EXT_lights_image_based, once for "
               "left-handed and once for right-handed scenes of Babylon.js",
    .extensions = kExtensions,
    .settings = {},
    .write = write,
    .forecast = forecast};

} // namespace limn
