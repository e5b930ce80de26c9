// SPDX-License-Identifier: MIT
// write_transports FOLDER: writes a small bake of the Cornell box as FOLDER/1.limnrt to 3.limnrt,
// with three lightings, and as 1.f32 to 3.f32 the lightmap's coefficients by the Relighter. 4 is
// the first lighting with a sheet below the lamp that has holes.
#include "engine/core/replace_file.h"
#include "engine/files/project_file.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/techniques/illuminance/transport/transport_file.h"
#include "tests/core/source_path.h"
#include "tests/trace/simple_scene.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {
namespace {

std::vector<Light> lightingOf(int k) {
    Light light;
    light.position = {0.6f, 1.2f, 1};
    light.color = {1, 0.9f, 0.7f};
    light.strength = 30;
    light.direction = glm::normalize(glm::vec3(-0.4f, -1, -0.3f));
    light.range = 9;
    light.innerAngle = 0.2f;
    light.outerAngle = 0.7f;
    light.kind = k == 0 ? LightKind::Point : k == 1 ? LightKind::Spot : LightKind::Directional;
    if (k == 2)
        light.direction = glm::normalize(glm::vec3(0.3f, -0.5f, -1)); // through the open front
    return {light};
}

/// Hangs a sheet across the scene, whose holes repeat.
void addSheet(Scene& scene) {
    const auto assets = std::make_shared<Assets>(*scene.assets);
    assets->images.push_back({"holes", 2, 2, std::vector<std::uint8_t>(16, 255)});
    assets->images.back().rgba[3] = assets->images.back().rgba[15] = 0;
    Material material;
    material.alphaMode = AlphaMode::Mask;
    material.baseColorTexture.image = std::int32_t(assets->images.size() - 1);
    material.baseColorTexture.scale = {8, 7};
    Mesh mesh = simple::quad({-2, 0.9f, -2}, {0, 0, 4}, {4, 0, 0});
    mesh.material = std::uint32_t(scene.materials.size());
    scene.materials.push_back(material);
    Instance instance = scene.instances.front();
    instance.mesh = std::uint32_t(assets->meshes.size());
    instance.material = mesh.material;
    instance.toWorld = glm::mat4(1);
    instance.normalToWorld = glm::mat3(1);
    assets->meshes.push_back(mesh);
    scene.assets = assets;
    scene.instances.push_back(instance);
}

Result<void> write(const std::string& folder) {
    const Result<ImportedScene> imported = openAny("cornell", sourcePath("projects"));
    if (!imported)
        return tl::make_unexpected(imported.error());
    Scene scene = flatten(imported->document, imported->assets);
    scene.bake = {};
    scene.bake.surfels = 400;
    scene.bake.links = 16;
    scene.bake.rays = 64;
    scene.bake.lightmapCaches = 500;
    for (int k = 0; k < 4; ++k) {
        scene.lights = lightingOf(k % 3);
        if (k == 3)
            addSheet(scene);
        const TraceScene trace(scene);
        const Result<Bake> made = bake(trace);
        if (!made)
            return tl::make_unexpected(made.error());
        const auto baked = std::make_shared<const Bake>(*made);
        Relighter relighter(baked, LitBands::All);
        relighter.relight(scene, trace, 1000);
        const std::vector<glm::vec4>& lightmap = relighter.field().lightmap;
        const std::string name = fmt::format("{}/{}", folder, k + 1);
        const Result<std::string> file = transportFile({*baked, scene, nullptr, "test"});
        if (!file)
            return tl::make_unexpected(file.error());
        if (const Result<void> written = replaceFile(name + ".limnrt", *file); !written)
            return written;
        if (const Result<void> written = replaceFile(
                name + ".f32", std::string(reinterpret_cast<const char*>(lightmap.data()),
                                           lightmap.size() * sizeof(glm::vec4)));
            !written)
            return written;
    }
    return {};
}

} // namespace
} // namespace limn

int main(int count, char** arguments) {
    const limn::Result<void> written =
        count == 2 ? limn::write(arguments[1]) : limn::fail("usage: write_transports FOLDER");
    if (!written)
        fmt::print(stderr, "{}\n", written.error().message);
    return written ? 0 : 1;
}
