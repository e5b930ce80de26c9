// SPDX-License-Identifier: MIT
#include "app/bench/front_scene.h"

#include "app/program_version.h"

#include "engine/core/hash.h"
#include "engine/files/image_file.h"
#include "engine/files/project_file.h"
#include "engine/scene/mesh/input_hash.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

/// Hash of a document and its assets: all that light depends on.
std::uint64_t contentHash(const ImportedScene& imported, const Scene& scene) {
    const std::string json = documentToJson(imported.document);
    std::uint64_t hash = hashBytes(json.data(), json.size());
    hash = hashVector(hashMeshes(scene), hash);
    for (const Image& image : imported.assets->images)
        hash = hashVector(image.rgba, hash);
    return scene.sky.panorama ? hashVector(scene.sky.panorama->pixels.rgb, hash) : hash;
}

std::string partPath(const std::string& folder, const std::string& key, std::size_t k) {
    return fmt::format("{}/reference-{}-{}.exr", folder, hexHash(hashBytes(key.data(), key.size())),
                       k);
}

/// The reference that an earlier run kept, if all of its parts are there.
std::optional<ReferenceSet> keptReference(const std::string& folder, const FrontScene& front) {
    ReferenceSet set{.samplesPerPixel = front.view.samplesPerPixel, .passes = 1};
    for (std::size_t k = 0; k < set.parts.size(); ++k) {
        Result<ImageF> part = readFloatImage(partPath(folder, front.key, k));
        if (!part || part->width != front.view.width || part->height != front.view.height)
            return {};
        set.parts[k] = std::move(*part);
    }
    return set;
}

/// Makes every surface half a metal of its own colour. The other half is diffuse, so that light
/// bounces on.
void makeGlossy(Scene& scene, float roughness) {
    for (Material& material : scene.materials) {
        material.metallic = 0.5f;
        material.roughness = roughness;
        material.metallicRoughnessTexture = {};
    }
}

} // namespace

Result<FrontScene> openFrontScene(const SceneOptions& options, const FrontView& view,
                                  const std::string& folder, const Progress& progress) {
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    FrontScene front{.name = std::filesystem::path(options.scene).stem().string(),
                     .scene = flatten(imported->document, imported->assets)};
    const Result<Camera> camera = chooseCamera(front.scene, view.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    if (view.glossy)
        makeGlossy(front.scene, *view.glossy);
    front.trace = std::make_unique<TraceScene>(front.scene);
    front.view = {.view = view.glossy ? View::Lit : View::Irradiance,
                  .camera = *camera,
                  .width = view.camera.width,
                  .height = view.camera.height,
                  .samplesPerPixel = std::max(view.samplesPerPixel / 2, 1U)};
    const Camera& c = *camera;
    front.key = fmt::format(
        "{}; scene {}; glossy {}; eye {} {} {}, target {} {} {}, up {} {} {}, fov {}; {} x {}, {} "
        "samples",
        programVersion(), hexHash(contentHash(*imported, front.scene)),
        view.glossy ? fmt::format("{}", *view.glossy) : "none", c.eye.x, c.eye.y, c.eye.z,
        c.target.x, c.target.y, c.target.z, c.up.x, c.up.y, c.up.z, c.fovY, front.view.width,
        front.view.height, view.samplesPerPixel);
    if (std::optional<ReferenceSet> kept = keptReference(folder, front)) {
        front.truth = std::move(*kept);
        return front;
    }
    std::optional<ReferenceSet> made = renderReferenceSet(*front.trace, front.view, progress);
    if (!made)
        return fail("cancelled");
    front.truth = std::move(*made);
    if (meanOf(front.truth.first()) <= 0)
        return fail(
            fmt::format("{}: the camera sees no light, so no error is known", options.scene));
    for (std::size_t k = 0; k < front.truth.parts.size(); ++k)
        if (const Result<void> written =
                writeExr(partPath(folder, front.key, k), front.truth.parts[k]);
            !written)
            return tl::make_unexpected(written.error());
    return front;
}

} // namespace limn
