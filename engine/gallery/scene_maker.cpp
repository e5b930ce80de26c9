// SPDX-License-Identifier: MIT
#include "engine/gallery/scene_maker.h"

#include "engine/gallery/mesh_builder.h"
#include "engine/scene/mesh/mesh_repair.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

using glm::dvec2, glm::dvec3;

static constexpr double kScales[] = {0.01, 0.1, 0.3, 1, 1, 1, 3, 10, 100};
static constexpr double kThicknesses[] = {0.01, 0.03, 0.08, 0.15, 0.3, 0.5, 1};
static constexpr double kSpacings[] = {1e9, 1e9, 2, 1, 0.5, 0.25};

glm::quat turnBy(double t, glm::vec3 axis) {
    const double w = 1 / std::sqrt(1 + t * t);
    const glm::dvec3 v = glm::dvec3(axis) * (t * w);
    return {float(w), float(v.x), float(v.y), float(v.z)};
}

SceneMaker::SceneMaker(std::uint64_t seed) : random(seed) {
    traits.scale = kScales[random.whole(0, std::size(kScales) - 1)];
    traits.spacing = kSpacings[random.whole(0, std::size(kSpacings) - 1)];
    traits.scaledByNode = random.chance(0.3);
    traits.joined = random.chance(0.5);
    traits.textured = random.chance(0.4);
    if (random.chance(0.5))
        m_turn = turnBy(random.between(-1, 1));
    drawWalls();
    makeMaterials();
}

void SceneMaker::drawWalls() {
    const double draw = random.number();
    traits.walls = draw < 0.45  ? WallStyle::Solid
                   : draw < 0.7 ? WallStyle::TwoSided
                                : WallStyle::FacingIn;
    const double thickness = kThicknesses[random.whole(0, std::size(kThicknesses) - 1)];
    traits.thickness = traits.walls == WallStyle::Solid ? thickness : 0;
    const bool both = random.chance(0.35);
    traits.doubleSided =
        traits.walls == WallStyle::TwoSided || (traits.walls == WallStyle::Solid && both);
}

void SceneMaker::avoid(WallStyle style) {
    while (traits.walls == style)
        drawWalls();
    for (Material& m : m_materials)
        m.doubleSided = traits.doubleSided;
}

/// Adds a texture of squares with random greys and slight noise. `darkest` is the minimum of an
/// encoded texel, relative to 1.
std::int32_t SceneMaker::addImage(int size, int cells, double darkest) {
    Image image{"texture", std::uint32_t(size), std::uint32_t(size), {}};
    std::vector<double> greys(std::size_t(cells * cells));
    for (double& g : greys)
        g = random.between(darkest, 1);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double g = greys[std::size_t(y * cells / size * cells + x * cells / size)];
            for (int c = 0; c < 3; ++c)
                image.rgba.push_back(std::uint8_t(std::min(255.0, 235 * g + 20 * random.number())));
            image.rgba.push_back(255);
        }
    m_images.push_back(std::move(image));
    return std::int32_t(m_images.size() - 1);
}

void SceneMaker::makeMaterials() {
    static constexpr const char* kNames[] = {"Floor",    "Walls",    "Ceiling",
                                             "Things 1", "Things 2", "Things 3"};
    const double usual = random.between(0.2, 0.85); // so that some scenes are dark all over
    for (std::uint32_t part = 0; part < PartCount; ++part) {
        Material m;
        m.name = kNames[part];
        const double albedo = random.chance(0.5) ? usual : random.between(0.05, 0.9);
        const double tint = random.chance(0.5) ? 0 : random.between(0, 0.7);
        for (int c = 0; c < 3; ++c)
            m.baseColor[c] = float(std::max(0.05, albedo * (1 - tint * random.number())));
        m.doubleSided = traits.doubleSided;
        if (traits.textured && random.chance(0.7)) {
            const int cells = 2 << random.whole(0, 3);
            m.baseColorTexture.image = addImage(64, cells, 0.3);
        }
        m_materials.push_back(m);
    }
}

std::uint32_t SceneMaker::addLamp(glm::vec3 nits, bool picture) {
    Material m;
    m.name = fmt::format("Lamp {}", m_materials.size() - PartCount + 1);
    m.baseColor = glm::vec4(glm::vec3(float(random.between(0.1, 0.8))), 1);
    m.emission = nits;
    m.doubleSided = random.chance(0.3);
    if (picture) {
        const int cells = 2 << random.whole(0, 2);
        m.emissiveTexture.image = addImage(64, cells, 0);
    }
    m_materials.push_back(m);
    return std::uint32_t(m_materials.size() - 1);
}

/// Appends a mesh with the given transform.
static void append(Mesh& to, const Mesh& from, const Transform& placement) {
    const auto first = std::uint32_t(to.positions.size());
    for (std::size_t i = 0; i < from.positions.size(); ++i) {
        to.positions.push_back(placement.rotation * from.positions[i] +
                               glm::vec3(placement.translation));
        to.normals.push_back(placement.rotation * from.normals[i]);
    }
    to.uv0.insert(to.uv0.end(), from.uv0.begin(), from.uv0.end());
    for (const std::uint32_t i : from.indices)
        to.indices.push_back(first + i);
}

void SceneMaker::add(Mesh mesh, std::uint32_t part, const Transform& placement) {
    mesh.material = part;
    if (mesh.indices.empty())
        return;
    if (mesh.uv0.empty())
        projectUvs(mesh, 1.5);
    if (traits.joined) {
        const auto [found, isNew] = m_meshOfPart.emplace(part, m_meshes.size());
        if (!isNew) {
            append(m_meshes[found->second].first, mesh, placement);
            return;
        }
        Mesh first;
        first.name = m_materials[part].name;
        first.material = part;
        append(first, mesh, placement);
        m_meshes.emplace_back(std::move(first), Transform{});
        return;
    }
    if (mesh.name.empty())
        mesh.name = fmt::format("{} {}", m_materials[part].name, m_meshes.size());
    m_meshes.emplace_back(std::move(mesh), placement);
}

void SceneMaker::addBlocks(const Blocks& blocks, bool withFloor) {
    Mesh meshes[3], none;
    blocks.build(traits.spacing, [&](Facing facing) -> Mesh& {
        return facing == Facing::Up && !withFloor ? none : meshes[std::size_t(facing)];
    });
    add(std::move(meshes[std::size_t(Facing::Up)]), FloorPart);
    add(std::move(meshes[std::size_t(Facing::Down)]), CeilingPart);
    add(std::move(meshes[std::size_t(Facing::Sideways)]), WallPart);
}

void SceneMaker::addGround(double y, dvec2 lower, dvec2 upper) {
    Mesh mesh;
    const dvec2 size = upper - lower;
    const int nx = std::clamp(int(std::ceil(size.x / traits.spacing)), 1, 64);
    const int nz = std::clamp(int(std::ceil(size.y / traits.spacing)), 1, 64);
    addSheet(mesh, nz, nx, false, [&](double u, double v) { // z x x = y
        return dvec3(lower.x + v * size.x, y, lower.y + u * size.y);
    });
    add(std::move(mesh), FloorPart);
}

void SceneMaker::addThing(const Box& box, double turn) {
    const dvec3 half = box.size() / 2.0;
    Mesh mesh;
    addBox(mesh, -half, half);
    Transform placement;
    placement.translation = glm::vec3(box.at(0.5, 0.5, 0.5));
    placement.rotation = turnBy(turn);
    add(std::move(mesh), std::uint32_t(random.whole(FirstThing, LastThing)), placement);
}

dvec3 SceneMaker::toWorld(dvec3 p) const {
    return dvec3(m_turn * glm::vec3(p * traits.scale));
}

void SceneMaker::addLight(Light light) {
    light.position = glm::vec3(toWorld(dvec3(light.position)));
    light.direction = glm::normalize(m_turn * light.direction);
    light.size *= float(traits.scale);
    if (light.kind == LightKind::Point || light.kind == LightKind::Spot)
        light.strength *= float(traits.scale * traits.scale); // the same irradiance
    m_lights.push_back(light);
}

Camera SceneMaker::placed(dvec3 eye, dvec3 target, const char* name) {
    Camera camera;
    camera.name = name;
    camera.eye = glm::vec3(toWorld(eye));
    camera.target = glm::vec3(toWorld(target));
    camera.fovY = float(random.between(0.8, 1.2));
    return camera;
}

void SceneMaker::setCamera(dvec3 eye, dvec3 target) {
    m_camera = placed(eye, target, "Camera");
}

void SceneMaker::setDarkCamera(dvec3 eye, dvec3 target) {
    m_darkCamera = placed(eye, target, "Dark room");
}

glm::vec3 SceneMaker::lightColor() {
    if (random.chance(0.5))
        return glm::vec3(1);
    const float warm = float(random.between(0.4, 1));
    return random.chance(0.7) ? glm::vec3(1, (1 + warm) / 2, warm) : glm::vec3(warm, 1, 1);
}

static std::string described(const Traits& t) {
    std::string walls = t.walls == WallStyle::TwoSided ? "two-sided walls of no thickness"
                        : t.walls == WallStyle::FacingIn
                            ? "walls of no thickness that face in"
                            : fmt::format("solid walls {} m", t.thickness);
    return fmt::format("x {}{}, {}, {}, {}-sided, {}", t.scale, t.scaledByNode ? " by a node" : "",
                       walls, t.joined ? "one mesh per material" : "many meshes",
                       t.doubleSided ? "double" : "single", t.textured ? "textured" : "plain");
}

GeneratedScene SceneMaker::finish() {
    GeneratedScene scene;
    const auto assets = std::make_shared<Assets>();
    assets->images = std::move(m_images);
    for (const Material& m : m_materials)
        addObject(scene.document, m);
    Node root;
    root.name = "Scene";
    root.transform.rotation = m_turn;
    if (traits.scaledByNode)
        root.transform.scale = glm::vec3(float(traits.scale));
    const ObjectId rootId = addObject(scene.document, root);
    for (auto& [mesh, placement] : m_meshes) {
        Node node;
        node.parent = rootId;
        node.transform = placement;
        if (!traits.scaledByNode) {
            for (glm::vec3& p : mesh.positions)
                p *= float(traits.scale);
            node.transform.translation *= double(float(traits.scale));
        }
        removeBadTriangles(mesh);
        node.name = mesh.name;
        node.meshes = {std::uint32_t(assets->meshes.size())};
        assets->meshes.push_back(std::move(mesh));
        addObject(scene.document, std::move(node));
    }
    for (std::size_t i = 0; i < m_lights.size(); ++i) {
        m_lights[i].name = fmt::format("Light {}", i + 1);
        addObject(scene.document, m_lights[i]);
    }
    addObject(scene.document, m_sky);
    if (m_camera)
        addObject(scene.document, *m_camera);
    scene.darkCamera = m_darkCamera;
    scene.assets = assets;
    scene.description = described(traits);
    return scene;
}

} // namespace limn
