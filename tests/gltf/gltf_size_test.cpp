// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_size.h"

#include "tests/gltf/gltf_builder.h"
#include "tests/scene/small_png.h"

namespace limn::gltf_size_test {
namespace {

std::string problem(GltfBuilder b, std::uint64_t most) {
    const TemporaryFolder folder;
    writeFile(folder.file("s.glb"), b.glb());
    const Result<ImportedScene> scene = importGltf(folder.file("s.glb"), {}, {.memory = {most}});
    return scene ? "" : scene.error().message;
}

TEST(GltfSize, ImagesMustFit) {
    GltfBuilder b = triangleScene();
    std::vector<std::uint8_t> png = greyPng();
    png.resize(70000); // long enough for 8 k x 8 k
    png[18] = png[22] = 0x20;
    const int view = b.view(png);
    for (int i = 0; i < 12; ++i)
        b.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    EXPECT_NE(problem(b, std::uint64_t(1) << 30)
                  .find("decoding its 12 images would need 3 GiB of memory, 1 GiB are allowed"),
              std::string::npos)
        << problem(b, std::uint64_t(1) << 30);
}

TEST(GltfSize, InstancesMustFit) {
    GltfBuilder b = triangleScene();
    const int zeros = b.accessor(0, "VEC3", GltfBuilder::kFloat, std::size_t(1) << 20);
    b.json["accessors"][std::size_t(zeros)].erase("bufferView");
    for (int i = 0; i < 10; ++i)
        b.json["nodes"].push_back(
            {{"mesh", 0},
             {"extensions",
              {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", zeros}}}}}}}});
    EXPECT_NE(problem(b, std::uint64_t(1) << 30).find("nodes and instances would need 10 GiB"),
              std::string::npos)
        << problem(b, std::uint64_t(1) << 30);
}

TEST(GltfSize, PrimitivesThatShareVerticesMustFitEachForItself) {
    GltfBuilder b = triangleScene();
    const auto primitive = b.json["meshes"][0]["primitives"][0];
    const int zeros = b.accessor(0, "VEC3", GltfBuilder::kFloat, std::size_t(1) << 20);
    b.json["accessors"][std::size_t(zeros)].erase("bufferView");
    for (int i = 0; i < 100; ++i) {
        b.json["meshes"][0]["primitives"].push_back(primitive);
        b.json["meshes"][0]["primitives"].back()["attributes"]["POSITION"] = zeros;
    }
    EXPECT_NE(problem(b, std::uint64_t(1) << 30).find("its 1 meshes would need"),
              std::string::npos);
}

TEST(GltfSize, ItsJsonMustFit) {
    GltfBuilder b = triangleScene();
    b.json["extras"] = std::vector<int>(100000); // 200 kB that become 20 MB
    EXPECT_NE(problem(b, 10 << 20).find("its JSON would need 19"), std::string::npos)
        << problem(b, 10 << 20);
    EXPECT_EQ(problem(b, 30 << 20), "");
}

TEST(GltfSize, WhatFitsIsRead) {
    EXPECT_EQ(problem(triangleScene(), 1 << 20), "");
}

} // namespace
} // namespace limn::gltf_size_test
