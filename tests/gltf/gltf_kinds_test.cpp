// SPDX-License-Identifier: MIT
// Kinds of files that other programs write, beyond what the specification's examples show.
#include "engine/core/base64.h"
#include "engine/gltf/data_uri.h"
#include "engine/gltf/gltf_chunks.h"
#include "engine/gltf/gltf_import.h"
#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/surface/dielectric.h"
#include "tests/gltf/gltf_builder.h"
#include "tests/scene/small_ktx2.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn::gltf_kinds_test {
namespace {

/// The builder's JSON with its buffer in a URI of this media type.
Result<ImportedScene> importText(const GltfBuilder& b, std::string_view header) {
    nlohmann::json json = b.json;
    json["buffers"] = {{{"byteLength", b.bytes.size()},
                        {"uri", fmt::format("data:{},{}", header, base64(b.bytes))}}};
    const TemporaryFolder folder;
    writeFile(folder.file("scene.gltf"), json.dump());
    return importGltf(folder.file("scene.gltf"));
}

bool reports(const ImportedScene& scene, std::string_view words) {
    return std::ranges::any_of(scene.repairs, [&](const std::string& line) {
        return line.find(words) != std::string::npos;
    });
}

const Material& materialOf(const ImportedScene& scene, std::size_t mesh = 0) {
    std::size_t k = 0;
    for (const auto& [id, object] : scene.document.objects)
        if (const auto* m = std::get_if<Material>(&object);
            m && k++ == scene.assets->meshes[mesh].material)
            return *m;
    static const Material kNone;
    return kNone;
}

TEST(DataUri, IsDecodedWhateverItsMediaType) {
    for (const char* header : {"data:;base64", "data:image/jpg;base64", "DATA:image/PNG;Base64",
                               "data:application/octet-stream;charset=utf-8;base64"})
        EXPECT_EQ(dataOfUri(std::string(header) + ",bGlnaHQ=").value_or("?"), "light") << header;
    EXPECT_EQ(dataOfUri("data:,a%20b").value_or("?"), "a b");
    EXPECT_EQ(dataOfUri("data:;base64,bG ln\naHQ").value_or("?"), "light");
    EXPECT_EQ(dataOfUri("data:;base64,").value_or("?"), "");
    EXPECT_FALSE(dataOfUri("data:;base64,b*"));
    EXPECT_FALSE(dataOfUri("data:;base64,bGln=aHQ="));
    EXPECT_FALSE(dataOfUri("data:image/png"));
    EXPECT_FALSE(dataOfUri("file.png"));
}

TEST(GltfKinds, BuffersInUrisOfAnyMediaType) {
    const GltfBuilder b = triangleScene();
    for (const char* header : {"application/octet-stream;base64", "model/gltf-buffer;base64",
                               "application/octet-stream;charset=utf-8;base64", ";base64"}) {
        const Result<ImportedScene> scene = importText(b, header);
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->assets->meshes.at(0).positions.at(1), glm::vec3(1, 0, 0));
    }
    nlohmann::json json = b.json;
    json["buffers"] = {{{"byteLength", b.bytes.size()}, {"uri", "data:;base64,AAAA"}}};
    const TemporaryFolder folder;
    writeFile(folder.file("scene.gltf"), json.dump());
    const Result<ImportedScene> scene = importGltf(folder.file("scene.gltf"));
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("buffers[0].uri: has 3 bytes of"), std::string::npos)
        << scene.error().message;
}

/// An image that cannot be decoded takes none of its neighbours' data.
TEST(GltfKinds, ImagesKeepTheirPlaces) {
    GltfBuilder b = triangleScene();
    b.json["images"] = {{{"uri", "data:image/webp;base64,UklGRg=="}},
                        {{"uri", ""}},
                        {{"name", "lost"}},
                        {{"uri", "none.png"}, {"bufferView", 0}, {"mimeType", "image/png"}},
                        {{"uri", "missing.png"}}};
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->assets->images.size(), 5U);
    for (const Image& image : scene->assets->images)
        EXPECT_EQ(image.rgba, std::vector<std::uint8_t>(4, 255));
    EXPECT_TRUE(reports(*scene, "image 1 'images[1]' has no data"));
    EXPECT_TRUE(reports(*scene, "image 2 'lost' has no data"));
    EXPECT_TRUE(reports(*scene, "image 3 'none.png' has both a uri and a buffer view"));
    EXPECT_TRUE(reports(*scene, "image 4 'missing.png' cannot be read"));
}

/// A surface whose emissive texture is missing does not shine as if that were white.
TEST(GltfKinds, NothingShinesByAMissingTexture) {
    const auto emission = [](const nlohmann::json& texture, bool hasImage) {
        GltfBuilder b = triangleScene();
        b.json["meshes"][0]["primitives"][0]["material"] = 0;
        b.json["images"] = {{{"uri", "missing.png"}}};
        b.json["textures"] = {nlohmann::json::object()};
        if (hasImage)
            b.json["textures"][0]["source"] = 0;
        b.json["materials"] = {{{"emissiveFactor", {2, 1, 0.5}}, {"emissiveTexture", texture}}};
        const Result<ImportedScene> scene = b.import();
        EXPECT_TRUE(scene) << scene.error().message;
        return materialOf(*scene).emission;
    };
    EXPECT_EQ(emission({{"index", 0}}, true), glm::vec3(0));
    EXPECT_EQ(emission({{"index", 0}}, false), glm::vec3(0));
    EXPECT_EQ(emission({{"index", 0}, {"texCoord", 2}}, true), glm::vec3(0));
    EXPECT_EQ(emission({{"index", 0}, {"texCoord", 99}}, true), glm::vec3(0));
}

TEST(GltfKinds, WholeNumbersMayHaveAPoint) {
    GltfBuilder b = triangleScene();
    const int t = b.vec3({{1, 0, 0}, {3, 0, 0}});
    b.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        double(t);
    b.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0.0}}}}}});
    b.json["scenes"][0]["nodes"] = {0.0, 1.0};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    b.json["accessors"][0]["count"] = 3.0;
    std::string glb = b.glb();
    ASSERT_NE(glb.find("\"light\":0.0"), std::string::npos); // as it was written
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    EXPECT_EQ(flat.instances.size(), 2U);
    EXPECT_EQ(flat.lights.size(), 1U);
}

std::string chunk(std::uint32_t type, std::string bytes) {
    const auto size = std::uint32_t(bytes.size());
    std::string out(8, '\0');
    std::memcpy(out.data(), &size, 4);
    std::memcpy(out.data() + 4, &type, 4);
    return out + bytes;
}
std::string glbOf(const std::string& chunks) {
    const std::uint32_t version = 2, length = std::uint32_t(12 + chunks.size());
    std::string out = "glTF" + std::string(8, '\0');
    std::memcpy(out.data() + 4, &version, 4);
    std::memcpy(out.data() + 8, &length, 4);
    return out + chunks;
}

TEST(GlbChunks, OfUnknownTypeArePassedOver) {
    const std::string json = chunk(0x4E4F534A, "{}  "), unknown = chunk(0x58585858, "abcd"),
                      binary = chunk(0x004E4942, "1234");
    const std::string all = glbOf(json + unknown + binary + unknown);
    const Result<GltfChunks> split = splitGltf(all);
    ASSERT_TRUE(split) << split.error().message;
    EXPECT_EQ(split->json, "{}  ");
    EXPECT_EQ(split->binary.value_or(""), "1234");
    const std::string empty = glbOf(json + chunk(0x004E4942, ""));
    EXPECT_EQ(splitGltf(empty)->binary.value_or("?"), "");
    EXPECT_FALSE(splitGltf(glbOf(unknown + json)));
    EXPECT_FALSE(splitGltf(all.substr(0, all.size() - 3)));
    std::string longer = glbOf(json + binary);
    longer[12 + 8 + 4] = 100; // the length of the binary chunk
    EXPECT_FALSE(splitGltf(longer));
}

TEST(GltfKinds, AnEmptyBinaryChunkIsAsNone) {
    const GltfBuilder b = triangleScene();
    nlohmann::json json = b.json;
    json["buffers"] = {
        {{"byteLength", b.bytes.size()}, {"uri", fmt::format("data:;base64,{}", base64(b.bytes))}}};
    const TemporaryFolder folder;
    const auto import = [&](const nlohmann::json& text) {
        writeFile(folder.file("x.glb"),
                  glbOf(chunk(0x4E4F534A, text.dump()) + chunk(0x004E4942, "")));
        return importGltf(folder.file("x.glb"));
    };
    EXPECT_TRUE(import(json));
    EXPECT_TRUE(import({{"asset", {{"version", "2.0"}}}}));
    json["buffers"][0].erase("uri");
    EXPECT_NE(import(json).error().message.find("buffers[0].uri: missing"), std::string::npos);
}

TEST(GltfKinds, VertexColoursAreFactorsUpToOne) {
    GltfBuilder b = triangleScene();
    b.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        b.vec3({{4, 0.5f, -1}, {1, 1, 1}, {0, 0, 0}});
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->assets->meshes[0].colors[0], glm::vec4(1, 0.5f, 0, 1));
    EXPECT_TRUE(reports(*scene, "1 vertex colors out of range"));
}

/// Primitives of one vertex buffer keep the vertices that each of them uses.
TEST(GltfKinds, PrimitivesMayShareAVertexBuffer) {
    constexpr std::size_t kVertices = 30000, kPrimitives = 500;
    GltfBuilder b;
    std::vector<glm::vec3> positions;
    for (std::size_t i = 0; i < kVertices; ++i)
        positions.emplace_back(float(i), float(i % 2), 0);
    const int position = b.vec3(positions);
    for (std::size_t k = 0; k < kPrimitives; ++k) {
        const auto first = std::uint16_t(50 * k);
        b.mesh(
            {{"attributes", {{"POSITION", position}}},
             {"indices", b.indices({first, std::uint16_t(first + 1), std::uint16_t(first + 2)})}});
    }
    const TemporaryFolder folder;
    writeFile(folder.file("x.glb"), b.glb());
    ImportOptions options;
    options.memory.maxBytes = std::uint64_t(20) << 20;
    const Result<ImportedScene> scene = importGltf(folder.file("x.glb"), {}, options);
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->assets->meshes.size(), kPrimitives);
    for (const Mesh& mesh : scene->assets->meshes)
        EXPECT_EQ(mesh.positions.size(), 3U);
    EXPECT_EQ(scene->assets->meshes[7].positions[2], glm::vec3(352, 0, 0));
}

TEST(GltfKinds, MorphTargetsAreAppliedAtTheirDefaultWeights) {
    GltfBuilder b = triangleScene();
    b.json["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", b.vec3({{0, 0, 2}, {0, 0, 2}, {0, 0, 2}})}},
        {{"POSITION", b.vec3({{0, 0, 4}, {0, 0, 0}, {0, 0, 0}})}}};
    b.json["meshes"][0]["weights"] = {0.5, 0};
    b.json["nodes"].push_back({{"mesh", 0}, {"weights", {0, 0.25}}});
    b.json["scenes"][0]["nodes"].push_back(1);
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    ASSERT_EQ(flat.instances.size(), 2U);
    EXPECT_EQ(flat.meshOf(flat.instances[0]).positions[1], glm::vec3(1, 0, 1));
    EXPECT_EQ(flat.meshOf(flat.instances[1]).positions[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(flat.meshOf(flat.instances[1]).positions[1], glm::vec3(1, 0, 0));
}

TEST(GltfKinds, NodesMayBeHidden) {
    GltfBuilder b = triangleScene();
    const nlohmann::json hidden = {{"KHR_node_visibility", {{"visible", false}}}},
                         light = {{"KHR_lights_punctual", {{"light", 0}}}};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    b.json["nodes"] = {{{"mesh", 0}},
                       {{"children", {2}}, {"extensions", hidden}},
                       {{"mesh", 0}, {"extensions", light}},
                       {{"extensions", light}}};
    b.json["scenes"][0]["nodes"] = {0, 1, 3};
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    EXPECT_EQ(flat.instances.size(), 1U);
    EXPECT_EQ(std::ranges::count_if(flat.lights, &Light::enabled), 1);
}

/// Rectangles shine along -Z of their node, and their size follows its largest scale.
TEST(GltfKinds, AreaLightsAreRectangles) {
    GltfBuilder b = triangleScene();
    b.json["extensions"]["EXT_lights_area"]["lights"] = {{{"type", "rect"},
                                                          {"size", 0.5},
                                                          {"rect", {{"aspect", 3}}},
                                                          {"intensity", 40},
                                                          {"color", {1, 0.5, 0.25}}},
                                                         {{"type", "disk"}, {"size", 2}}};
    const float h = std::sqrt(0.5f);
    const auto light = [](int index) {
        return nlohmann::json{{"EXT_lights_area", {{"light", index}}}};
    };
    b.json["nodes"].push_back({{"translation", {1, 2, 3}},
                               {"rotation", {0, h, 0, h}}, // -z becomes -x, and x becomes -z
                               {"scale", {1, 2, 1}},
                               {"extensions", light(0)}});
    b.json["nodes"].push_back({{"rotation", {0, 0, h, h}}, {"extensions", light(1)}});
    b.json["nodes"].push_back({{"extensions", light(7)}});
    b.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    ASSERT_EQ(flat.lights.size(), 2U);
    const LightRectangle r = lightRectangle(flat.lights[0]);
    EXPECT_LT(glm::distance(r.centre, {1, 2, 3}), 1e-6f);
    EXPECT_LT(glm::distance(r.normal, {-1, 0, 0}), 1e-6f);
    EXPECT_LT(glm::distance(glm::abs(r.halfWidth), {0, 0, 1.5f}), 1e-5f);
    EXPECT_LT(glm::distance(glm::abs(r.halfHeight), {0, 0.5f, 0}), 1e-5f);
    EXPECT_EQ(flat.lights[0].strength, 40);
    EXPECT_EQ(flat.lights[0].color, glm::vec3(1, 0.5f, 0.25f));
    const LightRectangle square = lightRectangle(flat.lights[1]);
    EXPECT_NEAR(square.area, std::acos(-1.f), 1e-5f); // of a disc of radius 1
    EXPECT_LT(std::abs(square.halfWidth.x), 1e-6f);   // turned by its node
    EXPECT_EQ(flat.lights[1].strength, 1000);
}

/// Photometric files shine along -Z of their node, and their horizontal angle 0 is its X.
TEST(GltfKinds, PhotometricFilesAreProfilesOfPoints) {
    GltfBuilder b = triangleScene();
    const std::string file = "data:application/x-ies-lm-63,TILT=NONE%0A1 -1 2 2 5 1 2 0 0 0%0A1 1 9"
                             "%0A0 90%0A0 90 180 270 360%0A"
                             "8 50 8 0 8 0 8 0 8 50";
    b.json["extensions"]["EXT_lights_ies"]["lights"] = {
        {{"uri", file}, {"name", "Lamp"}}, {{"uri", "missing.ies"}}, {{"bufferView", 999}}};
    const auto light = [](int index, double multiplier) {
        return nlohmann::json{
            {"EXT_lights_ies",
             {{"light", index}, {"multiplier", multiplier}, {"color", {1, 0.5, 0.25}}}}};
    };
    const float h = std::sqrt(0.5f);
    b.json["nodes"].push_back({{"translation", {1, 2, 3}},
                               {"rotation", {0, h, 0, h}}, // -z becomes -x, and x becomes -z
                               {"scale", {5, 5, 5}},
                               {"extensions", light(0, 0.5)}});
    for (const int missing : {1, 2, 3})
        b.json["nodes"].push_back({{"extensions", light(missing, 1)}});
    b.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4};
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    ASSERT_EQ(flat.lights.size(), 1U);
    const Light& lamp = flat.lights[0];
    ASSERT_TRUE(lamp.profile);
    EXPECT_EQ(lamp.color, glm::vec3(1, 0.5f, 0.25f));
    const auto towards = [&](glm::vec3 d) {
        return sampleLight(lamp, lamp.position + 2.f * d).irradiance.x * 4;
    };
    EXPECT_NEAR(towards({-1, 0, 0}), 8, 1e-3f);
    EXPECT_NEAR(towards({0, 0, -1}), 50, 1e-3f);
    EXPECT_NEAR(towards({0, 0, 1}), 0, 1e-3f);
    EXPECT_NEAR(towards({0, 1, 0}), 0, 1e-3f);
    EXPECT_EQ(towards({1, 0, 0}), 0);
    for (const char* defect : {"EXT_lights_ies.lights[1]", "EXT_lights_ies.lights[2]", "nodes[4]"})
        EXPECT_TRUE(std::ranges::any_of(scene->repairs, [&](const std::string& repair) {
            return repair.find(defect) != std::string::npos;
        })) << defect;
}

/// An image that only KHR_texture_basisu names is read where it is no Basis Universal; where it is,
/// the file is refused if it requires the extension.
TEST(GltfKinds, TexturesOfBasisuAreReadOrRefusedByName) {
    for (const bool isBasis : {false, true})
        for (const bool isRequired : {false, true}) {
            GltfBuilder b = triangleScene();
            const std::uint32_t format = isBasis ? 0 : 43;
            b.json["images"] = {{{"bufferView", b.view(ktx2(format, 1, 1, "\x20\x40\x60\x80"))},
                                 {"mimeType", "image/ktx2"}}};
            b.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
            b.json["materials"] = {
                {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
            b.json["extensionsUsed"] = {"KHR_texture_basisu"};
            if (isRequired)
                b.json["extensionsRequired"] = {"KHR_texture_basisu"};
            const Result<ImportedScene> scene = b.import();
            ASSERT_EQ(bool(scene), !isBasis || !isRequired);
            if (!scene) {
                EXPECT_NE(scene.error().message.find("images[0] 'images[0]' is KTX2 of Basis "
                                                     "Universal (UASTC), which is not read"),
                          std::string::npos)
                    << scene.error().message;
                continue;
            }
            ASSERT_EQ(scene->assets->images.size(), 1U);
            EXPECT_EQ(scene->assets->images[0].rgba,
                      isBasis ? std::vector<std::uint8_t>(4, 255)
                              : std::vector<std::uint8_t>({0x20, 0x40, 0x60, 0x80}));
        }
}

/// KHR_lights_punctual on the node of a profile is for readers without profiles; a sun is another
/// light.
TEST(GltfKinds, APointOnTheNodeOfAProfileIsTheSameLight) {
    GltfBuilder b = triangleScene();
    b.json["extensions"]["EXT_lights_ies"]["lights"] = {
        {{"uri",
          "data:application/x-ies-lm-63,TILT=NONE%0A1 -1 1 2 1 1 2 0 0 0%0A1 1 9%0A0 90%0A0%0A"
          "80 5"}}};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 3}, {"range", 4}, {"spot", {{"outerConeAngle", 0.5}}}},
        {{"type", "directional"}}};
    for (const int light : {0, 1})
        b.json["nodes"].push_back(
            {{"extensions",
              {{"EXT_lights_ies", {{"light", 0}}}, {"KHR_lights_punctual", {{"light", light}}}}}});
    b.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    ASSERT_EQ(flat.lights.size(), 3U);
    EXPECT_EQ(flat.lights[0].kind, LightKind::Spot);
    EXPECT_EQ(flat.lights[0].strength, 80);
    EXPECT_EQ(flat.lights[0].range, 4);
    EXPECT_TRUE(flat.lights[0].profile);
    EXPECT_EQ(flat.lights[1].kind, LightKind::Directional);
    EXPECT_FALSE(flat.lights[1].profile);
    EXPECT_EQ(flat.lights[2].kind, LightKind::Point);
    EXPECT_TRUE(flat.lights[2].profile);
}

/// A scale of 0 along one axis flattens, whatever stands below the node.
TEST(GltfKinds, AScaleOfZeroAlongOneAxisFlattens) {
    GltfBuilder b;
    b.mesh({{"attributes",
             {{"POSITION", b.vec3({{0, 5, 0}, {0, 3, 1}, {1, -2, 0}})},
              {"NORMAL", b.vec3({{0, 1, 0}, {0, 1, 0}, {0, 1, 0}})}}}});
    b.json["nodes"][0]["scale"] = {2, 0, 1};
    b.json["nodes"].push_back({{"scale", {1, 0, 1}}, {"children", {2}}});
    b.json["nodes"].push_back({{"mesh", 0}});
    b.json["nodes"].push_back({{"mesh", 0}, {"scale", {0, 0, 1}}});
    b.json["nodes"].push_back(
        {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    b.json["scenes"][0]["nodes"] = {0, 1, 3, 4};
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    const Scene flat = flatten(scene->document, scene->assets);
    ASSERT_EQ(flat.instances.size(), 3U); // all but the one that is a line
    for (const Instance& i : flat.instances) {
        const glm::vec3 corner(i.toWorld * glm::vec4(1, -2, 0, 1));
        EXPECT_NEAR(corner.y, 0, 1e-5f);
        EXPECT_GE(corner.x, 1);
        const glm::vec3 n = glm::normalize(i.normalToWorld * glm::vec3(0, 1, 0));
        EXPECT_NEAR(n.y, 1, 1e-6f);
    }
}

TEST(GltfKinds, SpecularGlossinessBecomesMetalAndRoughness) {
    const auto imported = [](const nlohmann::json& extension) {
        GltfBuilder b = triangleScene();
        b.json["meshes"][0]["primitives"][0]["material"] = 0;
        b.json["materials"] = {
            {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", extension}}}}};
        b.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
        const Result<ImportedScene> scene = b.import();
        EXPECT_TRUE(scene) << scene.error().message;
        return materialOf(*scene);
    };
    const Material paint = imported({{"diffuseFactor", {0.5, 0.25, 0.125, 1}},
                                     {"specularFactor", {0.04, 0.04, 0.04}},
                                     {"glossinessFactor", 0.25}});
    EXPECT_EQ(glm::vec3(paint.baseColor), glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(paint.metallic, 0);
    EXPECT_EQ(paint.roughness, 0.75f);
    EXPECT_NEAR(dielectricF0(paint.ior), 0.04f, 1e-6f);
    const Material varnish =
        imported({{"diffuseFactor", {0.5, 0.5, 0.5, 1}}, {"specularFactor", {0.2, 0.1, 0.3}}});
    EXPECT_NEAR(dielectricF0(varnish.ior), 0.2f, 1e-6f);
    const Material gold =
        imported({{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {1, 0.75, 0.25}}});
    EXPECT_EQ(glm::vec3(gold.baseColor), glm::vec3(1, 0.75f, 0.25f));
    EXPECT_EQ(gold.metallic, 1);
    EXPECT_EQ(gold.roughness, 0);
}

/// A triangle's material with extensions.
Material materialWith(const nlohmann::json& extensions, const nlohmann::json& more = {}) {
    GltfBuilder b = triangleScene();
    b.json["meshes"][0]["primitives"][0]["material"] = 0;
    b.json["materials"] = {{{"extensions", extensions}}};
    if (!more.is_null())
        b.json["materials"][0].update(more);
    return materialOf(imported(b));
}

/// Reflectance at normal incidence is that of the index of refraction times factor and colour.
TEST(GltfKinds, TheStrengthOfReflectionsIsThatOfAnotherIndexOfRefraction) {
    const auto f0 = [](const nlohmann::json& specular, double ior = 1.5) {
        return dielectricF0(materialWith({{"KHR_materials_specular", specular},
                                          {"KHR_materials_ior", {{"ior", ior}}}})
                                .ior);
    };
    EXPECT_NEAR(f0(nlohmann::json::object()), 0.04f, 1e-6f);
    EXPECT_NEAR(f0({{"specularFactor", 0.5}}), 0.02f, 1e-6f);
    EXPECT_NEAR(f0({{"specularFactor", 0}}), 0, 1e-6f);
    EXPECT_NEAR(f0({{"specularFactor", 0.5}}, 2), 0.5f / 9, 1e-6f);
    EXPECT_NEAR(f0({{"specularColorFactor", {3, 2, 1}}}), 0.08f, 1e-6f);
    EXPECT_NEAR(f0({{"specularColorFactor", {1e9, 1e9, 1e9}}}), 0.99f, 1e-4f);
    const Material glass =
        materialWith({{"KHR_materials_specular", {{"specularFactor", 0}}},
                      {"KHR_materials_transmission", {{"transmissionFactor", 1}}}});
    EXPECT_EQ(glass.ior, 1.5f);
}

TEST(GltfKinds, UnlitSurfacesSendTheirColourAndReflectNothing) {
    const Material m =
        materialWith({{"KHR_materials_unlit", nlohmann::json::object()}},
                     {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}}}}});
    EXPECT_EQ(m.emission, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(m.baseColor, glm::vec4(0, 0, 0, 0.75f));
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(dielectricF0(m.ior), 0);
}

TEST(GltfKinds, TexturesMayReadAnySetOfCoordinates) {
    GltfBuilder b = triangleScene();
    nlohmann::json& primitive = b.json["meshes"][0]["primitives"][0];
    for (int set = 0; set < 4; ++set) {
        std::vector<glm::vec2> uv(3, glm::vec2(float(set), 0.5f));
        primitive["attributes"]["TEXCOORD_" + std::to_string(set)] =
            b.accessor(b.view(uv), "VEC2", GltfBuilder::kFloat, 3);
    }
    primitive["material"] = 0;
    b.json["images"] = {{{"uri", "missing.png"}}};
    b.json["textures"] = {{{"source", 0}}};
    b.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 3}}}}}}};
    const Result<ImportedScene> scene = b.import();
    ASSERT_TRUE(scene) << scene.error().message;
    const Mesh& mesh = scene->assets->meshes[0];
    EXPECT_EQ(materialOf(*scene).baseColorTexture.texCoord, 3U);
    EXPECT_EQ(mesh.uv(3).at(0), glm::vec2(3, 0.5f));
    EXPECT_TRUE(mesh.uv(2).empty()); // which no texture reads
    EXPECT_EQ(mesh.uv(1).at(0), glm::vec2(1, 0.5f));
}

} // namespace
} // namespace limn::gltf_kinds_test
