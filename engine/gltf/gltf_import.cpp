// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_import.h"

#include "engine/core/parallel.h"
#include "engine/gltf/gltf_file.h"
#include "engine/gltf/gltf_image.h"
#include "engine/gltf/gltf_material.h"
#include "engine/gltf/gltf_mesh.h"
#include "engine/gltf/gltf_nodes.h"
#include "engine/gltf/gltf_size.h"
#include "engine/scene/reach.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace limn {

/// Extensions that are supported; any other one is reported as ignored.
static constexpr std::array<std::string_view, 8> kUsedExtensions = {
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual",        "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_transmission", "KHR_materials_volume",
    "KHR_mesh_quantization",   "KHR_texture_transform"};

namespace {

/// A primitive of the file and the result of reading it.
struct PrimitiveWork {
    std::size_t mesh = 0, primitive = 0;
    Mesh result;
    GltfRepairs repairs;
    std::string problem;
};

} // namespace

static void convert(const tinygltf::Model& model, const std::vector<Material>& materials,
                    PrimitiveWork& work) {
    const tinygltf::Mesh& mesh = model.meshes[work.mesh];
    const tinygltf::Primitive& primitive = mesh.primitives[work.primitive];
    const bool hasMaterial =
        primitive.material >= 0 && std::size_t(primitive.material) < materials.size();
    const bool normalMapped =
        hasMaterial && materials[std::size_t(primitive.material)].normalTexture.image >= 0;
    Result<Mesh> read = readPrimitive(model, primitive, normalMapped, work.repairs);
    if (!read) {
        work.problem = fmt::format("meshes[{}].primitives[{}].{}", work.mesh, work.primitive,
                                   read.error().message);
        return;
    }
    work.result = std::move(*read);
    work.result.name = mesh.name.empty() ? fmt::format("Mesh {}", work.mesh) : mesh.name;
    if (mesh.primitives.size() > 1)
        work.result.name += fmt::format(" {}", work.primitive);
    work.result.material =
        hasMaterial ? std::uint32_t(primitive.material) : std::uint32_t(materials.size());
}

/// Fills `out` with the drawable primitives and returns which glTF mesh has which.
static Result<MeshesOfGltf> readMeshes(const tinygltf::Model& model,
                                       std::vector<Material>& materials, const Progress& progress,
                                       std::vector<Mesh>& out, GltfRepairs& repairs) {
    std::vector<PrimitiveWork> works;
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p)
            works.push_back({m, p, {}, {}, {}});
    const bool done = parallelRanges(works.size(), 1, progress, "meshes",
                                     [&](std::size_t begin, std::size_t end) {
                                         for (std::size_t i = begin; i < end; ++i)
                                             convert(model, materials, works[i]);
                                     });
    if (!done)
        return fail("cancelled");
    MeshesOfGltf meshes(model.meshes.size());
    bool plain = false;
    for (PrimitiveWork& work : works) {
        if (!work.problem.empty())
            return fail(work.problem);
        repairs.merge(work.repairs);
        if (work.result.indices.empty())
            continue;
        plain = plain || work.result.material == materials.size();
        meshes[work.mesh].push_back(std::uint32_t(out.size()));
        out.push_back(std::move(work.result));
    }
    if (plain) {
        materials.emplace_back();
        materials.back().name = "Default";
    }
    return meshes;
}

static void reportUnused(const tinygltf::Model& model, GltfRepairs& repairs) {
    for (const std::string& name : model.extensionsUsed)
        if (std::ranges::find(kUsedExtensions, name) == kUsedExtensions.end())
            repairs.sentences.push_back(fmt::format("extension {} is ignored", name));
    repairs.add("animations left out", model.animations.size());
}

static Result<ImportedScene> import(const std::string& path, const Progress& progress,
                                    const ImportOptions& options) {
    progress.at("read", 0);
    Result<GltfFile> file = readGltfFile(path, options.reach, options.memory);
    if (!file)
        return tl::make_unexpected(file.error());
    if (const Result<void> fits = checkGltfSize(*file, options.memory); !fits)
        return tl::make_unexpected(fits.error());
    const tinygltf::Model& model = file->model;
    GltfRepairs repairs;
    reportUnused(model, repairs);
    std::vector<Material> materials;
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        materials.push_back(readMaterial(model, i, repairs));

    auto assets = std::make_shared<Assets>();
    const Result<MeshesOfGltf> meshes =
        readMeshes(model, materials, progress, assets->meshes, repairs);
    if (!meshes)
        return tl::make_unexpected(meshes.error());

    ImportedScene scene;
    scene.document.scenePath = path;
    scene.document.sceneHash = file->hash;
    for (const Material& material : materials) // first: Mesh::material is their order of id
        addObject(scene.document, material);
    if (const Result<void> added =
            addNodes(scene.document, model, *meshes, assets->meshes, repairs);
        !added)
        return tl::make_unexpected(added.error());
    addObject(scene.document, Sky{});
    addObject(scene.document, BakeSettings{});

    if (const std::string defect = reachDefect(flatten(scene.document, assets)); !defect.empty())
        return fail(defect);
    assets->images = decodeImages(*file, progress, repairs);
    if (progress.cancelled())
        return fail("cancelled");
    scene.assets = std::move(assets);
    scene.repairs = repairs.lines();
    return scene;
}

Result<ImportedScene> importGltf(const std::string& path, const Progress& progress,
                                 const ImportOptions& options) {
    Result<ImportedScene> scene;
    try {
        scene = import(path, progress, options);
    } catch (const std::bad_alloc&) { // sizes that a file claims are checked; this is the last line
        scene = fail("needs more memory than there is");
    }
    if (!scene)
        return fail(fmt::format("{}: {}", path, scene.error().message));
    return scene;
}

} // namespace limn
