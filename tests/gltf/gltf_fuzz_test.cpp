// SPDX-License-Identifier: MIT
#include "tests/gltf/gltf_builder.h"
#include "tests/scene/small_png.h"

#include <random>

#include <gtest/gtest.h>

namespace limn::gltf_fuzz_test {
namespace {

/// A file with something of everything: sparse, indices, a texture in a view, a light, a camera,
/// instances.
std::string richFile() {
    GltfBuilder b;
    const int position = b.vec3({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const int uv = b.accessor(b.view(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}), "VEC2",
                              GltfBuilder::kFloat, 4);
    const int rows = b.view(std::vector<std::uint16_t>{2});
    const int values = b.view(std::vector<glm::vec3>{{2, 2, 1}});
    b.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", rows}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    b.mesh({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}},
            {"indices", b.indices({0, 1, 2, 0, 2, 3})},
            {"material", 0}});
    const int image = b.view(greyPng());
    b.json["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                            {"normalTexture", {{"index", 0}}},
                            {"alphaMode", "MASK"}}};
    b.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    b.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 5}}};
    const int translation = b.vec3({{0, 0, 0}, {4, 0, 0}});
    b.json["nodes"][0]["extensions"] = {
        {"KHR_lights_punctual", {{"light", 0}}},
        {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", translation}}}}}};
    b.json["nodes"][0]["camera"] = 0;
    return b.glb();
}

/// Imports `bytes`; uses what came out as every later stage would.
void exercise(const TemporaryFolder& folder, const std::string& bytes) {
    const std::string path = folder.file("fuzz.glb");
    writeFile(path, bytes);
    const Result<ImportedScene> scene = importGltf(path);
    if (!scene) {
        EXPECT_NE(scene.error().message.find("fuzz.glb: "), std::string::npos);
        return;
    }
    const Scene flat = flatten(scene->document, scene->assets);
    for (const Instance& instance : flat.instances)
        for (std::uint32_t t = 0; t < flat.meshOf(instance).triangleCount(); ++t) {
            const SurfaceMaterial m = surfaceMaterial(flat, instance, t, 0.3f, 0.3f);
            EXPECT_TRUE(m.albedo.x >= 0 && m.albedo.x <= 0.99f);
        }
    chooseCamera(flat, {});
}

TEST(GltfFuzz, TheUnharmedFileImportsInFull) {
    const TemporaryFolder folder;
    writeFile(folder.file("s.glb"), richFile());
    const Result<ImportedScene> scene = importGltf(folder.file("s.glb"));
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    EXPECT_EQ(flat.instances.size(), 2u);
    EXPECT_EQ(flat.lights.size(), 1u);
    EXPECT_EQ(flat.cameras.size(), 1u);
    EXPECT_EQ(scene->assets->images[0].rgba, (std::vector<std::uint8_t>{128, 128, 128, 255}));
    EXPECT_EQ(flat.bounds.upper, glm::vec3(6, 2, 1));
}

TEST(GltfFuzz, TruncationAnywhereNeverCrashes) {
    const TemporaryFolder folder;
    const std::string whole = richFile();
    for (std::size_t length = 0; length < whole.size(); length += 13)
        exercise(folder, whole.substr(0, length));
}

TEST(GltfFuzz, FlippedBytesNeverCrash) {
    const TemporaryFolder folder;
    const std::string whole = richFile();
    std::mt19937 random(20260711);
    for (int round = 0; round < 500; ++round) {
        std::string bytes = whole;
        const int flips = 1 + int(random() % 4);
        for (int i = 0; i < flips; ++i)
            bytes[random() % bytes.size()] = char(random() % 256);
        exercise(folder, bytes);
    }
}

TEST(GltfFuzz, ChangedDigitsNeverCrash) {
    // Random bytes rarely get past the JSON parser; random numbers do.
    const TemporaryFolder folder;
    const std::string whole = richFile();
    std::vector<std::size_t> digits;
    for (std::size_t i = 20; i < whole.size() && whole.compare(i, 3, "BIN") != 0; ++i)
        if (whole[i] >= '0' && whole[i] <= '9')
            digits.push_back(i);
    std::mt19937 random(7);
    for (int round = 0; round < 500; ++round) {
        std::string bytes = whole;
        const int changes = 1 + int(random() % 3);
        for (int i = 0; i < changes; ++i)
            bytes[digits[random() % digits.size()]] = char('0' + random() % 10);
        exercise(folder, bytes);
    }
}

} // namespace
} // namespace limn::gltf_fuzz_test
