// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/core/percent_encoding.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/grid_texture.h"
#include "engine/export/probe_cube.h"
#include "engine/files/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace limn {
namespace ibl_format {

static constexpr std::array<std::string_view, 1> kExtensions = {".gltf"};

/// Texels along each side of the cube map's faces, a power of two, and its number of mips.
static constexpr std::uint32_t kFaceSize = 64, kMips = 4;

/// Roughness of a mip, as alpha of GGX, with which Babylon.js chooses between them:
/// log2(kFaceSize alpha) (kMips - 1) / log2(kFaceSize) is the mip's number.
static float alphaOf(std::uint32_t mip) {
    return std::pow(float(kFaceSize), float(mip) / float(kMips - 1) - 1);
}

/// The largest value that RGBD can hold.
static constexpr float kMaxRgbd = 255;

/// A face of the cube, encoded as Babylon.js' RGBD: linear colour = (rgb / 255)^2.2 / alpha. The
/// extension wants faces upside down.
static Result<std::string> rgbdPng(const CubeMap& cube, std::size_t face, float scale) {
    Image image;
    image.name = "specular";
    image.width = image.height = cube.size;
    const std::size_t texels = std::size_t(cube.size) * cube.size;
    for (std::size_t t = 0; t < texels; ++t) {
        const std::size_t row = cube.size - 1 - t / cube.size, column = t % cube.size;
        const glm::vec3 radiance = cube.rgb[face * texels + row * cube.size + column];
        const glm::vec3 color = glm::max(radiance * scale, glm::vec3(0));
        const float maximum = std::max({color.x, color.y, color.z, 1.f});
        const float divisor = std::clamp(std::floor(255 / maximum), 1.f, 255.f) / 255;
        for (int c = 0; c < 3; ++c) {
            const float v = std::pow(std::clamp(color[c] * divisor, 0.f, 1.f), 1 / 2.2f);
            image.rgba.push_back(std::uint8_t(std::lround(255 * v)));
        }
        image.rgba.push_back(std::uint8_t(std::lround(255 * divisor)));
    }
    return encodePng(image);
}

/// The light of a scene's probe.
struct ProbeLight {
    Sh3 mean;                  ///< of the grid
    std::vector<CubeMap> mips; ///< what is reflected, the sharpest first
    float intensity;           ///< with which the brightest value fits into RGBD
};

static Result<ProbeLight> probeLight(const ExportScene& scene, const Progress& progress) {
    ProbeLight light{meanProbe(scene.field), {}, 1};
    light.mips = {cubeSeenFrom(scene, probePosition(scene), kFaceSize, progress)};
    for (std::uint32_t mip = 1; mip < kMips && !progress.cancelled(); ++mip)
        light.mips.push_back(prefiltered(light.mips.front(), alphaOf(mip), kFaceSize >> mip));
    if (progress.cancelled())
        return fail("cancelled");
    float maximum = 0;
    for (const glm::vec3& v : light.mips.front().rgb)
        maximum = std::max({maximum, v.x, v.y, v.z});
    light.intensity = std::max(maximum / kMaxRgbd, 1.f);
    return light;
}

/// The glTF file with the extension's light in its scene. Its images are appended to `buffer`,
/// which is the file `bufferName`.
static Result<Json> withLight(Json gltf, const ProbeLight& light, BabylonWorld world,
                              const std::string& bufferName, std::string& buffer) {
    const glm::vec3 signs =
        world == BabylonWorld::LeftHanded ? glm::vec3(-1, 1, 1) : glm::vec3(1, 1, -1);
    Json mips = Json::array();
    for (const CubeMap& mip : light.mips) {
        const CubeMap cube = mirrored(mip, signs);
        Json faces = Json::array();
        for (std::size_t face = 0; face < 6; ++face) {
            const Result<std::string> png = rgbdPng(cube, face, 1 / light.intensity);
            if (!png)
                return tl::make_unexpected(png.error());
            faces.push_back(gltf["images"].size());
            gltf["images"].push_back(
                {{"bufferView", gltf["bufferViews"].size()}, {"mimeType", "image/png"}});
            gltf["bufferViews"].push_back({{"buffer", gltf["buffers"].size()},
                                           {"byteOffset", buffer.size()},
                                           {"byteLength", png->size()}});
            buffer += *png;
        }
        mips.push_back(std::move(faces));
    }
    gltf["buffers"].push_back({{"uri", percentEncoded(bufferName)}, {"byteLength", buffer.size()}});
    Sh3 mean = light.mean;
    for (glm::vec3& c : mean)
        c /= light.intensity;
    Json json = {{"name", "Limn"},
                 {"intensity", light.intensity},
                 {"rotation", {0, 0, 0, 1}},
                 {"irradianceCoefficients", shJson(imageBasedLight(mean, world))},
                 {"specularImageSize", kFaceSize},
                 {"specularImages", std::move(mips)}};
    gltf["extensionsUsed"].push_back("EXT_lights_image_based");
    gltf["extensions"]["EXT_lights_image_based"]["lights"] = Json::array({std::move(json)});
    gltf["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return gltf;
}

static Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings&,
                                             const std::string& name, const Progress& progress) {
    if (const Result<void> exists = checkGrid(scene.field); !exists)
        return tl::make_unexpected(exists.error());
    Result<std::vector<ExportFile>> files = gltfFiles(scene, {}, name, progress);
    if (!files)
        return files;
    const Result<ProbeLight> light = probeLight(scene, progress);
    if (!light)
        return tl::make_unexpected(light.error());
    const std::string stem = stemOf(name), rightHanded = stem + "-right-handed";
    const Json gltf = *parseJson(files->front().bytes); // that gltfFiles() wrote
    for (const auto& [world, file] : {std::pair(BabylonWorld::LeftHanded, stem),
                                      std::pair(BabylonWorld::RightHanded, rightHanded)}) {
        ExportFile images{file + "-specular.bin", {}};
        const Result<Json> lit = withLight(gltf, *light, world, images.name, images.bytes);
        if (!lit)
            return tl::make_unexpected(lit.error());
        if (world == BabylonWorld::LeftHanded)
            files->front().bytes = lit->dump(1) + "\n";
        else
            files->push_back({file + ".gltf", lit->dump(1) + "\n"});
        files->push_back(std::move(images));
    }
    return files;
}

static ExportForecast forecast(const ExportScene& scene, const ExportSettings&) {
    constexpr std::uint64_t kImages = 120'000; // of both worlds; PNG compresses them
    return {.bytes = gltfBytes(scene) + kImages};
}

} // namespace ibl_format

constinit const ExportFormat kIblFormat = {
    .name = "ibl",
    .label = "glTF with image-based light",
    .summary =
        "glTF whose scene carries the grid's mean light and what is reflected in its middle "
        "by EXT_lights_image_based, once for left-handed and once for right-handed scenes of "
        "Babylon.js",
    .extensions = ibl_format::kExtensions,
    .settings = {},
    .write = ibl_format::write,
    .forecast = ibl_format::forecast};

} // namespace limn
