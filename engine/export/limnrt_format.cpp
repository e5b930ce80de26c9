// SPDX-License-Identifier: MIT
#include "engine/export/limnrt_format.h"

#include "engine/export/lightmap_image.h"
#include "engine/lightmap/plain_lightmap.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/illuminance/illuminance.h"
#include "engine/techniques/illuminance/transport/transport_file.h"

#include <array>

namespace limn {

namespace limnrt_format {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".limnrt"};
constexpr std::array<std::string_view, 2> kSettings = {"detail", "maxSize"};

Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings& settings,
                                      const std::string& name, const Progress& progress) {
    Result<std::string> bytes = transportBytes(scene, settings, progress);
    if (!bytes)
        return tl::make_unexpected(bytes.error());
    return std::vector<ExportFile>{{name, std::move(*bytes)}};
}

/// The bake that lights the scene; null if another technique does.
const Bake* bakeBehind(const ExportScene& scene) {
    if (!scene.precomputed || &scene.precomputed->technique() != &kIlluminanceTechnique)
        return nullptr;
    return bakeOf(*scene.precomputed).get();
}

} // namespace
} // namespace limnrt_format

Result<std::string> transportBytes(const ExportScene& scene, const ExportSettings& settings,
                                   const Progress& progress, bool roundedLinks) {
    const Bake* bake = limnrt_format::bakeBehind(scene);
    if (!bake)
        return fail("the technique that lights the scene has no transport to export");
    const Result<std::uint32_t> detail = lightmapDetail(scene.layout, settings);
    if (!detail)
        return tl::make_unexpected(detail.error());
    progress.at("lightmap", 0);
    const PlainLightmap plain = plainLightmap(scene.scene, scene.layout, *detail);
    if (progress.cancelled())
        return fail("cancelled");
    progress.at("transport", 0);
    std::vector<glm::uvec4> texel;
    std::vector<glm::vec4> weight;
    texel.reserve(plain.texelAt.size());
    weight.reserve(plain.texelAt.size());
    for (const std::uint32_t index : plain.texelAt) {
        texel.push_back(plain.texels[index].texel);
        weight.push_back(plain.texels[index].weight);
    }
    const TransportLightmap lightmap{plain.width, plain.height, texel, weight};
    return transportFile({.bake = *bake,
                          .scene = scene.scene,
                          .lightmap = texel.empty() ? nullptr : &lightmap,
                          .program = "Limn",
                          .roundedLinks = roundedLinks});
}

ExportForecast forecastTransport(const ExportScene& scene, const ExportSettings& settings) {
    ExportForecast f = forecastLightmap(scene.layout, settings);
    // About as many texels read one cache as read four; a part takes 6 bytes, a texel 4 more.
    f.bytes = std::uint64_t(f.width) * f.height * (4 + 5 * 6 / 2);
    const Bake* bake = limnrt_format::bakeBehind(scene);
    if (!bake)
        return f;
    f.bytes += bake->caches.linkCount() * sizeof(Link) + bake->caches.size() * 40 +
               bake->surfels.size() * 90 + bake->surfels.lightPoints.size() * sizeof(glm::vec3) +
               bake->tree.size() * 12 + bake->counts.triangles * 64;
    return f;
}

constinit const ExportFormat kLimnrtFormat = {
    .name = "limnrt",
    .label = "Relightable transport",
    .summary = "A file from which engine/runtime, or any reader of its specification, relights the "
               "scene while lamps, sky and colours change",
    .extensions = limnrt_format::kExtensions,
    .settings = limnrt_format::kSettings,
    .write = limnrt_format::write,
    .forecast = forecastTransport};

} // namespace limn
