// SPDX-License-Identifier: MIT
#include "engine/export/engine_formats.h"

#include "engine/core/hash.h"
#include "engine/core/memory_budget.h"
#include "engine/export/gltf_light_json.h"
#include "engine/export/gltf_scene.h"
#include "engine/export/grid_texture.h"
#include "engine/export/lightmap_image.h"
#include "engine/export/vector_json.h"
#include "engine/scene/light/photometry.h"

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

namespace limn {

namespace json_format {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".json"};
/// Above this size a program should read textures.
constexpr std::uint64_t kMaxBytes = std::uint64_t(1) << 30;
constexpr std::uint64_t kBytesPerNumber = 10;

/// A JSON object that is written member by member, because its arrays of numbers are too large to
/// be built in memory.
struct ObjectWriter {
    std::string out = "{";

    void key(const char* name) {
        if (out.back() != '{')
            out += ',';
        fmt::format_to(std::back_inserter(out), "\n\"{}\": ", name);
    }
    void member(const char* name, const Json& value) {
        key(name);
        out += value.dump();
    }
    void numbers(const char* name, std::size_t count, const auto& numberAt) {
        key(name);
        out += '[';
        for (std::size_t i = 0; i < count; ++i) {
            if (i > 0)
                out += ',';
            fmt::format_to(std::back_inserter(out), "{}", numberAt(i));
        }
        out += ']';
    }
    void begin(const char* name) {
        key(name);
        out += '{';
    }
    void end() { out += "\n}"; }
};

Json boundsOf(const Bounds& b) {
    return {{"lower", vectorJson(b.lower)}, {"upper", vectorJson(b.upper)}};
}

Json conventions() {
    return {
        {"axes", "metres, right-handed, +Y up; positions are relative to origin"},
        {"colors", "linear Rec. 709"},
        {"unit", "W m^-2 sr^-1"},
        {"harmonics", "radiance, real, orthonormal, without Condon-Shortley sign; coefficient "
                      "(l, m) has index i = l (l + 1) + m"},
        {"irradiance", "E(n) = max(0, sum over i < 9 of A_l c_i Y_i(n)), A = pi, 2 pi / 3, pi / 4"},
        {"outgoingRadiance", "L = albedo / pi * E"},
        {"lightmap", "sh[((i * height + y) * width + x) * 3 + channel], row 0 at the top; texel "
                     "(x, y) has its centre at uv ((x + 0.5) / width, (y + 0.5) / height)"},
        {"instances", "uv of vertex k of the instance at uv[2 k]; vertex k is a copy of vertex "
                      "sourceVertex[k] of its mesh; an empty uv: lit from the grid; the back of a "
                      "two-sided surface lies backRows texels of the bake's lightmap below"},
        {"grid", "sh[(((i * size.z + z) * size.y + y) * size.x + x) * 3 + channel]; the centre of "
                 "a cell is lower + (index + 0.5) / size * (upper - lower)"}};
}

Json lightOf(const Light& whole) {
    const Light light = withoutProfile(whole);
    constexpr std::array<const char*, 4> kKinds = {"directional", "point", "spot", "rectangle"};
    return {{"name", light.name},
            {"kind", kKinds[std::size_t(light.kind)]},
            {"enabled", light.enabled},
            {"position", vectorJson(light.position)},
            {"direction", vectorJson(light.direction)},
            {"color", vectorJson(light.color)},
            {"strength", light.strength},
            {"range", light.range},
            {"innerAngle", light.innerAngle},
            {"outerAngle", light.outerAngle},
            {"size", {light.size.x, light.size.y}},
            {"roll", light.roll}};
}

Json cameraOf(const Camera& camera) {
    return {{"name", camera.name},
            {"eye", vectorJson(camera.eye)},
            {"target", vectorJson(camera.target)},
            {"up", vectorJson(camera.up)},
            {"fovY", camera.fovY}};
}

void putLightmap(ObjectWriter& json, const LightmapImage& image) {
    json.begin("lightmap");
    json.member("width", image.width);
    json.member("height", image.height);
    json.member("coefficients", image.layers);
    json.numbers("sh", image.rgb.size() * 3,
                 [&](std::size_t i) { return image.rgb[i / 3][int(i % 3)]; });
    json.end();
}

void putInstances(ObjectWriter& json, const ExportScene& in) {
    json.key("instances");
    json.out += '[';
    for (std::size_t i = 0; i < in.scene.instances.size(); ++i) {
        const Instance& instance = in.scene.instances[i];
        const auto object = in.document.objects.find(instance.node);
        ObjectWriter one;
        one.member("name", object == in.document.objects.end() ? "" : objectName(object->second));
        one.member("mesh", instance.mesh);
        one.member("material", instance.material);
        one.member("dynamic", instance.dynamic);
        one.member("toWorld", matrixJson(instance.toWorld));
        const bool mapped = i < in.layout.instances.size() && !in.layout.instances[i].uv.empty();
        const InstanceLightmap none, &map = mapped ? in.layout.instances[i] : none;
        one.member("backRows", map.backRows);
        one.numbers("uv", map.uv.size() * 2,
                    [&](std::size_t k) { return map.uv[k / 2][int(k % 2)]; });
        one.end();
        json.out += (i > 0 ? "," : "") + one.out;
    }
    json.out += ']';
}

void putMeshes(ObjectWriter& json, const ExportScene& in) {
    json.key("meshes");
    json.out += '[';
    for (std::size_t m = 0; m < in.scene.assets->meshes.size(); ++m) {
        const Mesh& mesh = in.scene.assets->meshes[m];
        const MeshCharts none, &charts = m < in.layout.meshes.size() ? in.layout.meshes[m] : none;
        ObjectWriter one;
        one.member("name", mesh.name);
        one.numbers("positions", mesh.positions.size() * 3,
                    [&](std::size_t k) { return mesh.positions[k / 3][int(k % 3)]; });
        one.numbers("normals", mesh.normals.size() * 3,
                    [&](std::size_t k) { return mesh.normals[k / 3][int(k % 3)]; });
        one.numbers("indices", mesh.indices.size(), [&](std::size_t k) { return mesh.indices[k]; });
        one.numbers("sourceVertex", charts.sourceVertex.size(),
                    [&](std::size_t k) { return charts.sourceVertex[k]; });
        one.numbers("chartIndices", charts.indices.size(),
                    [&](std::size_t k) { return charts.indices[k]; });
        one.end();
        json.out += (m > 0 ? "," : "") + one.out;
    }
    json.out += ']';
}

void putGrid(ObjectWriter& json, const IndirectField& field) {
    const std::size_t cells = field.cells();
    const std::size_t coefficients = std::min(field.coefficients(), 9U);
    json.begin("grid");
    json.member("bounds", boundsOf(field.gridBounds));
    json.member("size", vectorJson(field.gridSize));
    json.member("coefficients", coefficients);
    json.numbers("sh", cells * coefficients * 3,
                 [&](std::size_t i) { return field.grid[i / 3][int(i % 3)]; });
    json.end();
}

void putScene(ObjectWriter& json, const ExportScene& in) {
    Json lights = Json::array(), cameras = Json::array(), materials = Json::array();
    for (const Light& light : in.scene.lights)
        lights.push_back(lightOf(light));
    for (const Camera& camera : in.scene.cameras)
        cameras.push_back(cameraOf(camera));
    for (const Material& m : in.scene.materials)
        materials.push_back(
            {{"name", m.name},
             {"baseColor", {m.baseColor.x, m.baseColor.y, m.baseColor.z, m.baseColor.w}},
             {"metallic", m.metallic},
             {"roughness", m.roughness},
             {"emission", vectorJson(m.emission)},
             {"transmission", m.transmission},
             {"ior", m.ior},
             {"thickness", m.thickness},
             {"doubleSided", m.doubleSided}});
    json.member("origin", vectorJson(in.document.origin));
    json.member("bounds", boundsOf(in.scene.bounds));
    json.member("lights", lights);
    json.member("cameras", cameras);
    json.member("materials", materials);
}

ExportSettings ownSettings(const ExportScene& scene) {
    ExportSettings settings;
    settings.bands = std::min(scene.field.bands, 3U);
    settings.detail = 1;
    settings.maxSize = 16384;
    return settings;
}

ExportForecast forecast(const ExportScene& scene, const ExportSettings&) {
    const IndirectField& field = scene.field;
    const std::uint64_t coefficients = std::min(field.coefficients(), 9U);
    const std::uint64_t texels = std::uint64_t(field.lightmapWidth) * field.lightmapHeight;
    std::uint64_t numbers = 3 * coefficients * (texels + field.cells());
    for (const Mesh& mesh : scene.scene.assets->meshes)
        numbers += mesh.positions.size() * 8 + mesh.indices.size() * 2;
    for (const InstanceLightmap& instance : scene.layout.instances)
        numbers += instance.uv.size() * 2;
    return {.bytes = numbers * kBytesPerNumber,
            .width = field.lightmapWidth,
            .height = field.lightmapHeight,
            .detail = 1};
}

Result<std::vector<ExportFile>> write(const ExportScene& scene, const ExportSettings& settings,
                                      const std::string& name, const Progress& progress) {
    if (const std::uint64_t bytes = forecast(scene, settings).bytes; bytes > kMaxBytes)
        return fail(fmt::format("JSON would take about {}; use the formats lightmap and grid",
                                bytesText(bytes)));
    ObjectWriter json;
    json.member("format", "limn-light");
    json.member("version", 1);
    json.member("receipt", {{"generator", "Limn"},
                            {"scene", hexHash(scene.document.sceneHash)},
                            {"bands", scene.field.bands},
                            {"technique", scene.scene.technique.technique}});
    json.member("conventions", conventions());
    putScene(json, scene);
    if (scene.field.lightmapWidth > 0) {
        const Result<LightmapImage> image = lightmapImage(scene, ownSettings(scene), progress);
        if (!image)
            return tl::make_unexpected(image.error());
        putLightmap(json, *image);
    }
    if (!scene.field.grid.empty())
        putGrid(json, scene.field);
    if (progress.cancelled())
        return fail("cancelled");
    putMeshes(json, scene);
    putInstances(json, scene);
    json.end();
    return std::vector<ExportFile>{{name, std::move(json.out) + "\n"}};
}

} // namespace
} // namespace json_format

constinit const ExportFormat kJsonFormat = {
    .name = "json",
    .label = "Numbers as JSON",
    .summary =
        "Everything as one JSON file for programs of your own: geometry, texture coordinates, "
        "harmonics of lightmap and grid, lights and cameras",
    .extensions = json_format::kExtensions,
    .settings = {},
    .write = json_format::write,
    .forecast = json_format::forecast};

} // namespace limn
