// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_import.h"

#include "engine/core/parallel.h"
#include "engine/gltf/gltf_animation.h"
#include "engine/gltf/gltf_backs.h"
#include "engine/gltf/gltf_extensions.h"
#include "engine/gltf/gltf_file.h"
#include "engine/gltf/gltf_image.h"
#include "engine/gltf/gltf_material.h"
#include "engine/gltf/gltf_mesh.h"
#include "engine/gltf/gltf_nodes.h"
#include "engine/gltf/gltf_profiles.h"
#include "engine/gltf/gltf_size.h"
#include "engine/scene/reach.h"
#include "engine/scene/surface/material_textures.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <new>
#include <optional>
#include <span>
#include <tuple>

#include <fmt/format.h>

namespace limn {

namespace {

/// A primitive of the file and the result of reading it.
struct PrimitiveWork {
    std::size_t mesh = 0, primitive = 0;
    std::size_t part = 0; ///< in MeshesOfGltf::parts
    std::span<const double> weights;
    const SkinPose* skin = nullptr;
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
                   std::span<const double> weights, const SkinPose* skin) {
    PrimitiveUse use{.uvSets = {}, .normalMapSet = {}, .morphWeights = weights, .skin = skin};
    if (primitive.material < 0 || std::size_t(primitive.material) >= materials.size())
        return use;
    const Material& material = materials[std::size_t(primitive.material)];
    use.uvSets = uvSetsOf(material);
    if (material.normalTexture.image >= 0)
        use.normalMapSet = material.normalTexture.texCoord;
    return use;
}

/// What nodes make of a glTF mesh: morph weights and a skin.
struct MeshUse {
    const std::vector<double>* weights;
    int skin = -1;

    auto key(std::size_t mesh) const { return std::tuple(mesh, *weights, skin); }
};

MeshUse meshUse(const tinygltf::Model& model, const tinygltf::Node& node) {
    const bool isSkinned = node.skin >= 0 && std::size_t(node.skin) < model.skins.size();
    return {node.weights.empty() ? &model.meshes[std::size_t(node.mesh)].weights : &node.weights,
            isSkinned ? node.skin : -1};
}

/// Mesh parts for each glTF mesh as the first node uses it, then for nodes that use it in other
/// ways. Adds what is to be read of each to `works`.
MeshesOfGltf partsOf(const tinygltf::Model& model, const std::vector<SkinPose>& skins,
                     std::vector<PrimitiveWork>& works) {
    MeshesOfGltf meshes;
    std::map<std::tuple<std::size_t, std::vector<double>, int>, std::uint32_t> known;
    const auto partOf = [&](std::size_t mesh, const MeshUse& use, const SkinPose* skin) {
        const auto [entry, isNew] =
            known.try_emplace(use.key(mesh), std::uint32_t(meshes.parts.size()));
        if (isNew) {
            for (std::size_t p = 0; p < model.meshes[mesh].primitives.size(); ++p)
                works.push_back({mesh, p, meshes.parts.size(), *use.weights, skin, {}, {}, {}});
            meshes.parts.emplace_back();
        }
        return entry->second;
    };
    const auto hasMesh = [&](std::size_t n) {
        return model.nodes[n].mesh >= 0 && std::size_t(model.nodes[n].mesh) < model.meshes.size();
    };
    const auto partOfNode = [&](std::size_t n) {
        const MeshUse use = meshUse(model, model.nodes[n]);
        return partOf(std::size_t(model.nodes[n].mesh), use, use.skin >= 0 ? &skins[n] : nullptr);
    };
    std::vector<std::optional<std::size_t>> firstNode(model.meshes.size());
    for (std::size_t n = model.nodes.size(); n-- > 0;)
        if (hasMesh(n))
            firstNode[std::size_t(model.nodes[n].mesh)] = n;
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        if (firstNode[m])
            partOfNode(*firstNode[m]);
        else
            partOf(m, {&model.meshes[m].weights, -1}, nullptr);
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
        meshes.partsOfNode.push_back(hasMesh(n) ? partOfNode(n) : 0);
    return meshes;
}

} // namespace

static void convert(const tinygltf::Model& model, const std::vector<Material>& materials,
                    PrimitiveWork& work) {
    const tinygltf::Mesh& mesh = model.meshes[work.mesh];
    const tinygltf::Primitive& primitive = mesh.primitives[work.primitive];
    Result<Mesh> read = readPrimitive(
        model, primitive, useOf(materials, primitive, work.weights, work.skin), work.repairs);
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
                                       const std::vector<SkinPose>& skins,
                                       std::vector<Material>& materials, const Progress& progress,
                                       std::vector<Mesh>& out, GltfRepairs& repairs) {
    std::vector<PrimitiveWork> works;
    MeshesOfGltf meshes = partsOf(model, skins, works);
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
        if (const GltfExtension* known = findGltfExtension(name); !known || !known->isRead)
            repairs.sentences.push_back(fmt::format("extension {} is ignored{}{}", name,
                                                    known && !known->leftOut.empty() ? ": " : "",
                                                    known ? known->leftOut : ""));
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
    GltfRepairs repairs;
    if (!options.seconds)
        repairs.add("animations left out, which --time shows", file->model.animations.size());
    else if (const Result<void> posed = poseAt(file->model, *options.seconds, repairs); !posed)
        return tl::make_unexpected(posed.error());
    const tinygltf::Model& model = file->model;
    reportUnused(model, repairs);
    const Result<std::vector<SkinPose>> skins = skinPoses(model);
    if (!skins)
        return tl::make_unexpected(skins.error());
    std::vector<Material> materials;
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        materials.push_back(readMaterial(model, i, repairs));

    auto assets = std::make_shared<Assets>();
    Result<MeshesOfGltf> meshes =
        readMeshes(model, *skins, materials, progress, assets->meshes, repairs);
    if (!meshes)
        return tl::make_unexpected(meshes.error());
    if (options.joinsBacks)
        repairs.add("pairs of triangles back to back made two-sided",
                    joinBacks(meshes->parts, assets->meshes, materials));

    ImportedScene scene;
    scene.document.scenePath = path;
    scene.document.sceneHash = file->hash;
    for (const Material& material : materials) // first: Mesh::material is their order of id
        addObject(scene.document, material);
    const std::vector<ProfileRef> profiles = readProfiles(
        model, std::filesystem::path(path).parent_path().string(), options.reach, repairs);
    const Result<NodesOfGltf> nodes =
        addNodes(scene.document, model, *meshes, *skins, profiles, assets->meshes, repairs);
    if (!nodes)
        return tl::make_unexpected(nodes.error());
    const Result<std::shared_ptr<const SceneAnimation>> animation =
        readAnimation(model, scene.document, *nodes);
    if (animation)
        scene.animation = *animation;
    else
        repairs.sentences.push_back(animation.error().message + "; nothing moves");
    addObject(scene.document, Sky{});
    addObject(scene.document, BakeSettings{});

    if (const std::string defect = reachDefect(flatten(scene.document, assets)); !defect.empty())
        return fail(defect);
    Result<DecodedImages> decoded = decodeImages(*file, progress, repairs);
    if (!decoded)
        return tl::make_unexpected(decoded.error());
    assets->images = std::move(decoded->images);
    darkenWithout(decoded->missing, scene.document);
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
