// SPDX-License-Identifier: MIT
#include "engine/scene/origin.h"
#include "tests/gltf/gltf_builder.h"

#include <gtest/gtest.h>

namespace limn::gltf_refusal_test {
namespace {

using Json = nlohmann::json;

TEST(GltfRefusal, ARequiredExtensionWeLackIsNamed) {
    GltfBuilder b = triangleScene();
    b.json["extensionsUsed"] =
        b.json["extensionsRequired"] = {"KHR_lights_punctual", "EXT_unheard_of"};
    EXPECT_NE(refusal(b).find("EXT_unheard_of"), std::string::npos);
    b.json["extensionsRequired"] = {"KHR_lights_punctual"};
    EXPECT_TRUE(hasRepair(imported(b), "EXT_unheard_of is ignored"));
}

TEST(GltfRefusal, CyclesAndSecondParentsAreRefused) {
    GltfBuilder b;
    b.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
    EXPECT_NE(refusal(b).find("its own ancestor"), std::string::npos);
    b.json["nodes"] = {{{"children", {0}}}};
    EXPECT_NE(refusal(b).find("nodes[0]"), std::string::npos);
    b.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, Json::object()};
    EXPECT_NE(refusal(b).find("two parents"), std::string::npos);
}

TEST(GltfRefusal, AChainOfFiftyThousandNodesIsNoProblem) {
    GltfBuilder b = triangleScene();
    Json nodes = Json::array({{{"mesh", 0}}});
    for (int i = 1; i <= 50000; ++i)
        nodes.push_back({{"children", {i - 1}}, {"translation", {1, 0, 0}}});
    b.json["nodes"] = nodes;
    b.json["scenes"] = {{{"nodes", {50000}}}};
    const ImportedScene scene = imported(b);
    const Scene flat = flatten(scene.document, scene.assets);
    EXPECT_EQ(toFile(flat.origin, flat.bounds.lower).x, 50000);
}

TEST(GltfRefusal, WhatDoesNotFitIsRefusedByFieldAndFile) {
    struct Case {
        const char* change; ///< a JSON pointer
        Json value;
        const char* expected;
    };
    const Case cases[] = {
        {"/accessors/0/bufferView", 7, "accessors[0].bufferView: index 7"},
        {"/accessors/0/byteOffset", 4, "accessors[0]: 3 elements"},
        {"/accessors/0/count", 4, "accessors[0]: 4 elements"},
        {"/accessors/0/count", 4294967296, "accessors[0]: 4294967296 elements"},
        {"/accessors/0/count", -1, "accessors[0].count"},
        {"/accessors/0/componentType", 5124, "accessors[0]"},
        {"/accessors/0/type", "VEC2", "POSITION"},
        {"/accessors/0/type", 3, "accessors[0].type: not a string"},
        {"/bufferViews/0/byteLength", 1000, "bufferViews[0]"},
        {"/bufferViews/0/byteOffset", 1000, "bufferViews[0]"},
        {"/bufferViews/0/buffer", 1, "bufferViews[0].buffer"},
        {"/bufferViews/0/byteStride", 4, "byteStride"},
        {"/meshes/0/primitives/0/mode", 9, "meshes[0].primitives[0].mode"},
        {"/meshes/0/primitives/0/attributes/NORMAL", 0, nullptr},
        {"/meshes/0/primitives/0/attributes/POSITION", 5, "attributes.POSITION: index 5"},
        {"/meshes/0/primitives/0/material", 0, "meshes[0].primitives[0].material"},
        {"/nodes/0/mesh", 3, "nodes[0].mesh"},
        {"/nodes/0/rotation", Json{0, 0, 1}, "nodes[0].rotation: not 4 numbers"},
        {"/nodes/0/translation", Json{0, 0, 1e300}, "nodes[0].translation"},
        {"/nodes/0/children", Json{9}, "nodes[0].children[0]"},
        {"/scenes/0/nodes/0", 2, "scenes[0].nodes[0]"},
        {"/asset/version", "1.0", "asset.version"},
    };
    for (const Case& c : cases) {
        GltfBuilder b = triangleScene();
        b.json[Json::json_pointer(c.change)] = c.value;
        const Result<ImportedScene> scene = b.import();
        EXPECT_EQ(bool(scene), c.expected == nullptr) << c.change;
        if (!scene && c.expected) {
            EXPECT_NE(scene.error().message.find(c.expected), std::string::npos)
                << c.change << ": " << scene.error().message;
            EXPECT_NE(scene.error().message.find("scene.glb: "), std::string::npos);
        }
    }
}

TEST(GltfRefusal, AnImageBeyondItsBufferIsRefused) {
    GltfBuilder b = triangleScene();
    b.json["images"] = {{{"mimeType", "image/png"}, {"bufferView", b.json["bufferViews"].size()}}};
    b.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 1000000}, {"byteLength", 40}});
    EXPECT_NE(refusal(b).find("images[0].bufferView: 40 bytes at 1000000"), std::string::npos)
        << refusal(b);
}

TEST(GltfRefusal, IndicesOutOfRangeAreRefused) {
    GltfBuilder b = triangleScene();
    b.json["meshes"][0]["primitives"][0]["indices"] = b.indices({0, 1, 3});
    EXPECT_NE(refusal(b).find("element 2 is 3"), std::string::npos);
}

TEST(GltfRefusal, JsonNestedWithoutEndIsRefused) {
    const TemporaryFolder folder;
    const std::string deep(200000, '[');
    writeFile(folder.file("deep.gltf"), R"({"asset":{"version":"2.0"},"extras":)" + deep);
    const Result<ImportedScene> scene = importGltf(folder.file("deep.gltf"));
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("nested"), std::string::npos);
}

TEST(GltfRefusal, BuffersMayBeShorterThanTheirFileButNotLonger) {
    const TemporaryFolder folder;
    GltfBuilder b = triangleScene();
    b.json["buffers"] = {{{"uri", "with%20space.bin"}, {"byteLength", b.bytes.size()}}};
    writeFile(folder.file("s.gltf"), b.json.dump());
    Result<ImportedScene> scene = importGltf(folder.file("s.gltf"));
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("buffers[0].uri"), std::string::npos)
        << scene.error().message;
    writeFile(folder.file("with space.bin"), b.bytes + "more");
    EXPECT_TRUE(importGltf(folder.file("s.gltf")));
    writeFile(folder.file("with space.bin"), b.bytes.substr(4));
    EXPECT_FALSE(importGltf(folder.file("s.gltf")));
}

TEST(GltfRefusal, AMissingFileOrAFolderIsNoScene) {
    const TemporaryFolder folder;
    EXPECT_NE(importGltf(folder.file("no.gltf")).error().message.find("no such file"),
              std::string::npos);
    EXPECT_NE(importGltf(folder.path.string()).error().message.find("not a regular file"),
              std::string::npos);
}

} // namespace
} // namespace limn::gltf_refusal_test
