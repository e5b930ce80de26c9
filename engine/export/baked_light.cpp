// SPDX-License-Identifier: MIT
#include "engine/export/baked_light.h"

#include "engine/core/read_file.h"
#include "engine/files/image_file.h"
#include "engine/files/ktx2.h"
#include "engine/gltf/gltf_uri.h"
#include "engine/json/json.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr std::size_t kMaxLayers = 9;

/// Texels of a lightmap, layer after layer.
struct Texels {
    std::uint32_t width = 0, height = 0;
    std::uint64_t layers = 1;
    std::vector<glm::vec3> rgb;
};

/// The JSON of a glTF file, or the first chunk of a .glb.
Result<Json> gltfJson(const std::string& bytes) {
    std::string_view text = bytes;
    constexpr std::size_t kGlbHeader = 20;
    if (text.starts_with("glTF") && text.size() >= kGlbHeader) {
        std::uint32_t length = 0;
        for (std::size_t k = 0; k < 4; ++k)
            length |= std::uint32_t(static_cast<unsigned char>(text[12 + k])) << 8 * k;
        if (length > text.size() - kGlbHeader)
            return fail("truncated chunk");
        text = text.substr(kGlbHeader, length);
    }
    return parseJson(text);
}

Result<Texels> readTexels(const std::string& path, const MemoryBudget& memory) {
    if (!path.ends_with(".ktx2")) {
        Result<ImageF> image = readFloatImage(path, memory);
        if (!image)
            return tl::make_unexpected(image.error());
        return Texels{image->width, image->height, 1, std::move(image->rgb)};
    }
    const Result<std::string> bytes = readFile(path, memory.maxBytes);
    if (!bytes)
        return fail(fmt::format("{}: {}", path, bytes.error().message));
    const Result<Ktx2Texture> texture = decodeKtx2(
        std::span(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()), memory);
    if (!texture)
        return fail(fmt::format("{}: {}", path, texture.error().message));
    Texels texels{texture->shape.width, texture->shape.height, texture->shape.images(), {}};
    texels.rgb.reserve(texture->texels.size());
    for (const glm::vec4& texel : texture->texels)
        texels.rgb.emplace_back(texel);
    return texels;
}

/// Factor that makes irradiance, or harmonics, of what texels hold; std::nullopt: none does.
std::optional<float> unitOf(const Json& lightmap) {
    const Json& quantity = lightmap["quantity"];
    const std::string name = quantity.isString() ? quantity.get<std::string>() : "";
    if (name == "irradiance" || name == "harmonics")
        return 1.f;
    if (name == "irradiance-over-pi")
        return glm::pi<float>();
    return std::nullopt;
}

/// A layout in which every vertex has its TEXCOORD_1.
LightmapLayout layoutOf(const Scene& scene, glm::uvec2 size) {
    LightmapLayout layout;
    layout.width = size.x;
    layout.height = size.y;
    for (const Mesh& mesh : scene.assets->meshes) {
        MeshCharts charts;
        charts.sourceVertex.resize(mesh.positions.size());
        std::iota(charts.sourceVertex.begin(), charts.sourceVertex.end(), 0U);
        charts.indices = mesh.indices;
        charts.chartOfTriangle.assign(mesh.triangleCount(), 0);
        charts.chartUv.assign(mesh.positions.size(), glm::vec2(0));
        charts.chartSize = {glm::vec2(0)};
        layout.meshes.push_back(std::move(charts));
    }
    for (const Instance& instance : scene.instances) {
        InstanceLightmap place{scene.meshOf(instance).uv1, 0};
        for (glm::vec2& uv : place.uv)
            uv = glm::clamp(uv, glm::vec2(0), glm::vec2(1));
        layout.instances.push_back(std::move(place));
    }
    return layout;
}

} // namespace

Result<BakedLight> readBakedLight(const std::string& path, const Scene& scene,
                                  const MemoryBudget& memory) {
    const auto wrong = [&](const std::string& what) {
        return fail(fmt::format("{}: {}", path, what));
    };
    const Result<std::string> bytes = readFile(path, memory.maxBytes);
    if (!bytes)
        return wrong(bytes.error().message);
    const Result<Json> gltf = gltfJson(*bytes);
    if (!gltf)
        return wrong(gltf.error().message);
    const Json& lightmap = (*gltf)["asset"]["extras"]["limn"]["lightmap"];
    if (!lightmap.isObject())
        return wrong("asset.extras.limn.lightmap: is missing; the file is no export with a "
                     "lightmap");
    if (lightmap.contains("uris"))
        return wrong("asset.extras.limn.lightmap.uris: a lightmap of several textures is not "
                     "drawn; export it with a larger --max-size");
    if (!lightmap["uri"].isString())
        return wrong("asset.extras.limn.lightmap.uri: is missing");
    const std::optional<float> unit = unitOf(lightmap);
    if (!unit)
        return wrong("asset.extras.limn.lightmap.quantity: must be irradiance, "
                     "irradiance-over-pi or harmonics");
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const Result<std::string> file = fileOfUri(
        folder.empty() ? "." : folder, lightmap["uri"].get<std::string>(), FileReach::Folder);
    if (!file)
        return wrong("asset.extras.limn.lightmap.uri: " + file.error().message);
    const Result<Texels> texels = readTexels(*file, memory);
    if (!texels)
        return tl::make_unexpected(texels.error());
    if (texels->layers != 1 && texels->layers != 4 && texels->layers != kMaxLayers)
        return wrong(fmt::format("asset.extras.limn.lightmap: {} layers are not those of one, two "
                                 "or three bands",
                                 texels->layers));
    BakedLight light;
    light.layout = layoutOf(scene, {texels->width, texels->height});
    light.hasDirectLight =
        lightmap["includesDirectLight"].isBoolean() && lightmap["includesDirectLight"].get<bool>();
    const std::size_t count = std::size_t(texels->width) * texels->height;
    light.field.version = 1;
    light.field.lightmapWidth = texels->width;
    light.field.lightmapHeight = texels->height;
    light.field.lightmap.assign(kMaxLayers * count, glm::vec4(0));
    // Irradiance E is that of even radiance E / pi from everywhere: c_0 = E / (pi Y_0).
    const float scale = texels->layers > 1 ? *unit : *unit * 2 / std::sqrt(glm::pi<float>());
    for (std::size_t i = 0; i < texels->layers * count; ++i)
        light.field.lightmap[i] = glm::vec4(texels->rgb[i] * scale, 0);
    return light;
}

} // namespace limn
