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
#include "engine/scene/surface/material_textures.h"

#include <algorithm>
#include <array>
#include <map>
#include <new>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

namespace limn {

/// Extensions that are supported; any other one is reported as ignored.
static constexpr std::array<std::string_view, 10> kUsedExtensions = {
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform"};

namespace {

/// A primitive of the file and the result of reading it.
struct PrimitiveWork {
    std::size_t mesh = 0, primitive = 0;
    std::size_t part = 0; ///< in MeshesOfGltf::parts
    std::span<const double> weights;
    Mesh result;
    GltfRepairs repairs;
    std::string problem;
};

/// Materials whose textures need coordinates that a mesh lacks become others without these
/// textures.
struct MaterialsWithout {
    std::vector<Material>& materials;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
    GltfRepairs& repairs;

    /// Index of the material that the mesh can use in place of `index`.
    std::uint32_t usable(std::uint32_t index, const Mesh& mesh) {
        Material reduced = materials[index];
        std::uint32_t missing = 0;
        const auto textures = texturesOf(reduced);
        for (std::size_t k = 0; k < textures.size(); ++k)
            if (textures[k]->image >= 0 && mesh.uv(textures[k]->texCoord).empty()) {
                *textures[k] = TextureRef{};
                missing |= 1U << k;
            }
        if (missing == 0)
            return index;
        const auto [entry, isNew] =
            known.try_emplace({index, missing}, std::uint32_t(materials.size()));
        if (!isNew)
            return entry->second;
        // Without its texture, nobody knows how much of a surface is meant to shine.
        if (materials[index].emissiveTexture.image >= 0 && reduced.emissiveTexture.image < 0)
            reduced.emission = glm::vec3(0);
        repairs.sentences.push_back(
            fmt::format("textures of material '{}' left out where meshes lack their coordinates",
                        reduced.name));
        materials.push_back(std::move(reduced));
        return entry->second;
    }
};

PrimitiveUse useOf(const std::vector<Material>& materials, const tinygltf::Primitive& primitive,
                   std::span<const double> weights) {
    PrimitiveUse use{.uvSets = {}, .normalMapSet = {}, .morphWeights = weights};
    if (primitive.material < 0 || std::size_t(primitive.material) >= materials.size())
        return use;
    Material material = materials[std::size_t(primitive.material)];
    for (const TextureRef* texture : texturesOf(material))
        if (texture->image >= 0)
            use.uvSets.insert(texture->texCoord);
    if (material.normalTexture.image >= 0)
        use.normalMapSet = material.normalTexture.texCoord;
    return use;
}

/// Mesh parts for each glTF mesh, and for the morph weights of nodes that have others.
MeshesOfGltf partsOf(const tinygltf::Model& model, std::vector<PrimitiveWork>& works) {
    MeshesOfGltf meshes;
    std::map<std::pair<std::size_t, std::vector<double>>, std::uint32_t> known;
    const auto partOf = [&](std::size_t mesh, const std::vector<double>& weights) {
        const auto [entry, isNew] =
            known.try_emplace({mesh, weights}, std::uint32_t(meshes.parts.size()));
        if (isNew) {
            for (std::size_t p = 0; p < model.meshes[mesh].primitives.size(); ++p)
                works.push_back({mesh, p, meshes.parts.size(), weights, {}, {}, {}});
            meshes.parts.emplace_back();
        }
        return entry->second;
    };
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        partOf(m, model.meshes[m].weights);
    for (const tinygltf::Node& node : model.nodes) {
        const bool hasMesh = node.mesh >= 0 && std::size_t(node.mesh) < model.meshes.size();
        const auto mesh = hasMesh ? std::size_t(node.mesh) : 0;
        meshes.partsOfNode.push_back(
            !hasMesh
                ? 0
                : partOf(mesh, node.weights.empty() ? model.meshes[mesh].weights : node.weights));
    }
    return meshes;
}

} // namespace

static void convert(const tinygltf::Model& model, const std::vector<Material>& materials,
                    PrimitiveWork& work) {
    const tinygltf::Mesh& mesh = model.meshes[work.mesh];
    const tinygltf::Primitive& primitive = mesh.primitives[work.primitive];
    Result<Mesh> read =
        readPrimitive(model, primitive, useOf(materials, primitive, work.weights), work.repairs);
    if (!read) {
        work.problem = fmt::format("meshes[{}].primitives[{}].{}", work.mesh, work.primitive,
                                   read.error().message);
        return;
    }
    work.result = std::move(*read);
    work.result.name = mesh.name.empty() ? fmt::format("Mesh {}", work.mesh) : mesh.name;
    if (mesh.primitives.size() > 1)
        work.result.name += fmt::format(" {}", work.primitive);
}

/// Fills `out` with the drawable primitives and returns which nodes have which.
static Result<MeshesOfGltf> readMeshes(const tinygltf::Model& model,
                                       std::vector<Material>& materials, const Progress& progress,
                                       std::vector<Mesh>& out, GltfRepairs& repairs) {
    std::vector<PrimitiveWork> works;
    MeshesOfGltf meshes = partsOf(model, works);
    const bool done = parallelRanges(works.size(), 1, progress, "meshes",
                                     [&](std::size_t begin, std::size_t end) {
                                         for (std::size_t i = begin; i < end; ++i)
                                             convert(model, materials, works[i]);
                                     });
    if (!done)
        return fail("cancelled");
    std::optional<std::uint32_t> plain;
    MaterialsWithout usable{materials, {}, repairs};
    for (PrimitiveWork& work : works) {
        if (!work.problem.empty())
            return fail(work.problem);
        repairs.merge(work.repairs);
        if (work.result.indices.empty())
            continue;
        const int material = model.meshes[work.mesh].primitives[work.primitive].material;
        if (material >= 0 && std::size_t(material) < model.materials.size()) {
            work.result.material = usable.usable(std::uint32_t(material), work.result);
        } else {
            if (!plain) {
                plain = std::uint32_t(materials.size());
                materials.emplace_back();
                materials.back().name = "Default";
            }
            work.result.material = *plain;
        }
        meshes.parts[work.part].push_back(std::uint32_t(out.size()));
        out.push_back(std::move(work.result));
    }
    return meshes;
}

static void reportUnused(const tinygltf::Model& model, GltfRepairs& repairs) {
    for (const std::string& name : model.extensionsUsed)
        if (std::ranges::find(kUsedExtensions, name) == kUsedExtensions.end())
            repairs.sentences.push_back(fmt::format("extension {} is ignored", name));
    repairs.add("animations left out", model.animations.size());
}

/// Surfaces whose emissive texture is missing do not shine as if it were white.
static void darkenWithout(const std::vector<std::uint32_t>& images, Document& document) {
    for (auto& [id, object] : document.objects)
        if (auto* material = std::get_if<Material>(&object);
            material && std::ranges::count(images, material->emissiveTexture.image) > 0)
            material->emission = glm::vec3(0);
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
    DecodedImages decoded = decodeImages(*file, progress, repairs);
    assets->images = std::move(decoded.images);
    darkenWithout(decoded.missing, scene.document);
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
