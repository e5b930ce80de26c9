// SPDX-License-Identifier: MIT
#include "engine/export/baked_light.h"

#include "engine/core/read_file.h"
#include "engine/files/image_file.h"
#include "engine/files/ktx2.h"
#include "engine/gltf/gltf_uri.h"
#include "engine/json/json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr std::size_t kMaxLayers = 9;

/// Texels of a lightmap or one of its pages, layer after layer.
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

/// The files that a lightmap names, one for each page, in `folder`.
Result<std::vector<std::string>> filesOf(const Json& lightmap, const std::string& folder) {
    const std::string member = "asset.extras.limn.lightmap";
    const bool several = lightmap.contains("uris");
    const Json uris =
        several ? lightmap["uris"] : Json::array({Json(lightmap["uri"])}); // the usual single one
    if (!uris.isArray() || uris.empty())
        return fail(member + ".uris: is not an array of texture files");
    std::vector<std::string> files;
    for (std::size_t page = 0; page < uris.size(); ++page) {
        const std::string field =
            several ? fmt::format("{}.uris[{}]", member, page) : member + ".uri";
        if (!uris[page].isString())
            return fail(field + ": is missing");
        Result<std::string> file =
            fileOfUri(folder, uris[page].get<std::string>(), FileReach::Folder);
        if (!file)
            return fail(field + ": " + file.error().message);
        files.push_back(std::move(*file));
    }
    return files;
}

/// The texels of all pages, each below the one before.
Result<Texels> readPages(const std::vector<std::string>& files, const MemoryBudget& memory) {
    Result<Texels> first = readTexels(files.front(), memory);
    if (!first || files.size() == 1)
        return first;
    Texels all{first->width, first->height * std::uint32_t(files.size()), first->layers, {}};
    const std::size_t texels = std::size_t(first->width) * first->height;
    if (all.height / files.size() != first->height ||
        first->rgb.size() * sizeof(glm::vec3) > memory.maxBytes / files.size())
        return fail(fmt::format("{}: {} textures of this size do not fit into memory",
                                files.front(), files.size()));
    all.rgb.resize(first->rgb.size() * files.size());
    for (std::size_t page = 0; page < files.size(); ++page) {
        Result<Texels> read = page == 0 ? std::move(first) : readTexels(files[page], memory);
        if (!read)
            return read;
        if (read->width != all.width || read->rgb.size() != all.layers * texels)
            return fail(fmt::format("{}: must be as large as the first texture", files[page]));
        for (std::size_t l = 0; l < all.layers; ++l)
            std::copy_n(read->rgb.begin() + std::ptrdiff_t(l * texels), texels,
                        all.rgb.begin() + std::ptrdiff_t((l * files.size() + page) * texels));
    }
    return all;
}

/// The page that each material's lookups read.
Result<std::vector<std::uint32_t>> pagesOf(const Json& gltf, const Scene& scene,
                                           std::size_t pages) {
    std::vector<std::uint32_t> page(scene.materials.size(), 0);
    const Json& materials = gltf["materials"];
    for (std::size_t m = 0; m < std::min(page.size(), materials.size()); ++m) {
        const Json& named = materials[m]["extras"]["limn"]["lightmapPage"];
        if (named.isNull())
            continue;
        const std::optional<std::uint32_t> number = named.integerWithin<std::uint32_t>();
        if (!number || *number >= pages)
            return fail(fmt::format("materials[{}].extras.limn.lightmapPage: {} is none of {} "
                                    "textures",
                                    m, named.dump(), pages));
        page[m] = *number;
    }
    return page;
}

/// A layout in which every vertex has its TEXCOORD_1 on its material's page. Pages lie below each
/// other; the halves of a page's outer texels, where a lookup would read the next page, too, show
/// the texels' centres, as clamping to the edge does.
LightmapLayout layoutOf(const Scene& scene, glm::uvec2 size,
                        const std::vector<std::uint32_t>& pageOfMaterial, std::size_t pages) {
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
    const float half = 0.5f * float(pages) / float(size.y); // of a texel, on its page
    for (const Instance& instance : scene.instances) {
        InstanceLightmap place{scene.meshOf(instance).uv1, 0};
        const float page = float(pageOfMaterial[instance.material]);
        for (glm::vec2& uv : place.uv)
            uv = {std::clamp(uv.x, 0.f, 1.f),
                  (page + std::clamp(uv.y, half, 1 - half)) / float(pages)};
        layout.instances.push_back(std::move(place));
    }
    return layout;
}

/// Whether `back` is `front` turned round.
bool isTurnedRound(const Mesh& front, const Mesh& back) {
    if (back.positions != front.positions || back.indices.size() != front.indices.size())
        return false;
    for (std::size_t t = 0; t < front.triangleCount(); ++t) {
        const auto [a, b, c] = front.triangle(t);
        if (back.triangle(t) != std::array{a, c, b})
            return false;
    }
    return true;
}

/// Rows of texels that lead from every vertex of one instance down to that of another.
std::optional<std::uint32_t> rowsBetween(const LightmapLayout& layout, std::uint32_t front,
                                         std::uint32_t back) {
    constexpr float kNear = 0.01f; // texels
    const std::vector<glm::vec2>&a = layout.instances[front].uv, &b = layout.instances[back].uv;
    if (a.empty() || a.size() != b.size())
        return std::nullopt;
    const float rows = std::round((b[0].y - a[0].y) * float(layout.height));
    const glm::vec2 size(float(layout.width), float(layout.height));
    for (std::size_t v = 0; v < a.size(); ++v)
        if (const glm::vec2 off = glm::abs((b[v] - a[v]) * size - glm::vec2(0, rows));
            !(rows > 0) || off.x > kNear || off.y > kNear)
            return std::nullopt;
    return std::uint32_t(rows);
}

/// Exports write a two-sided surface as two one-sided ones in the same place, of which programs
/// show the one that faces the eye. A ray may meet either, so both become one two-sided surface
/// again.
void joinSides(Scene& scene, LightmapLayout& layout) {
    std::vector<Instance> instances;
    std::vector<InstanceLightmap> places;
    std::map<std::uint32_t, std::uint32_t> twoSided; // of a one-sided material
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        instances.push_back(scene.instances[i]);
        places.push_back(layout.instances[i]);
        const std::uint32_t next = i + 1;
        if (next == scene.instances.size() || isTwoSided(scene, scene.instances[i]) ||
            scene.instances[next].node != scene.instances[i].node ||
            scene.instances[next].material != scene.instances[i].material ||
            !isTurnedRound(scene.meshOf(scene.instances[i]), scene.meshOf(scene.instances[next])))
            continue;
        const std::optional<std::uint32_t> rows = rowsBetween(layout, i, next);
        if (!rows)
            continue;
        const auto [entry, isNew] =
            twoSided.try_emplace(instances.back().material, std::uint32_t(scene.materials.size()));
        if (isNew) {
            scene.materials.push_back(scene.materialOf(instances.back()));
            scene.materials.back().doubleSided = true;
        }
        instances.back().material = entry->second;
        places.back().backRows = *rows;
        i = next;
    }
    scene.instances = std::move(instances);
    layout.instances = std::move(places);
}

} // namespace

Result<BakedLight> readBakedLight(const std::string& path, Scene& scene,
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
    const std::optional<float> unit = unitOf(lightmap);
    if (!unit)
        return wrong("asset.extras.limn.lightmap.quantity: must be irradiance, "
                     "irradiance-over-pi or harmonics");
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const Result<std::vector<std::string>> files = filesOf(lightmap, folder.empty() ? "." : folder);
    if (!files)
        return wrong(files.error().message);
    const Result<std::vector<std::uint32_t>> pageOfMaterial = pagesOf(*gltf, scene, files->size());
    if (!pageOfMaterial)
        return wrong(pageOfMaterial.error().message);
    const Result<Texels> texels = readPages(*files, memory);
    if (!texels)
        return tl::make_unexpected(texels.error());
    if (texels->layers != 1 && texels->layers != 4 && texels->layers != kMaxLayers)
        return wrong(fmt::format("asset.extras.limn.lightmap: {} layers are not those of one, two "
                                 "or three bands",
                                 texels->layers));
    BakedLight light;
    light.layout = layoutOf(scene, {texels->width, texels->height}, *pageOfMaterial, files->size());
    joinSides(scene, light.layout);
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
