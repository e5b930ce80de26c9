// SPDX-License-Identifier: MIT
#include "engine/files/project_file.h"

#include "engine/files/asset_file.h"
#include "engine/files/image_file.h"
#include "engine/files/sky_file.h"
#include "tests/core/temporary_folder.h"
#include "tests/gltf/gltf_builder.h"

#include <limits>

#include <gtest/gtest.h>

namespace limn::project_file_test {
namespace {

namespace fs = std::filesystem;

/// A folder with models/scene.glb: one triangle, one node.
struct Workspace : TemporaryFolder {
    Workspace() {
        fs::create_directories(path / "models");
        fs::create_directories(path / "projects");
        writeFile(scene(), triangleScene().glb());
    }
    std::string scene() const { return file("models/scene.glb"); }
};

TEST(ProjectFile, WhatIsSavedIsLoaded) {
    const Workspace w;
    ImportedScene scene = *importGltf(w.scene());
    Light light;
    light.strength = 0.1f;
    addObject(scene.document, light);
    std::get<Sky>(scene.document.objects.rbegin()->second = Sky{}).radiance = {1, 2, 3};
    const std::string project = w.file("projects/p.limn");
    const Result<void> saved = saveProject(project, scene.document);
    ASSERT_TRUE(saved) << saved.error().message;
    const Result<ImportedScene> loaded = loadProject(project);
    ASSERT_TRUE(loaded) << loaded.error().message;
    Document expected = scene.document;
    expected.scenePath = loaded->document.scenePath; // another spelling of the same file
    EXPECT_TRUE(fs::equivalent(expected.scenePath, w.scene()));
    EXPECT_TRUE(loaded->document == expected);
    EXPECT_EQ(loaded->assets->meshes.size(), 1u);
    EXPECT_FALSE(hasRepair(*loaded, "changed"));
}

/// The triangle with its node at x = `at`.
std::string triangleAt(double at) {
    GltfBuilder b = triangleScene();
    b.json["nodes"][0]["translation"] = {at, 0, 0};
    return b.glb();
}

/// The number after `name` of the only light in a project.
double storedX(const std::string& project, const char* kind, const char* name) {
    const auto json = nlohmann::json::parse(fileBytes(project));
    for (const auto& entry : json["objects"])
        if (entry.contains(kind))
            return entry[kind][name][0].get<double>();
    return 0;
}

TEST(ProjectFile, PlacesFarAwayAreStoredInTheFilesCoordinates) {
    const Workspace w;
    writeFile(w.scene(), triangleAt(1e6));
    ImportedScene scene = *importGltf(w.scene());
    ASSERT_EQ(scene.document.origin, glm::dvec3(1e6, 0, 0));
    addObject(scene.document, Light{.position = {0.3f, 1e-7f, 0}});
    addObject(scene.document, Camera{.eye = {-0.1f, 1, 2}, .target = {-0.1f, 1, 1.9f}});
    for (auto& [id, object] : scene.document.objects)
        if (Node* node = std::get_if<Node>(&object))
            node->transform.translation.x += 0.125;
    const std::string project = w.file("projects/p.limn");
    const Result<void> saved = saveProject(project, scene.document);
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_NEAR(storedX(project, "light", "position"), 1e6 + 0.3, 1e-7);
    EXPECT_NEAR(storedX(project, "camera", "eye"), 1e6 - 0.1, 1e-7);
    const Result<ImportedScene> loaded = loadProject(project);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->document.origin, scene.document.origin);
    EXPECT_TRUE(loaded->document.objects == scene.document.objects);

    writeFile(w.scene(), triangleAt(3e6));
    const Result<ImportedScene> moved = loadProject(project);
    ASSERT_TRUE(moved) << moved.error().message;
    EXPECT_EQ(moved->document.origin, glm::dvec3(3e6, 0, 0)) << "is that of the new file";
    const Scene flat = flatten(moved->document, moved->assets);
    EXPECT_NEAR(flat.lights.at(0).position.x, -2e6f, 0.25f) << "edits stay where they were";
    EXPECT_EQ(flat.instances.at(0).toWorld[3].x, -2e6f + 0.125f);
}

// A tenth of a micrometre is lost where doubles are that far apart; the project is saved anyway.
TEST(ProjectFile, PlacesThatDoublesRoundAreSavedToo) {
    const Workspace w;
    writeFile(w.scene(), triangleAt(1e11));
    ImportedScene scene = *importGltf(w.scene());
    ASSERT_EQ(scene.document.origin, glm::dvec3(1e11, 0, 0));
    addObject(scene.document, Light{.position = {1e-7f, 0.1f, 0.7f}});
    const Result<void> saved = saveProject(w.file("projects/p.limn"), scene.document);
    EXPECT_TRUE(saved) << saved.error().message;
}

// As of projects that are written by hand, or were saved before "origin" was.
TEST(ProjectFile, WithoutAnOriginPlacesAreInTheFilesCoordinatesAllTheSame) {
    const Workspace w;
    writeFile(w.scene(), triangleAt(1e6));
    writeFile(w.file("p.limn"), R"({"version": 1, "scene": "models/scene.glb", "objects": [
        {"id": 1, "light": {"position": [1000002, 0.5, 0]}}]})");
    const Result<ImportedScene> loaded = loadProject(w.file("p.limn"));
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Scene scene = flatten(loaded->document, loaded->assets);
    EXPECT_EQ(scene.lights.at(0).position, glm::vec3(2, 0.5f, 0));
}

/// Adds a file's assets to a scene, as the editor does.
AddedAssets add(ImportedScene& scene, const std::string& path) {
    Result<AddedAssets> added = addAssetFile(*scene.assets, path);
    EXPECT_TRUE(added) << added.error().message;
    scene.assets = added->assets;
    scene.document.files.push_back(added->file);
    return std::move(*added);
}

TEST(ProjectFile, FilesThatWereAddedAreReadAgain) {
    const Workspace w;
    writeFile(w.file("models/other.glb"), triangleScene().glb());
    ASSERT_TRUE(writePng(w.file("models/red.png"), {"", 1, 1, {255, 0, 0, 255}}));
    ImportedScene scene = *importGltf(w.scene());
    add(scene, w.file("models/other.glb")); // nothing refers to it
    const AssetFile box = add(scene, "shape:box").file;
    const AssetFile red = add(scene, w.file("models/red.png")).file;
    Material paint{.name = "paint"};
    paint.baseColorTexture.image = std::int32_t(red.firstImage);
    const ObjectId material = addObject(scene.document, paint);
    addObject(scene.document,
              Node{.name = "block", .meshes = {0, box.firstMesh}, .materials = {0, material}});
    const std::string project = w.file("projects/p.limn");
    const Result<void> saved = saveProject(project, scene.document);
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_EQ(fileBytes(project).find("other.glb"), std::string::npos);
    EXPECT_NE(fileBytes(project).find("\"../models/red.png\""), std::string::npos);

    const Result<ImportedScene> loaded = loadProject(project);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_FALSE(hasRepair(*loaded, "no longer"));
    EXPECT_FALSE(hasRepair(*loaded, "white"));
    const Scene flat = flatten(loaded->document, loaded->assets);
    const Instance& block = flat.instances.back();
    EXPECT_EQ(flat.meshOf(block).name, "Box");
    EXPECT_EQ(flat.materialOf(block).name, "paint");
    EXPECT_EQ(sampleTexture(*flat.assets, flat.materialOf(block).baseColorTexture, {0, 0}, true),
              glm::vec4(1, 0, 0, 1));
    // What is saved again is what was loaded.
    ASSERT_TRUE(saveProject(w.file("projects/q.limn"), loaded->document));
    EXPECT_TRUE(loadProject(w.file("projects/q.limn"))->document == loaded->document);
}

TEST(ProjectFile, AddedMeshesAreFoundWhereTheSceneHasMoreOrFewerThanBefore) {
    const Workspace w;
    GltfBuilder two = triangleScene();
    two.mesh(two.json["meshes"][0]["primitives"][0]);
    ImportedScene scene = *importGltf(w.scene());
    const AssetFile sphere = add(scene, "shape:sphere").file;
    const AssetFile box = add(scene, "shape:box").file;
    addObject(scene.document, Node{.meshes = {box.firstMesh, sphere.firstMesh}});
    const std::string project = w.file("projects/p.limn");
    ASSERT_TRUE(saveProject(project, scene.document));
    const auto names = [&] {
        const Result<ImportedScene> loaded = loadProject(project);
        EXPECT_TRUE(loaded) << loaded.error().message;
        std::vector<std::string> found;
        const Node& node = std::get<Node>(loaded->document.objects.rbegin()->second);
        for (const std::uint32_t mesh : node.meshes)
            found.push_back(loaded->assets->meshes[mesh].name);
        return found;
    };
    EXPECT_EQ(names(), (std::vector<std::string>{"Box", "Sphere"}));
    writeFile(w.scene(), two.glb());
    EXPECT_EQ(names(), (std::vector<std::string>{"Box", "Sphere"}));
    GltfBuilder none;
    none.json["scenes"] = {{{"nodes", nlohmann::json::array()}}};
    writeFile(w.scene(), none.glb());
    EXPECT_EQ(names(), (std::vector<std::string>{"Box", "Sphere"}));
}

TEST(ProjectFile, AnAddedImageThatIsGoneIsShownWhiteAndASceneIsAnError) {
    const Workspace w;
    writeFile(w.file("models/other.glb"), triangleScene().glb());
    ASSERT_TRUE(writePng(w.file("models/red.png"), {"", 1, 1, {255, 0, 0, 255}}));
    ImportedScene scene = *importGltf(w.scene());
    Material paint;
    paint.baseColorTexture.image =
        std::int32_t(add(scene, w.file("models/red.png")).file.firstImage);
    addObject(scene.document, paint);
    addObject(scene.document,
              Node{.meshes = {add(scene, w.file("models/other.glb")).file.firstMesh}});
    const std::string project = w.file("projects/p.limn");
    ASSERT_TRUE(saveProject(project, scene.document));
    fs::remove(w.file("models/red.png"));
    const Result<ImportedScene> white = loadProject(project);
    ASSERT_TRUE(white) << white.error().message;
    EXPECT_TRUE(hasRepair(*white, "red.png"));
    ASSERT_EQ(white->assets->images.size(), 1u);
    EXPECT_EQ(white->assets->images[0].rgba, std::vector<std::uint8_t>(4, 255));
    fs::remove(w.file("models/other.glb"));
    const Result<ImportedScene> gone = loadProject(project);
    ASSERT_FALSE(gone);
    EXPECT_NE(gone.error().message.find("p.limn: files: "), std::string::npos);
    EXPECT_NE(gone.error().message.find("other.glb"), std::string::npos);
}

TEST(ProjectFile, TheSceneIsStoredRelativeSoThatTheFolderMayMove) {
    const Workspace w;
    const ImportedScene scene = *importGltf(w.scene());
    ASSERT_TRUE(saveProject(w.file("projects/p.limn"), scene.document));
    EXPECT_NE(fileBytes(w.file("projects/p.limn")).find("\"../models/scene.glb\""),
              std::string::npos);
    const TemporaryFolder elsewhere;
    fs::copy(w.path, elsewhere.path, fs::copy_options::recursive);
    fs::remove(w.scene());
    EXPECT_TRUE(loadProject(elsewhere.file("projects/p.limn")));
    const Result<ImportedScene> gone = loadProject(w.file("projects/p.limn"));
    ASSERT_FALSE(gone);
    EXPECT_NE(gone.error().message.find("p.limn: scene: "), std::string::npos);
    EXPECT_NE(gone.error().message.find("no such file"), std::string::npos);
}

TEST(ProjectFile, TheSkysImageIsStoredRelativeAndReadAgain) {
    const Workspace w;
    ImportedScene scene = *importGltf(w.scene());
    const ImageF panorama{2, 1, {{1, 2, 3}, {4, 5, -6}}};
    ASSERT_TRUE(writeExr(w.file("models/sky.exr"), panorama));
    Sky sky{
        .kind = SkyKind::Image, .image = w.file("models/sky.exr"), .strength = 2, .rotation = 0.5f};
    ASSERT_TRUE(readSkyImage(sky));
    EXPECT_EQ(sky.panorama->pixels.rgb[1], glm::vec3(4, 5, 0)) << "no light is negative";
    for (auto& [id, object] : scene.document.objects)
        if (std::holds_alternative<Sky>(object))
            object = sky;
    ASSERT_TRUE(saveProject(w.file("projects/p.limn"), scene.document));
    EXPECT_NE(fileBytes(w.file("projects/p.limn")).find("\"../models/sky.exr\""),
              std::string::npos);
    const Result<ImportedScene> loaded = loadProject(w.file("projects/p.limn"));
    ASSERT_TRUE(loaded);
    const Sky again = singleton<Sky>(loaded->document);
    ASSERT_TRUE(again.panorama);
    EXPECT_EQ(again.panorama->pixels.rgb, sky.panorama->pixels.rgb);
    EXPECT_EQ(again.rotation, 0.5f);
    fs::remove(w.file("models/sky.exr"));
    const Result<ImportedScene> gone = loadProject(w.file("projects/p.limn"));
    ASSERT_TRUE(gone);
    EXPECT_TRUE(hasRepair(*gone, "sky.exr"));
    EXPECT_FALSE(singleton<Sky>(gone->document).panorama);
}

TEST(ProjectFile, AChangedSceneIsLoadedWithAWord) {
    const Workspace w;
    const ImportedScene scene = *importGltf(w.scene());
    ASSERT_TRUE(saveProject(w.file("p.limn"), scene.document));
    GltfBuilder other;
    writeFile(w.scene(), other.glb()); // its mesh is gone
    const Result<ImportedScene> loaded = loadProject(w.file("p.limn"));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(hasRepair(*loaded, "changed since the project was saved"));
    EXPECT_TRUE(hasRepair(*loaded, "1 meshes are no longer"));
    EXPECT_NE(loaded->document.sceneHash, scene.document.sceneHash);
    EXPECT_TRUE(flatten(loaded->document, loaded->assets).instances.empty());
}

TEST(ProjectFile, WithoutObjectsThoseOfTheSceneAreTaken) {
    const Workspace w;
    writeFile(w.file("p.limn"), R"({"version": 1, "scene": "models/scene.glb"})");
    const Result<ImportedScene> loaded = loadProject(w.file("p.limn"));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(flatten(loaded->document, loaded->assets).instances.size(), 1u);
    writeFile(w.file("empty.limn"),
              R"({"version": 1, "scene": "models/scene.glb", "objects": []})");
    EXPECT_TRUE(loadProject(w.file("empty.limn"))->document.objects.empty());
}

TEST(ProjectFile, ADamagedProjectIsAnErrorWithFileAndField) {
    const Workspace w;
    writeFile(w.file("p.limn"), R"({"version": 3})");
    EXPECT_NE(loadProject(w.file("p.limn")).error().message.find("p.limn: version: 3 is unknown"),
              std::string::npos);
    writeFile(w.file("p.limn"), R"({"version": 1, "scene": 4})");
    EXPECT_NE(loadProject(w.file("p.limn")).error().message.find("p.limn: scene: not a string"),
              std::string::npos);
    writeFile(w.file("p.limn"), "");
    EXPECT_FALSE(loadProject(w.file("p.limn")));
    EXPECT_FALSE(loadProject(w.file("none.limn")));
    EXPECT_FALSE(loadProject(w.path.string()));
}

TEST(ProjectFile, SavingReplacesTheWholeFileAndLeavesNothingBeside) {
    const Workspace w;
    const std::string project = w.file("projects/p.limn");
    writeFile(project, std::string(100000, 'x'));
    ASSERT_TRUE(saveProject(project, Document{}));
    EXPECT_TRUE(loadProject(project));
    EXPECT_EQ(namesIn(w.path / "projects").size(), 1U);
}

TEST(ProjectFile, AFailedSaveKeepsTheOldFile) {
    const Workspace w;
    const std::string project = w.file("projects/p.limn");
    ASSERT_TRUE(saveProject(project, Document{}));
    const std::string before = fileBytes(project);
    Document broken;
    Light light;
    light.strength = std::numeric_limits<float>::quiet_NaN();
    addObject(broken, light);
    const Result<void> saved = saveProject(project, broken);
    ASSERT_FALSE(saved);
    EXPECT_NE(saved.error().message.find("objects[0].light.strength"), std::string::npos);
    Document unspeakable;
    addObject(unspeakable, Material{.name = "\xff"});
    EXPECT_FALSE(saveProject(project, unspeakable));
    EXPECT_EQ(fileBytes(project), before);
    const Result<void> nowhere = saveProject(w.file("no/p.limn"), Document{});
    ASSERT_FALSE(nowhere);
    EXPECT_NE(nowhere.error().message.find("no/p.limn"), std::string::npos);
    EXPECT_EQ(namesIn(w.path / "projects").size(), 1U);
}

TEST(ProjectFile, AnyKindOfNameOpens) {
    const Workspace w;
    const std::string folder = w.file("projects");
    EXPECT_TRUE(openAny(w.scene(), folder));
    const ImportedScene scene = *importGltf(w.scene());
    fs::create_directories(w.path / "projects" / "room");
    ASSERT_TRUE(saveProject(w.file("projects/room/room.limn"), scene.document));
    EXPECT_TRUE(openAny("room", folder));
    EXPECT_TRUE(openAny(w.file("projects/room/room.limn"), folder));
    const Result<ImportedScene> none = openAny("castle", folder);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("castle"), std::string::npos);
    EXPECT_FALSE(openAny("", folder));
    EXPECT_FALSE(openAny("../projects/room/room", folder));
}

} // namespace
} // namespace limn::project_file_test
