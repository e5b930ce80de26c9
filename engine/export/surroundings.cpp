// SPDX-License-Identifier: MIT
#include "engine/export/surroundings.h"

#include "engine/core/percent_encoding.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/lightmap_file.h"
#include "engine/export/panorama.h"
#include "engine/export/reflection_places.h"
#include "engine/export/vector_json.h"

#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kWidth = 256, kHeight = 128; ///< of a reflection [pixels]
constexpr float kMaxHalf = 65504;

/// Adds the file and returns what names it.
Result<Json> addPanorama(Surroundings& around, ImageF image, TextureEncoding encoding,
                         const std::string& stem) {
    if (encoding != TextureEncoding::Exr)
        for (glm::vec3& v : image.rgb)
            v = glm::min(v, kMaxHalf);
    Result<ExportFile> file = lightmapFile({image.width, image.height, 1, std::move(image.rgb)},
                                           {.encoding = encoding}, stem);
    if (!file)
        return tl::make_unexpected(file.error());
    Json json = {{"uri", percentEncoded(file->name)},
                 {"width", image.width},
                 {"height", image.height},
                 {"firstRow", "top"},
                 {"projection", "latitude-longitude; its middle faces +X, its left quarter -Z"},
                 {"colors", "linear Rec. 709"},
                 {"unit", "W m^-2 sr^-1"}};
    around.files.push_back(std::move(*file));
    return json;
}

} // namespace

Result<Surroundings> surroundings(const ExportScene& scene, std::uint32_t reflections,
                                  TextureEncoding encoding, const std::string& stem,
                                  const Progress& progress) {
    Surroundings around;
    if (ImageF sky = skyPanorama(scene.scene.sky); !sky.rgb.empty()) {
        Result<Json> json = addPanorama(around, std::move(sky), encoding, stem + "-sky");
        if (!json)
            return tl::make_unexpected(json.error());
        around.json["sky"] = std::move(*json);
    }
    if (reflections == 0)
        return around;
    ReflectionPlaces places = reflectionPlaces(scene, reflections);
    for (std::size_t k = 0; k < places.places.size(); ++k) {
        ImageF image = panoramaSeenFrom(scene, places.places[k], kWidth, kHeight, progress);
        if (progress.cancelled())
            return fail("cancelled");
        Result<Json> json = addPanorama(around, std::move(image), encoding,
                                        fmt::format("{}-reflection-{}", stem, k + 1));
        if (!json)
            return tl::make_unexpected(json.error());
        (*json)["position"] = vectorJson(glm::dvec3(places.places[k]) + scene.document.origin);
        around.json["reflections"].push_back(std::move(*json));
    }
    around.ofInstance = std::move(places.ofInstance);
    return around;
}

std::uint64_t surroundingsBytes(const ExportScene& scene, std::uint32_t reflections) {
    constexpr std::uint64_t kTexelBytes = 8;
    const std::uint64_t sky = scene.scene.sky.showsImage() ? 1024 * 512 : 0;
    return kTexelBytes * (sky + std::uint64_t(reflections) * kWidth * kHeight);
}

} // namespace limn
