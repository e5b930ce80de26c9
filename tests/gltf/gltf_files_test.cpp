// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_import.h"
#include "tests/core/source_path.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

namespace limn::gltf_files_test {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = sourcePath("../shared/scenes");

std::vector<fs::path> gltfFilesUnder(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

bool allFinite(const std::vector<glm::vec3>& values) {
    return std::ranges::all_of(values, [](glm::vec3 v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    });
}

/// What mesh.h and document.h promise of everything that imports.
void expectGuarantees(const ImportedScene& scene, const std::string& file) {
    for (const Mesh& mesh : scene.assets->meshes) {
        const std::size_t count = mesh.positions.size();
        EXPECT_TRUE(allFinite(mesh.positions) && allFinite(mesh.normals)) << file;
        EXPECT_GT(mesh.indices.size(), 0u) << file;
        EXPECT_EQ(mesh.indices.size() % 3, 0u) << file;
        EXPECT_TRUE(std::ranges::all_of(mesh.indices, [&](auto i) { return i < count; })) << file;
        EXPECT_EQ(mesh.normals.size(), count) << file;
        for (const std::size_t size :
             {mesh.tangents.size(), mesh.uv0.size(), mesh.uv1.size(), mesh.colors.size()})
            EXPECT_TRUE(size == 0 || size == count) << file;
        for (const glm::vec3& n : mesh.normals)
            ASSERT_NEAR(n.x * n.x + n.y * n.y + n.z * n.z, 1, 1e-5) << file;
    }
    for (const Image& image : scene.assets->images)
        EXPECT_EQ(image.rgba.size(), std::size_t(image.width) * image.height * 4) << file;
    const Scene flat = flatten(scene.document, scene.assets);
    for (const Instance& instance : flat.instances)
        EXPECT_LT(instance.material, flat.materials.size()) << file;
    EXPECT_TRUE(allFinite({flat.bounds.lower, flat.bounds.upper})) << file;
    const Camera camera = chooseCamera(flat, {});
    EXPECT_TRUE(allFinite({camera.eye, camera.target, camera.up})) << file;
}

class SceneFiles : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(kScenes / "INDEX.md"))
            GTEST_SKIP() << "the shared scenes are not here";
    }
};

TEST_F(SceneFiles, EveryFeatureSceneImportsOrNamesWhatItRequires) {
    const std::map<std::string, std::string> refused = {
        {"Compatibility_04.gltf", "asset.minVersion"},
        {"Compatibility_05.gltf", "FAKE_materials_quantumRendering"}};
    const std::vector<fs::path> files = gltfFilesUnder(kScenes / "features");
    EXPECT_GT(files.size(), 80u);
    for (const fs::path& file : files) {
        const Result<ImportedScene> scene = importGltf(file.string());
        const auto reason = refused.find(file.filename().string());
        EXPECT_EQ(bool(scene), reason == refused.end())
            << file << (scene ? "" : ": " + scene.error().message);
        if (scene) {
            expectGuarantees(*scene, file.string());
        } else if (reason != refused.end()) {
            EXPECT_NE(scene.error().message.find(reason->second), std::string::npos)
                << scene.error().message;
        }
    }
}

TEST_F(SceneFiles, EveryIndexedSceneHasTheTrianglesOfTheIndexUpToRepairs) {
    struct Expected {
        const char* file;
        std::size_t triangles; ///< of INDEX.md, before any are removed
        std::size_t removed;   ///< degenerate ones, and backs of others
        std::size_t cameras, images;
    };
    const Expected all[] = {{"sponza-crytek/Sponza.gltf", 262267, 1 + 8, 0, 69},
                            {"living-room/living-room.gltf", 143163, 190, 1, 5},
                            {"staircase/staircase.gltf", 262663, 155, 1, 9},
                            {"godot-living-room/living_room.glb", 5088, 3537 + 10, 0, 0},
                            {"godot-room/room.glb", 63720, 0, 0, 0},
                            {"bevy-mixed-lighting/MixedLightingExample.gltf", 40898, 0, 0, 8},
                            {"cornell/bevy-cornell/CornellBox.glb", 36, 0, 0, 0},
                            {"cornell/babylon-cornell/cornellBox.glb", 4006, 0, 1, 0},
                            {"cornell/kajiya-cornell/scene.gltf", 32, 0, 0, 0},
                            {"cornell/fazil-cornell/cornell-box.glb", 1040, 0, 0, 0},
                            {"cornell/nvpro-cornell/cornellBox.gltf", 16732, 380, 1, 0}};
    for (const Expected& expected : all) {
        const Result<ImportedScene> scene = importGltf((kScenes / expected.file).string());
        ASSERT_TRUE(scene) << scene.error().message;
        expectGuarantees(*scene, expected.file);
        const Scene flat = flatten(scene->document, scene->assets);
        std::size_t triangles = 0;
        for (const Instance& instance : flat.instances)
            triangles += flat.meshOf(instance).triangleCount();
        EXPECT_EQ(triangles, expected.triangles - expected.removed) << expected.file;
        EXPECT_EQ(flat.cameras.size(), expected.cameras) << expected.file;
        EXPECT_EQ(scene->assets->images.size(), expected.images) << expected.file;
    }
}

TEST_F(SceneFiles, EveryObjectImports) {
    for (const fs::path& file : gltfFilesUnder(kScenes / "objects")) {
        const Result<ImportedScene> scene = importGltf(file.string());
        ASSERT_TRUE(scene) << scene.error().message;
        expectGuarantees(*scene, file.string());
    }
}

TEST_F(SceneFiles, InvalidFilesEndInASceneOrAReasonThatNamesThem) {
    const std::vector<fs::path> files = gltfFilesUnder(kScenes / "invalid");
    EXPECT_GT(files.size(), 250u);
    for (const fs::path& file : files) {
        const Result<ImportedScene> scene = importGltf(file.string());
        if (scene) {
            expectGuarantees(*scene, file.string());
        } else {
            EXPECT_EQ(scene.error().message.find(file.string() + ": "), 0u)
                << scene.error().message;
        }
        EXPECT_TRUE(scene || scene.error().message.find('\n') == std::string::npos) << file;
    }
}

TEST_F(SceneFiles, ClearCasesAreRefusedForTheirReason) {
    const std::map<std::string, std::string> refused = {
        {"assimp/IndexOutOfRange/IndexOutOfRange.gltf", "element 0 is 255"},
        {"assimp/MissingBin/BoxTextured.gltf", "buffers[0].uri"},
        {"assimp/RecursiveNodes/RecursiveNodes.gltf", "its own ancestor"},
        {"assimp/TestNoRootNode/NoScene.gltf", "scene: index 0"},
        {"assimp/wrongTypes/badArray.gltf", "meshes[0].primitives: not an array"},
        {"assimp/wrongTypes/badString.gltf", "scenes[0].name: not a string"},
        {"gltf-validator/base/data/json/invalid_syntax.gltf", "JSON"},
        {"gltf-validator/base/data/json/empty_file.gltf", "empty"},
        {"gltf-validator/base/data/glb/truncated_chunk_data.glb", "GLB"},
        {"gltf-validator/base/data/asset/1_0_version.gltf", "glTF 1.0"},
        {"gltf-validator/base/data/node/node_loop.gltf", "its own ancestor"},
        {"gltf-validator/base/data/node/unresolved_mesh.gltf", "nodes[0].mesh"}};
    for (const auto& [file, reason] : refused) {
        const Result<ImportedScene> scene = importGltf((kScenes / "invalid" / file).string());
        ASSERT_FALSE(scene) << file;
        EXPECT_NE(scene.error().message.find(reason), std::string::npos) << scene.error().message;
    }
}

TEST_F(SceneFiles, TheDefaultViewOfSponzaIsInsideItsHall) {
    const Result<ImportedScene> scene =
        importGltf((kScenes / "sponza-crytek/Sponza.gltf").string());
    ASSERT_TRUE(scene);
    const Scene flat = flatten(scene->document, scene->assets);
    const Camera camera = chooseCamera(flat, {});
    EXPECT_TRUE(camera.eye.x < flat.bounds.upper.x && camera.eye.x > flat.bounds.lower.x);
    EXPECT_NEAR(camera.eye.z, flat.bounds.centre().z, 0.1);
    EXPECT_GT(std::abs(camera.target.x - camera.eye.x), 10) << "along the hall";
}

} // namespace
} // namespace limn::gltf_files_test
