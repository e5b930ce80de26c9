// SPDX-License-Identifier: MIT
// Compressed geometry and textures.
#include "engine/gltf/gltf_import.h"
#include "engine/scene/decode_image.h"
#include "tests/core/source_path.h"
#include "tests/gltf/packed_scenes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include <glm/geometric.hpp>
#include <webp/encode.h>

namespace limn::gltf_packed_test {
namespace {

/// Corners of all triangles, in an order of their own.
std::vector<std::array<float, 9>> trianglesOf(const Mesh& mesh) {
    std::vector<std::array<float, 9>> triangles;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        std::array<std::array<float, 3>, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = mesh.positions[mesh.triangle(t)[k]];
            corners[k] = {p.x, p.y, p.z};
        }
        std::ranges::rotate(corners, std::ranges::min_element(corners));
        std::array<float, 9> all;
        for (std::size_t k = 0; k < 9; ++k)
            all[k] = corners[k / 3][k % 3];
        triangles.push_back(all);
    }
    std::ranges::sort(triangles);
    return triangles;
}

Mesh plainMesh(const Grid& grid) {
    Mesh mesh;
    mesh.positions = grid.positions;
    mesh.indices = grid.indices;
    return mesh;
}

TEST(GltfPacked, GeometryOfMeshoptimizerIsUnpacked) {
    const Grid grid;
    const Result<ImportedScene> scene = meshoptScene(grid).import();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->repairs.size() == 1) << "flat normals, which are generated";
    EXPECT_EQ(trianglesOf(scene->assets->meshes.at(0)), trianglesOf(plainMesh(grid)));
}

TEST(GltfPacked, DamagedGeometryOfMeshoptimizerIsRefusedByName) {
    const auto problem = [](const char* field, const nlohmann::json& value) {
        GltfBuilder b = meshoptScene({});
        b.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][field] = value;
        const Result<ImportedScene> scene = b.import();
        return scene ? std::string("read") : scene.error().message;
    };
    const std::string name = "bufferViews[0].extensions.EXT_meshopt_compression.";
    const auto expect = [&](const char* field, const nlohmann::json& value, const char* words) {
        const std::string message = problem(field, value);
        EXPECT_NE(message.find(name + words), std::string::npos) << message;
    };
    expect("buffer", 9, "buffer");
    expect("byteLength", 1 << 20, "1048576 bytes");
    expect("byteLength", 5, "is damaged");
    expect("byteStride", 13, "byteStride: 13");
    expect("byteStride", 512, "byteStride: 512");
    expect("count", 1000, "is damaged");
    expect("count", "x", "byteLength, byteStride or count");
    expect("mode", "LINES", "mode: LINES");
    expect("filter", "OCTAHEDRAL", "filter: OCTAHEDRAL");
}

TEST(GltfPacked, GeometryOfDracoIsUnpacked) {
    const Grid grid;
    for (const int speed : {0, 5, 10}) { // 10: triangles as they come
        const Result<ImportedScene> scene =
            dracoScene(dracoBytes(grid, speed), grid.indices.size()).import();
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(trianglesOf(scene->assets->meshes.at(0)), trianglesOf(plainMesh(grid))) << speed;
    }
}

TEST(GltfPacked, DamagedGeometryOfDracoIsRefusedByName) {
    const Grid grid;
    const std::vector<std::uint8_t> whole = dracoBytes(grid, 5);
    const auto problem = [&](const std::vector<std::uint8_t>& bytes) {
        const Result<ImportedScene> scene = dracoScene(bytes, grid.indices.size()).import();
        return scene ? std::string() : scene.error().message;
    };
    const std::string name = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression.";
    for (std::size_t size = 1; size < whole.size(); size += 7) {
        const std::string message = problem({whole.begin(), whole.begin() + std::ptrdiff_t(size)});
        EXPECT_TRUE(message.empty() || message.find(name) != std::string::npos) << message;
    }
    std::vector<std::uint8_t> bytes = whole;
    bytes[0] = 'X';
    EXPECT_NE(problem(bytes).find("is no Draco stream"), std::string::npos);
    bytes = whole;
    bytes[5] = 1;
    EXPECT_NE(problem(bytes).find("Draco version 1."), std::string::npos);
    bytes = whole;
    // A stream that claims two thousand million points is refused before they are allocated.
    bytes.insert(bytes.begin() + 12, {0xff, 0xff, 0xff, 0xff});
    EXPECT_NE(problem(bytes), "");
    // Whatever else is changed, it is read or refused.
    std::mt19937 random(1);
    for (int k = 0; k < 400; ++k) {
        bytes = whole;
        for (int i = 0; i < 3; ++i)
            bytes[random() % bytes.size()] = std::uint8_t(random());
        problem(bytes);
    }
}

TEST(GltfPacked, TexturesMayBeWebp) {
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < 12; ++i)
        rgba.insert(rgba.end(), {std::uint8_t(20 * i), 100, std::uint8_t(255 - i), 255});
    std::uint8_t* bytes = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), 4, 3, 16, &bytes);
    const std::vector<std::uint8_t> webp(bytes, bytes + size);
    WebPFree(bytes);
    const Result<Image> image = decodeImage(webp);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 4U);
    EXPECT_EQ(image->rgba, rgba);
    for (std::size_t length = 12; length + 1 < size; ++length)
        EXPECT_FALSE(decodeImage(std::span(webp).first(length))) << length;

    GltfBuilder b = triangleScene();
    nlohmann::json& primitive = b.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] =
        b.accessor(b.view(std::vector<glm::vec2>(3)), "VEC2", GltfBuilder::kFloat, 3);
    b.json["images"] = {{{"uri", "missing.png"}},
                        {{"bufferView", b.view(webp)}, {"mimeType", "image/webp"}}};
    b.json["textures"] = {{{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    for (const auto& [id, object] : scene->document.objects)
        if (const auto* material = std::get_if<Material>(&object)) {
            EXPECT_EQ(material->baseColorTexture.image, 1);
        }
    EXPECT_EQ(scene->assets->images.at(1).rgba, rgba);
}

/// Models that gltf-transform has packed. Draco and quantisation round positions.
TEST(GltfPacked, PackedModelsAreThePlainOnes) {
    const std::filesystem::path scenes = sourcePath("../shared/scenes");
    if (!std::filesystem::exists(scenes / "compressed"))
        GTEST_SKIP() << "the scenes in ../shared/scenes are absent";
    for (const auto& [name, plainFile] :
         {std::pair<std::string, std::string>("Duck", "objects/Duck"), {"Fox", "objects/Fox"}}) {
        std::filesystem::path plain;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes / plainFile))
            if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
                plain = entry.path();
        const Result<ImportedScene> expected = importGltf(plain.string());
        ASSERT_TRUE(expected) << expected.error().message;
        const Scene right = flatten(expected->document, expected->assets);
        for (const char* packing : {"draco", "meshopt", "quantized", "webp"}) {
            const std::filesystem::path file =
                scenes / "compressed" / (name + "-" + packing + ".glb");
            const Result<ImportedScene> scene = importGltf(file.string());
            ASSERT_TRUE(scene) << scene.error().message;
            const Scene flat = flatten(scene->document, scene->assets);
            std::size_t triangles = 0, wanted = 0;
            for (const Mesh& mesh : scene->assets->meshes)
                triangles += mesh.triangleCount();
            for (const Mesh& mesh : expected->assets->meshes)
                wanted += mesh.triangleCount();
            EXPECT_NEAR(double(triangles), double(wanted), 0.01 * double(wanted)) << file;
            const float size = glm::length(right.bounds.size());
            EXPECT_LT(glm::distance(flat.bounds.lower, right.bounds.lower), 2e-3f * size) << file;
            EXPECT_LT(glm::distance(flat.bounds.upper, right.bounds.upper), 2e-3f * size) << file;
            ASSERT_EQ(scene->assets->images.size(), expected->assets->images.size()) << file;
            for (std::size_t i = 0; i < scene->assets->images.size(); ++i)
                EXPECT_EQ(scene->assets->images[i].width, expected->assets->images[i].width);
        }
    }
}

} // namespace
} // namespace limn::gltf_packed_test
