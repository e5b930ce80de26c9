// SPDX-License-Identifier: MIT
#include "engine/files/project_file.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/files/asset_file.h"
#include "engine/files/document_json.h"
#include "engine/files/sky_file.h"
#include "engine/scene/mesh/shape_mesh.h"
#include "engine/scene/origin.h"
#include "engine/scene/reach.h"
#include "engine/scene/surface/material_textures.h"

#include <filesystem>

#include <fmt/format.h>

namespace limn {

namespace fs = std::filesystem;

/// `file` relative to the project's folder; an empty path stays empty.
static Result<std::string> relativeTo(const std::string& project, const std::string& file) {
    if (file.empty())
        return std::string();
    std::error_code error;
    const fs::path folder = fs::absolute(project, error).parent_path();
    const fs::path relative = error ? fs::path() : fs::relative(fs::absolute(file), folder, error);
    if (error || relative.empty())
        return fail(fmt::format("cannot express {} relative to {}", file, folder.string()));
    return relative.generic_string();
}

/// Converts the world positions of an object from one origin to another.
static void moveOrigin(Object& object, const glm::dvec3& from, const glm::dvec3& to) {
    const auto move = [&](glm::vec3& p) { p = toWorld(to, toFile(from, p)); };
    if (Light* light = std::get_if<Light>(&object))
        move(light->position);
    if (Camera* camera = std::get_if<Camera>(&object))
        move(camera->eye), move(camera->target);
}

Result<void> saveProject(const std::string& path, const Document& document) {
    const Result<std::string> scene = relativeTo(path, document.scenePath);
    if (!scene)
        return fail(fmt::format("{}: scene: {}", path, scene.error().message));
    Document stored = document;
    stored.scenePath = *scene;
    stored.files = filesInUse(document);
    for (AssetFile& file : stored.files)
        if (!shapeOfPath(file.path)) {
            const Result<std::string> relative = relativeTo(path, file.path);
            if (!relative)
                return fail(fmt::format("{}: files: {}", path, relative.error().message));
            file.path = *relative;
        }
    for (auto& [id, object] : stored.objects) {
        if (stored.origin != glm::dvec3(0)) // rounds as the file does
            moveOrigin(object, stored.origin, stored.origin);
        if (Sky* sky = std::get_if<Sky>(&object)) {
            const Result<std::string> image = relativeTo(path, sky->image);
            if (!image)
                return fail(fmt::format("{}: sky: {}", path, image.error().message));
            sky->image = *image;
            sky->panorama = nullptr; // its file holds it
        }
    }
    // A project that cannot be loaded again must not replace one that can.
    const std::string text = documentToJson(stored);
    const Result<Document> again = documentFromJson(text);
    if (!again)
        return fail(fmt::format("{}: not saved: {}", path, again.error().message));
    if (!(*again == stored))
        return fail(fmt::format("{}: not saved: a name or path is not UTF-8", path));
    return replaceFile(path, text);
}

/// Removes meshes from `end` on, and the materials assigned to them. Returns how many.
static std::size_t dropLostMeshes(Node& node, std::size_t end) {
    Node kept = node;
    kept.meshes.clear();
    kept.materials.clear();
    for (std::size_t i = 0; i < node.meshes.size(); ++i)
        if (node.meshes[i] < end) {
            kept.meshes.push_back(node.meshes[i]);
            if (i < node.materials.size())
                kept.materials.push_back(node.materials[i]);
        }
    const std::size_t lost = node.meshes.size() - kept.meshes.size();
    node = std::move(kept);
    return lost;
}

/// Removes references to meshes and images that the scene no longer has.
static void dropLost(ImportedScene& scene) {
    std::size_t meshes = 0, images = 0;
    const auto lose = [&](TextureRef& texture) {
        if (texture.image >= 0 && std::size_t(texture.image) >= scene.assets->images.size()) {
            texture.image = -1;
            ++images;
        }
    };
    for (auto& [id, object] : scene.document.objects) {
        if (Node* node = std::get_if<Node>(&object))
            meshes += dropLostMeshes(*node, scene.assets->meshes.size());
        if (Material* material = std::get_if<Material>(&object))
            for (TextureRef* texture : texturesOf(*material))
                lose(*texture);
    }
    if (meshes)
        scene.repairs.push_back(
            fmt::format("{} meshes are no longer in the scene's files", meshes));
    if (images)
        scene.repairs.push_back(
            fmt::format("{} images are no longer in the scene's files", images));
}

/// Loads the sky's image relative to the project; if it cannot be read, the sky shows its colour.
static void openSky(const fs::path& folder, ImportedScene& scene, const MemoryBudget& memory) {
    for (auto& [id, object] : scene.document.objects) {
        Sky* sky = std::get_if<Sky>(&object);
        if (!sky || sky->image.empty())
            continue;
        sky->image = (folder / sky->image).lexically_normal().string();
        if (const Result<void> read = readSkyImage(*sky, memory); !read)
            scene.repairs.push_back("sky: " + read.error().message);
    }
}

Result<ImportedScene> loadProject(const std::string& path, const Progress& progress,
                                  const ImportOptions& options) {
    const Result<std::string> text = readFile(path);
    if (!text)
        return fail(fmt::format("{}: {}", path, text.error().message));
    Result<ProjectText> project = readProjectText(*text);
    if (!project)
        return fail(fmt::format("{}: {}", path, project.error().message));
    Document& document = project->document;

    ImportedScene scene;
    scene.assets = std::make_shared<const Assets>();
    if (!document.scenePath.empty()) {
        const fs::path folder = fs::path(path).parent_path();
        document.scenePath = (folder / document.scenePath).lexically_normal().string();
        Result<ImportedScene> imported = importGltf(document.scenePath, progress, options);
        if (!imported)
            return fail(fmt::format("{}: scene: {}", path, imported.error().message));
        scene = std::move(*imported);
    }
    if (!project->hasObjects)
        return scene;
    for (AssetFile& file : document.files)
        if (!shapeOfPath(file.path))
            file.path = (fs::path(path).parent_path() / file.path).lexically_normal().string();
    if (const Result<void> added = addAssetFiles(scene, document, progress, options); !added)
        return fail(fmt::format("{}: files: {}", path, added.error().message));
    if (document.sceneHash != scene.document.sceneHash)
        scene.repairs.push_back(
            "the scene file changed since the project was saved; its new geometry is used");
    document.sceneHash = scene.document.sceneHash;
    if (document.origin != scene.document.origin) // the scene moved, or the project is of old
        for (auto& [id, object] : document.objects)
            moveOrigin(object, document.origin, scene.document.origin);
    document.origin = scene.document.origin;
    scene.document = std::move(document);
    dropLost(scene);
    if (const std::string defect = reachDefect(flatten(scene.document, scene.assets));
        !defect.empty())
        return fail(fmt::format("{}: {}", path, defect));
    openSky(fs::path(path).parent_path(), scene, options.memory);
    return scene;
}

Result<ImportedScene> openAny(const std::string& what, const std::string& projectsFolder,
                              const Progress& progress, const ImportOptions& options) {
    std::error_code error;
    const std::string extension = fs::path(what).extension().string();
    if (extension == ".limn")
        return loadProject(what, progress, options);
    if (extension == ".gltf" || extension == ".glb" || fs::is_regular_file(what, error))
        return importGltf(what, progress, options);
    const fs::path folder(projectsFolder);
    // A sample's name must not contain a path out of the folder.
    if (!what.empty() && what.find('/') == std::string::npos && what[0] != '.')
        for (const fs::path& base : {folder / what, folder})
            for (const char* end : {".limn", ".gltf", ".glb"})
                if (const fs::path path = base / (what + end); fs::is_regular_file(path, error))
                    return openAny(path.string(), projectsFolder, progress, options);
    return fail(fmt::format("{}: neither a .gltf, .glb or .limn file nor a project in {}", what,
                            projectsFolder));
}

} // namespace limn
