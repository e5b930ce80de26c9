// SPDX-License-Identifier: MIT
#include "tests/gltf/gltf_builder.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::gltf_import_test {
namespace {

using Json = nlohmann::json;

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

const Mesh& onlyMesh(const ImportedScene& scene) {
    EXPECT_EQ(scene.assets->meshes.size(), 1u);
    return scene.assets->meshes[0];
}

template <class T>
T onlyObject(const ImportedScene& scene) {
    T found;
    int count = 0;
    for (const auto& [id, object] : scene.document.objects)
        if (const T* t = std::get_if<T>(&object)) {
            found = *t;
            ++count;
        }
    EXPECT_EQ(count, 1);
    return found;
}

/// Normal that the winding of triangle t gives.
glm::vec3 windingNormal(const Mesh& mesh, std::size_t t) {
    const auto [a, b, c] = mesh.triangle(t);
    return glm::normalize(
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
}

void expectNear(glm::vec3 a, glm::vec3 b, float tolerance = 1e-5f) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

TEST(GltfImport, AnEmptySceneIsAValidDocument) {
    const ImportedScene scene = imported(GltfBuilder{});
    EXPECT_TRUE(scene.assets->meshes.empty());
    EXPECT_TRUE(scene.repairs.empty());
    const Scene flat = flatten(scene.document, scene.assets);
    EXPECT_TRUE(flat.instances.empty());
    EXPECT_EQ(flat.bounds.size(), glm::vec3(0));
    const Camera camera = chooseCamera(flat, {});
    EXPECT_TRUE(std::isfinite(camera.eye.x) && camera.eye != camera.target);
}

TEST(GltfImport, ATriangleWithoutNormalsGetsItsPlanesNormal) {
    const ImportedScene scene = imported(triangleScene());
    const Mesh& mesh = onlyMesh(scene);
    ASSERT_EQ(mesh.triangleCount(), 1u);
    for (const glm::vec3& n : mesh.normals)
        expectNear(n, {0, 0, 1});
    EXPECT_TRUE(hasRepair(scene, "1 meshes without normals"));
}

TEST(GltfImport, FlatNormalsSplitVerticesOnlyWherePlanesMeet) {
    // Two coplanar triangles that share an edge with a third, upright one.
    GltfBuilder b;
    const int position = b.vec3({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}});
    b.mesh({{"attributes", {{"POSITION", position}}},
            {"indices", b.indices({0, 1, 2, 0, 2, 3, 0, 4, 1})}});
    const ImportedScene scene = imported(b);
    const Mesh& mesh = onlyMesh(scene);
    EXPECT_EQ(mesh.positions.size(), 4u + 3u);
    for (std::size_t t = 0; t < 3; ++t)
        for (const std::uint32_t i : mesh.triangle(t))
            expectNear(mesh.normals[i], windingNormal(mesh, t));
}

TEST(GltfImport, NormalsThatAreNoDirectionsAreReplacedAndCounted) {
    GltfBuilder b;
    const int position = b.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int normal = b.vec3({{0, 0, 0}, {kNan, 0, 1}, {0, 0, 2}});
    b.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    const ImportedScene scene = imported(b);
    for (const glm::vec3& n : onlyMesh(scene).normals)
        expectNear(n, {0, 0, 1});
    EXPECT_TRUE(hasRepair(scene, "2 invalid normals"));
}

TEST(GltfImport, DegenerateAndNanTrianglesAreRemovedAndCounted) {
    GltfBuilder b;
    const int position = b.vec3({{0, 0, 0},
                                 {1, 0, 0},
                                 {0, 1, 0}, // good
                                 {0, 0, 0},
                                 {1, 1, 1},
                                 {2, 2, 2}, // on a line
                                 {5, 5, 5},
                                 {5, 5, 5},
                                 {1, 2, 3}, // two corners in one place
                                 {kNan, 0, 0},
                                 {1, 0, 0},
                                 {0, 1, 0},
                                 {0, 0, 0},
                                 {kInf, 0, 0},
                                 {0, 1, 0}});
    b.mesh({{"attributes", {{"POSITION", position}}}});
    const ImportedScene scene = imported(b);
    const Mesh& mesh = onlyMesh(scene);
    EXPECT_EQ(mesh.triangleCount(), 1u);
    EXPECT_EQ(mesh.positions.size(), 3u) << "vertices that no triangle uses must go";
    EXPECT_TRUE(hasRepair(scene, "2 triangles of zero area"));
    EXPECT_TRUE(hasRepair(scene, "2 triangles with positions not finite"));
}

TEST(GltfImport, NeedlesStayWhereTheyHaveAPlane) {
    GltfBuilder b;
    b.mesh({{"attributes", {{"POSITION", b.vec3({{0, 0, 0}, {1000, 0, 0}, {0, 1e-3f, 0}})}}}});
    EXPECT_EQ(onlyMesh(imported(b)).triangleCount(), 1u);
}

TEST(GltfImport, AMeshOfOnlyBadTrianglesLeavesTheNodeEmpty) {
    GltfBuilder b;
    b.mesh({{"attributes", {{"POSITION", b.vec3({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}})}}}});
    const ImportedScene scene = imported(b);
    EXPECT_TRUE(scene.assets->meshes.empty());
    EXPECT_TRUE(onlyObject<Node>(scene).meshes.empty());
}

TEST(GltfImport, StripsAndFansKeepEveryTrianglesFront) {
    for (const int mode : {5, 6}) {
        GltfBuilder b;
        // A quad and a half, all facing +z: zigzag for the strip, round the first corner for the
        // fan.
        const int position = mode == 5
                                 ? b.vec3({{0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, 1, 0}})
                                 : b.vec3({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 2, 0}});
        b.mesh({{"attributes", {{"POSITION", position}}}, {"mode", mode}});
        const ImportedScene scene = imported(b);
        const Mesh& mesh = onlyMesh(scene);
        ASSERT_EQ(mesh.triangleCount(), 3u) << mode;
        for (std::size_t t = 0; t < 3; ++t)
            expectNear(windingNormal(mesh, t), {0, 0, 1});
    }
}

TEST(GltfImport, PointsAndLinesAreLeftOutWithAWord) {
    for (const int mode : {0, 1, 2, 3}) {
        GltfBuilder b = triangleScene();
        b.json["meshes"][0]["primitives"][0]["mode"] = mode;
        const ImportedScene scene = imported(b);
        EXPECT_TRUE(scene.assets->meshes.empty());
        EXPECT_TRUE(hasRepair(scene, "points or lines"));
    }
}

TEST(GltfImport, SparseValuesReplaceTheirRows) {
    for (const bool zeroBase : {false, true}) {
        GltfBuilder b;
        const int position = b.vec3({{9, 9, 9}, {1, 0, 0}, {0, 1, 0}});
        const int rows = b.view(std::vector<std::uint16_t>{0, 1, 2});
        const int values = b.view(std::vector<glm::vec3>{{0, 0, 5}, {3, 0, 5}, {0, 3, 5}});
        Json& accessor = b.json["accessors"][std::size_t(position)];
        accessor["sparse"] = {{"count", zeroBase ? 3 : 1},
                              {"indices", {{"bufferView", rows}, {"componentType", 5123}}},
                              {"values", {{"bufferView", values}}}};
        if (zeroBase) {
            accessor.erase("bufferView");
            accessor.erase("byteOffset");
        }
        b.mesh({{"attributes", {{"POSITION", position}}}});
        const ImportedScene scene = imported(b);
        const Mesh& mesh = onlyMesh(scene);
        EXPECT_EQ(mesh.positions[0], glm::vec3(0, 0, 5));
        EXPECT_EQ(mesh.positions[1], zeroBase ? glm::vec3(3, 0, 5) : glm::vec3(1, 0, 0));
    }
}

TEST(GltfImport, InterleavedAttributesFollowTheirStride) {
    GltfBuilder b;
    std::vector<float> rows; // position, normal
    for (const glm::vec3& p : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
        rows.insert(rows.end(), {p.x, p.y, p.z, 0, 0.6f, 0.8f});
    const int view = b.view(rows, 24);
    const int position = b.accessor(view, "VEC3", GltfBuilder::kFloat, 3);
    const int normal = b.accessor(view, "VEC3", GltfBuilder::kFloat, 3, false, 12);
    b.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    const ImportedScene scene = imported(b);
    EXPECT_EQ(onlyMesh(scene).positions[2], glm::vec3(0, 1, 0));
    expectNear(onlyMesh(scene).normals[2], {0, 0.6f, 0.8f});
}

TEST(GltfImport, QuantisedAttributesAreDecoded) {
    GltfBuilder b;
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    // Rows of three shorts are padded to eight bytes.
    const int position =
        b.accessor(b.view(std::vector<std::int16_t>{0, 0, 0, 0, 100, 0, 0, 0, 0, 200, 0, 0}, 8),
                   "VEC3", GltfBuilder::kShort, 3);
    const int normal =
        b.accessor(b.view(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, -128, 0}, 4),
                   "VEC3", GltfBuilder::kByte, 3, true);
    const int uv = b.accessor(b.view(std::vector<std::uint16_t>{0, 65535, 13107, 0, 0, 0}), "VEC2",
                              GltfBuilder::kUnsignedShort, 3, true);
    const int color =
        b.accessor(b.view(std::vector<std::uint8_t>{255, 0, 51, 255, 0, 0, 0, 0, 0, 0, 0, 0}),
                   "VEC4", GltfBuilder::kUnsignedByte, 3, true);
    const int uv1 =
        b.accessor(b.view(std::vector<std::int8_t>{127, -128, 0, 0, -127, 64, 0, 0, 0, 0, 0, 0}, 4),
                   "VEC2", GltfBuilder::kByte, 3, true);
    b.mesh({{"attributes",
             {{"POSITION", position},
              {"NORMAL", normal},
              {"TEXCOORD_0", uv},
              {"TEXCOORD_1", uv1},
              {"COLOR_0", color}}}});
    const ImportedScene scene = imported(b);
    const Mesh& mesh = onlyMesh(scene);
    EXPECT_EQ(mesh.positions[2], glm::vec3(0, 200, 0));
    expectNear(mesh.normals[0], {0, 0, 1});
    expectNear(mesh.normals[2], {0, 0, -1}); // -128 / 127 is cut at -1
    EXPECT_FLOAT_EQ(mesh.uv0[0].y, 1);
    EXPECT_FLOAT_EQ(mesh.uv0[1].x, 0.2f);
    EXPECT_EQ(mesh.uv1[0], glm::vec2(1, -1));
    EXPECT_EQ(mesh.uv1[1], glm::vec2(-1, 64 / 127.f));
    EXPECT_FLOAT_EQ(mesh.colors[0].z, 0.2f);
}

TEST(GltfImport, ANodesMatrixIsSplitIntoTranslationRotationAndScale) {
    GltfBuilder b = triangleScene();
    // Columns: x -> 2y, y -> -3x, z -> -4z (mirrored).
    b.json["nodes"][0]["matrix"] = {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, -4, 0, 5, 6, 7, 1};
    const ImportedScene scene = imported(b);
    const glm::mat4 m = matrix(onlyObject<Node>(scene).transform);
    expectNear(glm::vec3(m * glm::vec4(1, 1, 1, 1)), {2, 8, 3}, 1e-4f);
    EXPECT_LT(glm::determinant(m), 0);
    EXPECT_TRUE(scene.repairs.size() == 1) << "only the missing normals";
}

TEST(GltfImport, AMatrixWithShearIsReported) {
    GltfBuilder b = triangleScene();
    b.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_TRUE(hasRepair(imported(b), "shear"));
}

TEST(GltfImport, AMirroredInstanceKeepsItsFrontOutward) {
    GltfBuilder b = triangleScene();
    for (const Json& scale : {Json{-1, 1, 1}, Json{1, 1, -2}, Json{-1, -1, -1}, Json{2, 3, 4}}) {
        b.json["nodes"][0]["scale"] = scale;
        const ImportedScene scene = imported(b);
        const Scene flat = flatten(scene.document, scene.assets);
        const Instance& instance = flat.instances[0];
        // The front normal (0, 0, 1) as a plane's normal goes through the inverse transpose.
        const float z = scale[2].get<float>() < 0 ? -1.f : 1.f;
        expectNear(glm::normalize(instance.normalToWorld * glm::vec3(0, 0, 1)), {0, 0, z});
    }
}

TEST(GltfImport, ANodeOfScaleZeroAlongTwoAxesIsHidden) {
    GltfBuilder b = triangleScene();
    b.json["nodes"][0]["scale"] = {1, 0, 0};
    const ImportedScene scene = imported(b);
    EXPECT_TRUE(flatten(scene.document, scene.assets).instances.empty());
    EXPECT_TRUE(hasRepair(scene, "scale 0"));
}

TEST(GltfImport, InstancingBecomesOneNodePerInstance) {
    GltfBuilder b = triangleScene();
    const int translation = b.vec3({{1, 0, 0}, {2, 0, 0}, {kNan, 0, 0}});
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    b.json["nodes"][0]["translation"] = {0, 10, 0};
    b.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        translation;
    const ImportedScene scene = imported(b);
    const Scene flat = flatten(scene.document, scene.assets);
    ASSERT_EQ(flat.instances.size(), 2u);
    EXPECT_EQ(glm::vec3(flat.instances[1].toWorld[3]), glm::vec3(2, 10, 0));
    EXPECT_TRUE(hasRepair(scene, "1 instances with numbers not finite"));
}

TEST(GltfImport, LightsTakePlaceAndDirectionButNotScaleFromTheirNode) {
    GltfBuilder b;
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"intensity", 40},
         {"range", 8},
         {"color", {1, 0.5, 0.25}},
         {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}}};
    b.json["scenes"] = {{{"nodes", {0}}}};
    // Turned a quarter about x: -z becomes +y. All scaled by 3.
    b.json["nodes"] = {{{"children", {1}}, {"scale", {3, 3, 3}}},
                       {{"name", "Lamp"},
                        {"translation", {1, 2, 3}},
                        {"rotation", {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                        {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    const Light light = onlyObject<Light>(imported(b));
    EXPECT_EQ(light.name, "Lamp");
    EXPECT_EQ(light.kind, LightKind::Spot);
    expectNear(light.position, {3, 6, 9});
    expectNear(light.direction, {0, 1, 0});
    EXPECT_EQ(light.color, glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(light.strength, 40);
    EXPECT_EQ(light.range, 8);
    EXPECT_FLOAT_EQ(light.innerAngle, 0.2f);
    EXPECT_FLOAT_EQ(light.outerAngle, 0.5f);
}

TEST(GltfImport, LightsHaveTheExtensionsDefaults) {
    GltfBuilder b;
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", Json::object()}}};
    b.json["nodes"] = {{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    const Light light = onlyObject<Light>(imported(b));
    EXPECT_EQ(light.strength, 1);
    EXPECT_EQ(light.range, 0);
    EXPECT_EQ(light.color, glm::vec3(1));
    EXPECT_EQ(light.innerAngle, 0);
    EXPECT_NEAR(light.outerAngle, 0.7853982f, 1e-6f);
}

TEST(GltfImport, MaterialsFollowTheFileAndItsDefaults) {
    GltfBuilder b = triangleScene();
    b.json["extensionsUsed"] = {"KHR_materials_emissive_strength"};
    b.json["materials"] = {
        Json::object(),
        {{"name", "Lamp"},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.25},
         {"doubleSided", true},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
           {"metallicFactor", 0.5},
           {"roughnessFactor", 0.6}}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 20}}}}}}};
    b.json["meshes"][0]["primitives"][0]["material"] = 1;
    const ImportedScene scene = imported(b);
    const Scene flat = flatten(scene.document, scene.assets);
    ASSERT_EQ(flat.materials.size(), 2u);
    EXPECT_EQ(flat.materials[0].metallic, 1);
    EXPECT_EQ(flat.materials[0].baseColor, glm::vec4(1));
    EXPECT_EQ(flat.materials[0].alphaMode, AlphaMode::Opaque);
    const Material& m = flat.materialOf(flat.instances[0]);
    EXPECT_EQ(m.name, "Lamp");
    EXPECT_EQ(m.emission, glm::vec3(20, 10, 0));
    EXPECT_EQ(m.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(m.alphaCutoff, 0.25f);
    EXPECT_TRUE(m.doubleSided);
    EXPECT_EQ(m.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.6f);
}

/// The material of a file that gives its only material these extensions.
static ImportedScene withExtensions(const Json& extensions) {
    GltfBuilder b = triangleScene();
    b.json["materials"] = {{{"extensions", extensions}}};
    b.json["meshes"][0]["primitives"][0]["material"] = 0;
    for (const auto& [name, value] : extensions.items())
        b.json["extensionsRequired"].push_back(name);
    b.json["extensionsUsed"] = b.json["extensionsRequired"];
    return imported(b);
}

TEST(GltfImport, GlassHasItsTransmissionIndexAndThickness) {
    const ImportedScene scene =
        withExtensions({{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
                        {"KHR_materials_ior", {{"ior", 1.33}}},
                        {"KHR_materials_volume", {{"thicknessFactor", 0.02}}}});
    const Material m = onlyObject<Material>(scene);
    EXPECT_EQ(m.transmission, 0.75f);
    EXPECT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.thickness, 0.02f);
    EXPECT_FALSE(hasRepair(scene, "left out"));
    EXPECT_FALSE(hasRepair(scene, "ignored"));
    const Json empty = Json::object();
    const Material plain =
        onlyObject<Material>(withExtensions({{"KHR_materials_transmission", empty},
                                             {"KHR_materials_ior", empty},
                                             {"KHR_materials_volume", empty}}));
    EXPECT_EQ(plain.transmission, 0);
    EXPECT_EQ(plain.ior, 1.5f);
    EXPECT_EQ(plain.thickness, 0);
}

TEST(GltfImport, NumbersOfGlassOutOfRangeAreRepaired) {
    const ImportedScene scene =
        withExtensions({{"KHR_materials_transmission", {{"transmissionFactor", 7}}},
                        {"KHR_materials_ior", {{"ior", 0.5}}},
                        {"KHR_materials_volume", {{"thicknessFactor", -1e39}}}});
    const Material m = onlyObject<Material>(scene);
    EXPECT_EQ(m.transmission, 1);
    EXPECT_EQ(m.ior, 1);
    EXPECT_EQ(m.thickness, 0);
    EXPECT_TRUE(hasRepair(scene, "3 material numbers out of range"));
    const ImportedScene mirror = withExtensions({{"KHR_materials_ior", {{"ior", 0}}}});
    EXPECT_EQ(onlyObject<Material>(mirror).ior, 1.5f);
    EXPECT_TRUE(hasRepair(mirror, "indices of refraction of 0"));
}

TEST(GltfImport, WhatGlassLacksIsNamed) {
    const ImportedScene scene =
        withExtensions({{"KHR_materials_transmission",
                         {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}},
                        {"KHR_materials_volume",
                         {{"thicknessTexture", {{"index", 0}}}, {"attenuationDistance", 0.1}}}});
    for (const char* repair : {"1 transmission textures", "1 thickness textures", "1 absorption"})
        EXPECT_TRUE(hasRepair(scene, repair)) << repair;
}

TEST(GltfImport, APrimitiveWithoutMaterialGetsAPlainOneAfterTheFiles) {
    GltfBuilder b = triangleScene();
    b.json["materials"] = {{{"name", "unused"}}};
    const ImportedScene scene = imported(b);
    const Scene flat = flatten(scene.document, scene.assets);
    ASSERT_EQ(flat.materials.size(), 2u);
    EXPECT_EQ(flat.materialOf(flat.instances[0]).name, "Default");
}

TEST(GltfImport, TexturesCarrySamplerAndTransform) {
    GltfBuilder b = triangleScene();
    b.json["images"] = {{{"uri", "missing.png"}}};
    b.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    b.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    b.json["materials"] = {{{"pbrMetallicRoughness",
                             {{"baseColorTexture",
                               {{"index", 0},
                                {"texCoord", 0},
                                {"extensions",
                                 {{"KHR_texture_transform",
                                   {{"offset", {0.5, -1}},
                                    {"scale", {2, 3}},
                                    {"rotation", 0.25},
                                    {"texCoord", 1}}}}}}}}}}};
    b.json["meshes"][0]["primitives"][0]["material"] = 0;
    b.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        b.accessor(b.view(std::vector<glm::vec2>(3)), "VEC2", GltfBuilder::kFloat, 3);
    const ImportedScene scene = imported(b);
    const TextureRef texture = onlyObject<Material>(scene).baseColorTexture;
    EXPECT_EQ(texture.image, 0);
    EXPECT_EQ(texture.texCoord, 1u);
    EXPECT_EQ(texture.offset, glm::vec2(0.5f, -1));
    EXPECT_EQ(texture.scale, glm::vec2(2, 3));
    EXPECT_EQ(texture.rotation, 0.25f);
    EXPECT_EQ(texture.wrapU, Wrap::Clamp);
    EXPECT_EQ(texture.wrapV, Wrap::Mirror);
    EXPECT_TRUE(texture.nearest);
    EXPECT_EQ(scene.assets->images[0].rgba, (std::vector<std::uint8_t>{255, 255, 255, 255}));
    EXPECT_TRUE(hasRepair(scene, "missing.png"));
}

TEST(GltfImport, TangentsExistOnlyForNormalMapsAndFollowTheTexture) {
    GltfBuilder b;
    const int position = b.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    // u along +x, v down: along -y, as an upright picture has it.
    const int uv =
        b.accessor(b.view(std::vector<float>{0, 1, 1, 1, 0, 0}), "VEC2", GltfBuilder::kFloat, 3);
    const int bytes =
        b.accessor(b.view(std::vector<std::int8_t>{127, -128, 0, 0, -127, 64, 0, 0}, 4), "VEC2",
                   GltfBuilder::kByte, 2, true);
    b.json["accessors"][std::size_t(bytes)]["count"] = 3;
    b.bytes.resize(b.bytes.size() + 4);
    b.json["bufferViews"].back()["byteLength"] = 12;
    b.mesh({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}, {"material", 0}});
    b.json["materials"] = {Json::object()};
    EXPECT_TRUE(onlyMesh(imported(b)).tangents.empty());
    b.json["images"] = {{{"uri", "missing.png"}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const ImportedScene scene = imported(b);
    ASSERT_EQ(onlyMesh(scene).tangents.size(), 3u);
    for (const glm::vec4& t : onlyMesh(scene).tangents) {
        expectNear(glm::vec3(t), {1, 0, 0});
        EXPECT_EQ(t.w, 1) << "cross(n, t) must be the picture's up";
    }
}

TEST(GltfImport, APerspectiveCameraLooksDownItsNodesMinusZ) {
    GltfBuilder b;
    b.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    b.json["nodes"] = {{{"name", "Eye"},
                        {"camera", 0},
                        {"translation", {1, 2, 3}},
                        {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}}}; // -z becomes -x
    const Camera camera = onlyObject<Camera>(imported(b));
    EXPECT_EQ(camera.name, "Eye");
    EXPECT_EQ(camera.eye, glm::vec3(1, 2, 3));
    expectNear(glm::normalize(camera.target - camera.eye), {-1, 0, 0});
    expectNear(camera.up, {0, 1, 0});
    EXPECT_FLOAT_EQ(camera.fovY, 0.7f);
}

TEST(GltfImport, ASkinnedMeshStandsInItsBindPose) {
    GltfBuilder b = triangleScene();
    // The joint scales by 0.01 and the bind matrix is the identity: the mesh is in centimetres.
    const int bind =
        b.accessor(b.view(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
                   "MAT4", GltfBuilder::kFloat, 1);
    b.json["skins"] = {{{"joints", {1}}, {"inverseBindMatrices", bind}}};
    b.json["nodes"][0]["skin"] = 0;
    b.json["nodes"][0]["translation"] = {50, 0, 0}; // to be ignored
    b.json["nodes"].push_back({{"scale", {0.01, 0.01, 0.01}}});
    b.json["scenes"][0]["nodes"].push_back(1);
    const ImportedScene scene = imported(b);
    expectNear(flatten(scene.document, scene.assets).bounds.upper, {0.01f, 0.01f, 0});
}

TEST(GltfImport, TheHashFollowsFileAndBuffers) {
    const TemporaryFolder folder;
    GltfBuilder b = triangleScene();
    b.json["buffers"] = {{{"uri", "s.bin"}, {"byteLength", b.bytes.size()}}};
    const auto hash = [&] {
        writeFile(folder.file("s.gltf"), b.json.dump());
        writeFile(folder.file("s.bin"), b.bytes);
        return importGltf(folder.file("s.gltf"))->document.sceneHash;
    };
    const std::uint64_t first = hash();
    EXPECT_EQ(hash(), first);
    b.bytes[0] = 1;
    const std::uint64_t second = hash();
    EXPECT_NE(second, first);
    b.json["nodes"][0]["name"] = "renamed";
    EXPECT_NE(hash(), second);
}

TEST(GltfImport, StopsWhenCancelled) {
    const TemporaryFolder folder;
    writeFile(folder.file("s.glb"), triangleScene().glb());
    const std::atomic<bool> cancel = true;
    const Result<ImportedScene> scene = importGltf(folder.file("s.glb"), {{}, &cancel});
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("cancelled"), std::string::npos);
}

} // namespace
} // namespace limn::gltf_import_test
