// SPDX-License-Identifier: MIT
#include "engine/export/gltf_scene.h"

#include "engine/core/parallel.h"
#include "engine/core/percent_encoding.h"
#include "engine/export/gltf_buffer.h"
#include "engine/export/gltf_light_json.h"
#include "engine/export/gltf_material_json.h"
#include "engine/export/vector_json.h"
#include "engine/files/image_file.h"
#include "engine/scene/light/ies_file.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <tuple>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// Which of a mesh's surfaces a primitive holds.
enum class Side : std::uint8_t {
    Whole, ///< the mesh as it is
    Front, ///< with vertices split along charts
    Back   ///< the same, turned round
};

/// A mesh as it is stored: its own vertices, or, where the transform of an instance has shear,
/// which nodes of glTF must not have, those in world space.
struct Shape {
    static constexpr std::uint32_t kNotPlaced = ~0U;
    std::uint32_t mesh = 0;
    std::uint32_t placed = kNotPlaced; ///< the instance
    auto operator<=>(const Shape&) const = default;
};

/// Whether columns of a transform are not orthogonal.
bool isSheared(const glm::mat4& toWorld) {
    constexpr float kTolerance = 1e-5f; // above the rounding of products of rotations
    const glm::mat3 m(toWorld);
    for (int a = 0; a < 3; ++a) {
        const glm::vec3 p = m[a], q = m[(a + 1) % 3];
        if (std::abs(glm::dot(p, q)) > kTolerance * glm::length(p) * glm::length(q))
            return true;
    }
    return false;
}

/// A glTF file in the making.
struct GltfScene {
    const ExportScene& in;
    const GltfOptions& options;
    GltfBuffer buffer;
    GltfMaterials materials;
    Json nodes = Json::array(), meshes = Json::array(), cameras = Json::array(),
         lights = Json::array(), areaLights = Json::array(), profiles = Json::array();
    std::map<std::shared_ptr<const LightProfile>, std::size_t> profileIndices;
    std::map<std::pair<Shape, Side>, Json> primitives; ///< without material and lightmap
    std::map<Shape, glm::mat4> toObject;               ///< from positions as stored

    /// The scene of meshes and charts: where charts are cut, not the exported one.
    const Scene& shapes() const { return options.cut ? options.cut->scene : in.scene; }
    std::uint32_t meshOf(std::uint32_t instance) const { return shapes().instances[instance].mesh; }
    Shape shapeOf(std::uint32_t instance) const {
        return {meshOf(instance),
                isSheared(in.scene.instances[instance].toWorld) ? instance : Shape::kNotPlaced};
    }
    const MeshCharts& chartsOf(std::uint32_t mesh) const {
        return options.cut ? options.cut->charts[mesh] : in.layout.meshes[mesh];
    }
    bool hasLightmap(std::uint32_t instance) const {
        return options.pages && instance < options.pages->instances.size() &&
               !options.pages->instances[instance][0].uv.empty();
    }
    const Json& primitive(Shape shape, Side side);
    Json lightmapPrimitive(std::uint32_t instance, bool back);
    Json onPage(Json primitive, std::uint32_t instance, bool back, std::uint32_t page);
    void addNode(std::uint32_t instance, Json primitiveList);
    void addLightmapped(std::uint32_t instance);
    void addInstance(std::uint32_t instance);
    std::size_t profileIndex(const ProfileRef& profile);
    void addLights();
    void addCameras();
};

std::string texCoordName(std::uint32_t set) {
    return fmt::format("TEXCOORD_{}", set);
}

/// The values at the vertices in `source`, or all if that is empty; nothing of no values.
template <class T>
std::vector<T> pick(const std::vector<T>& values, const std::vector<std::uint32_t>& source) {
    if (source.empty() || values.empty())
        return values;
    std::vector<T> picked;
    picked.reserve(source.size());
    for (const std::uint32_t v : source)
        picked.push_back(values[v]);
    return picked;
}

std::vector<std::uint32_t> turnedRound(std::vector<std::uint32_t> indices) {
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3)
        std::swap(indices[t + 1], indices[t + 2]);
    return indices;
}

/// Vertices in world space. Triangles keep their order: where the instance is mirrored, they have
/// to be turned round.
Mesh placedMesh(Mesh mesh, const Instance& instance) {
    const glm::mat3 linear(instance.toWorld);
    const float mirrored = glm::determinant(linear) < 0 ? -1.f : 1.f;
    const auto unit = [](glm::vec3 v, glm::vec3 otherwise) {
        const float length = glm::length(v);
        return length > 0 ? v / length : otherwise;
    };
    for (glm::vec3& p : mesh.positions)
        p = glm::vec3(instance.toWorld * glm::vec4(p, 1));
    for (glm::vec3& n : mesh.normals)
        n = unit(instance.normalToWorld * n, {0, 1, 0});
    for (glm::vec4& t : mesh.tangents)
        t = glm::vec4(unit(linear * glm::vec3(t), {1, 0, 0}), mirrored * t.w);
    return mesh;
}

const Json& GltfScene::primitive(Shape shape, Side side) {
    const auto [known, isNew] = primitives.try_emplace({shape, side});
    if (!isNew)
        return known->second;
    const std::uint32_t meshIndex = shape.mesh;
    const bool isPlaced = shape.placed != Shape::kNotPlaced;
    const Instance& instance = in.scene.instances[isPlaced ? shape.placed : 0];
    const Mesh& plain = shapes().assets->meshes[meshIndex];
    const Mesh placed = isPlaced ? placedMesh(plain, instance) : Mesh();
    const Mesh& mesh = isPlaced ? placed : plain;
    const bool turns =
        (side == Side::Back) != (isPlaced && glm::determinant(glm::mat3(instance.toWorld)) < 0);
    const bool split = side != Side::Whole;
    const std::vector<std::uint32_t> source =
        split ? chartsOf(meshIndex).sourceVertex : std::vector<std::uint32_t>();
    Json json;
    Json& attributes = json["attributes"];
    if (side == Side::Back) { // shares all but what turns round
        const Json front = primitive(shape, Side::Front);
        attributes = front["attributes"];
    } else {
        const std::vector<glm::vec3> positions = pick(mesh.positions, source);
        attributes["POSITION"] = buffer.addPositions(positions, toObject[shape]);
        if (!mesh.uv0.empty())
            attributes["TEXCOORD_0"] = buffer.addTexCoords(pick(mesh.uv0, source));
        for (std::uint32_t set = 1; set < 2 + mesh.furtherUv.size(); ++set)
            if (!mesh.uv(set).empty())
                attributes[texCoordName(exportedTexCoord(set))] =
                    buffer.addTexCoords(pick(mesh.uv(set), source));
        if (!mesh.colors.empty())
            attributes["COLOR_0"] = buffer.addColors(pick(mesh.colors, source));
    }
    std::vector<glm::vec3> normals = pick(mesh.normals, source);
    std::vector<glm::vec4> tangents = pick(mesh.tangents, source);
    if (side == Side::Back) {
        for (glm::vec3& n : normals)
            n = -n;
        for (glm::vec4& t : tangents) // keeps the bitangent
            t.w = -t.w;
    }
    attributes["NORMAL"] = buffer.addNormals(normals);
    if (!tangents.empty())
        attributes["TANGENT"] = buffer.addTangents(tangents);
    const std::vector<std::uint32_t>& indices = split ? chartsOf(meshIndex).indices : mesh.indices;
    json["indices"] = buffer.addIndices(turns ? turnedRound(indices) : indices,
                                        split ? source.size() : mesh.positions.size());
    return primitives[{shape, side}] = std::move(json);
}

/// One side of an instance, whatever the pages of its charts.
Json GltfScene::lightmapPrimitive(std::uint32_t instance, bool back) {
    Json json = primitive(shapeOf(instance), back ? Side::Back : Side::Front);
    Json& attributes = json["attributes"];
    attributes["TEXCOORD_1"] = buffer.addTexCoords(options.pages->instances[instance][back].uv);
    // Sets of coordinates are numbered without gaps.
    const Mesh& mesh = shapes().assets->meshes[meshOf(instance)];
    for (std::uint32_t set = exportedTexCoord(1 + std::uint32_t(mesh.furtherUv.size())); set-- > 0;)
        if (const std::string name = texCoordName(set);
            !attributes.contains(name) && (set == 0 || attributes.contains(texCoordName(set + 1))))
            attributes[name] = attributes["TEXCOORD_1"];
    return json;
}

/// The triangles of that primitive whose charts lie on a page; null if there is none.
Json GltfScene::onPage(Json primitive, std::uint32_t instance, bool back, std::uint32_t page) {
    const std::vector<std::uint32_t>& pageOfChart = options.pages->instances[instance][back].page;
    const MeshCharts& charts = chartsOf(meshOf(instance));
    const Instance& placed = in.scene.instances[instance];
    const bool turns = back != (shapeOf(instance).placed == instance &&
                                glm::determinant(glm::mat3(placed.toWorld)) < 0);
    std::vector<std::uint32_t> indices;
    for (std::size_t t = 0; t < charts.chartOfTriangle.size(); ++t)
        if (pageOfChart[charts.chartOfTriangle[t]] == page)
            indices.insert(indices.end(), {charts.indices[3 * t], charts.indices[3 * t + 1],
                                           charts.indices[3 * t + 2]});
    if (indices.empty())
        return {};
    if (indices.size() < charts.indices.size())
        primitive["indices"] =
            buffer.addIndices(turns ? turnedRound(indices) : indices, charts.sourceVertex.size());
    return primitive;
}

void GltfScene::addNode(std::uint32_t i, Json primitiveList) {
    const Instance& instance = in.scene.instances[i];
    Json node;
    const auto object = in.document.objects.find(instance.node);
    if (object != in.document.objects.end())
        node["name"] = objectName(object->second);
    node["mesh"] = meshes.size();
    const Shape shape = shapeOf(i);
    const glm::mat4 placement = shape.placed == i ? glm::mat4(1) : instance.toWorld;
    if (const glm::mat4 toWorld = placement * toObject[shape]; toWorld != glm::mat4(1))
        node["matrix"] = matrixJson(toWorld);
    if (i < options.reflections.size() && options.reflections[i] > 0)
        node["extras"]["limn"]["reflection"] = options.reflections[i];
    meshes.push_back(
        {{"name", in.scene.meshOf(instance).name}, {"primitives", std::move(primitiveList)}});
    nodes.push_back(std::move(node));
}

void GltfScene::addLightmapped(std::uint32_t i) {
    const Instance& instance = in.scene.instances[i];
    const bool both = !options.pages->instances[i][1].uv.empty();
    std::vector<Json> sides = {lightmapPrimitive(i, false)};
    if (both)
        sides.push_back(lightmapPrimitive(i, true));
    for (std::uint32_t page = 0; page < options.pages->count; ++page) {
        Json list = Json::array();
        for (std::size_t side = 0; side < sides.size(); ++side) {
            Json json = onPage(sides[side], i, side == 1, page);
            if (json.isNull())
                continue;
            json["material"] =
                materials.index(in.scene.materialOf(instance), instance.material, both, page);
            list.push_back(std::move(json));
        }
        if (!list.empty())
            addNode(i, std::move(list));
    }
}

void GltfScene::addInstance(std::uint32_t i) {
    if (hasLightmap(i))
        return addLightmapped(i);
    const Instance& instance = in.scene.instances[i];
    Json json = primitive(shapeOf(i), Side::Whole);
    json["material"] = materials.index(in.scene.materialOf(instance), instance.material, false, 0);
    addNode(i, Json::array({std::move(json)}));
}

std::size_t GltfScene::profileIndex(const ProfileRef& profile) {
    const auto [known, isNew] = profileIndices.try_emplace(profile.profile, profiles.size());
    if (isNew)
        profiles.push_back({{"name", profile->name},
                            {"bufferView", buffer.addFile(writeIes(*profile))},
                            {"mimeType", "application/x-ies-lm-63"}});
    return known->second;
}

void GltfScene::addLights() {
    for (const Light& light : in.scene.lights) {
        if (!shines(light))
            continue;
        nodes.push_back(lightNode(light));
        Json& extensions = nodes.back()["extensions"];
        if (light.kind == LightKind::Rectangle) {
            extensions["EXT_lights_area"]["light"] = areaLights.size();
            areaLights.push_back(areaLightJson(light));
            continue;
        }
        extensions["KHR_lights_punctual"]["light"] = lights.size();
        lights.push_back(lightJson(light));
        if (options.profiles && profileOf(light))
            extensions["EXT_lights_ies"] = profileUseJson(light, profileIndex(light.profile));
    }
}

void GltfScene::addCameras() {
    const float zNear = std::max(glm::length(in.scene.bounds.size()) * 1e-4f, 1e-6f);
    for (const Camera& camera : in.scene.cameras) {
        nodes.push_back(cameraNode(camera, cameras.size()));
        cameras.push_back(cameraJson(camera, zNear));
    }
}

Result<std::vector<ExportFile>> imageFiles(const GltfScene& gltf, const std::string& stem,
                                           const Progress& progress) {
    std::vector<ExportFile> files;
    for (std::size_t i = 0; i < gltf.materials.images.size(); ++i) {
        if (progress.cancelled())
            return fail("cancelled");
        progress.at("textures", float(i) / float(gltf.materials.images.size()));
        const Image& image = gltf.in.scene.assets->images[std::size_t(gltf.materials.images[i])];
        Result<std::string> png = encodePng(image);
        if (!png)
            return fail(fmt::format("image \"{}\": {}", image.name, png.error().message));
        files.push_back({fmt::format("{}-texture-{}.png", stem, i), std::move(*png)});
    }
    return files;
}

/// Adds the member unless it is empty: glTF forbids empty arrays.
void addArray(Json& json, const char* key, Json& array) {
    if (!array.empty())
        json[key] = std::move(array);
}

/// Puts images into the buffer and returns what names them there.
Json packedImages(GltfScene& gltf, const std::vector<ExportFile>& images) {
    Json list = Json::array();
    for (const ExportFile& image : images)
        list.push_back(
            {{"bufferView", gltf.buffer.addFile(image.bytes)}, {"mimeType", "image/png"}});
    return list;
}

Json namedImages(const std::vector<ExportFile>& images) {
    Json list = Json::array();
    for (const ExportFile& image : images)
        list.push_back({{"uri", percentEncoded(image.name)}});
    return list;
}

/// Names the extensions of how geometry is stored, without which no consumer can read it.
void addPackingExtensions(GltfScene& gltf, Json& json) {
    std::vector<std::string> required;
    if (gltf.buffer.unpackedBytes > 0)
        required.emplace_back("EXT_meshopt_compression");
    if (gltf.options.packing.quantize)
        required.emplace_back("KHR_mesh_quantization");
    gltf.materials.extensions.insert(required.begin(), required.end());
    if (!required.empty())
        json["extensionsRequired"] = std::move(required);
}

/// `bufferName` is empty where the buffer is part of the file.
Json documentJson(GltfScene& gltf, const std::string& bufferName, Json imageList) {
    const glm::dvec3 origin = gltf.in.document.origin;
    Json children = Json::array();
    for (std::size_t n = 0; n < gltf.nodes.size(); ++n)
        children.push_back(n);
    Json root = {{"name", "Limn"}, {"children", std::move(children)}};
    if (origin != glm::dvec3(0))
        root["translation"] = vectorJson(origin);
    gltf.nodes.push_back(std::move(root));

    Json json = {{"asset", {{"version", "2.0"}, {"generator", "Limn"}}}};
    if (!gltf.options.extras.isNull())
        json["asset"]["extras"]["limn"] = gltf.options.extras;
    std::set<std::string>& used = gltf.materials.extensions;
    for (const auto& [name, lights] : {std::pair("KHR_lights_punctual", &gltf.lights),
                                       {"EXT_lights_area", &gltf.areaLights},
                                       {"EXT_lights_ies", &gltf.profiles}}) {
        if (lights->empty())
            continue;
        used.insert(name);
        json["extensions"][name]["lights"] = std::move(*lights);
    }
    addPackingExtensions(gltf, json);
    if (!used.empty())
        json["extensionsUsed"] = std::vector<std::string>(used.begin(), used.end());
    json["scene"] = 0;
    json["scenes"] = {{{"nodes", {gltf.nodes.size() - 1}}}};
    addArray(json, "nodes", gltf.nodes);
    addArray(json, "meshes", gltf.meshes);
    addArray(json, "cameras", gltf.cameras);
    addArray(json, "materials", gltf.materials.materials);
    addArray(json, "textures", gltf.materials.textures);
    addArray(json, "samplers", gltf.materials.samplers);
    addArray(json, "images", imageList);
    Json buffer = {{"byteLength", gltf.buffer.bytes.size()}};
    if (!bufferName.empty())
        buffer["uri"] = percentEncoded(bufferName);
    json["buffers"] = Json::array({std::move(buffer)});
    if (gltf.buffer.unpackedBytes > 0) {
        Json unpacked = {{"byteLength", gltf.buffer.unpackedBytes}};
        unpacked["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
        json["buffers"].push_back(std::move(unpacked));
    }
    json["bufferViews"] = std::move(gltf.buffer.views);
    json["accessors"] = std::move(gltf.buffer.accessors);
    return json;
}

} // namespace

std::uint64_t gltfBytes(const ExportScene& scene, GltfPacking packing) {
    std::uint64_t geometry = 0;
    for (const Mesh& mesh : scene.scene.assets->meshes)
        geometry += mesh.positions.size() * 48 + mesh.indices.size() * 4;
    // Shares of the atrium, which docs/export.md has.
    std::uint64_t bytes = geometry * (packing.quantize ? 54 : 100) / 100;
    bytes = bytes * (packing.meshopt ? 59 : 100) / 100;
    for (const Image& image : scene.scene.assets->images)
        bytes += image.rgba.size() / 2;
    return bytes;
}

std::string stemOf(const std::string& fileName) {
    return std::filesystem::path(fileName).stem().string();
}

Result<std::vector<ExportFile>> gltfFiles(const ExportScene& scene, const GltfOptions& options,
                                          const std::string& name, const Progress& progress) {
    if (scene.scene.instances.empty())
        return fail("the scene has no surfaces");
    GltfScene gltf{scene, options, {.packing = options.packing}};
    for (std::uint32_t i = 0; i < scene.scene.instances.size(); ++i) {
        if (progress.cancelled())
            return fail("cancelled");
        progress.at("geometry", float(i) / float(scene.scene.instances.size()));
        gltf.addInstance(i);
    }
    gltf.addLights();
    gltf.addCameras();
    const std::string stem = stemOf(name);
    Result<std::vector<ExportFile>> images = imageFiles(gltf, stem, progress);
    if (!images)
        return images;
    std::vector<ExportFile> files;
    if (name.ends_with(".glb")) {
        Json list = packedImages(gltf, *images);
        const Json json = documentJson(gltf, "", std::move(list));
        Result<std::string> packed = binaryGltf(json, gltf.buffer.bytes);
        if (!packed)
            return tl::make_unexpected(packed.error());
        files.push_back({name, std::move(*packed)});
        return files;
    }
    const std::string bufferName = stem + "-geometry.bin";
    const Json json = documentJson(gltf, bufferName, namedImages(*images));
    files.push_back({name, json.dump(1) + "\n"});
    files.push_back({bufferName, std::move(gltf.buffer.bytes)});
    for (ExportFile& image : *images)
        files.push_back(std::move(image));
    return files;
}

} // namespace limn
