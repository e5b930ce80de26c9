// SPDX-License-Identifier: MIT
#include "engine/gallery/hostile_scene.h"

#include "engine/gallery/hostile_shapes.h"
#include "engine/gallery/random_stream.h"
#include "engine/scene/mesh/mesh_repair.h"
#include "engine/scene/origin.h"
#include "engine/scene/placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using glm::dvec3;

/// Draws a scene within about a unit cube, then places it in the world.
class HostileMaker {
public:
    explicit HostileMaker(std::uint64_t seed) : m_random(seed ^ 0x686f7374696c65U) {}

    HostileScene make() {
        m_size = logBetween(1e-4, 1e4);
        if (m_random.chance(0.1))
            m_offset = direction() * (m_size * logBetween(1, 1e6));
        m_scaledByNode = m_random.chance(0.3);
        addMaterials();
        addShell();
        addObjects();
        HostileScene scene;
        for (const Material& m : m_materials)
            addObject(scene.document, m);
        for (const Node& node : m_nodes)
            m_ids.push_back(addObject(scene.document, node));
        scene.document.origin = originOf(scene.document, m_assets.meshes);
        addLights(scene.document);
        addSky();
        addSettings();
        for (auto& light : m_lights)
            addObject(scene.document, std::move(light));
        addObject(scene.document, m_sky);
        addObject(scene.document, m_settings);
        addObject(scene.document, m_relight);
        std::size_t triangles = 0;
        for (const Mesh& m : m_assets.meshes)
            triangles += m.triangleCount();
        scene.description = fmt::format(
            "{}, {:.2g} m, {:.2g} m away, {} objects, {} triangles, {} lights", m_shellName, m_size,
            glm::length(m_offset), m_nodes.size(), triangles, m_lights.size());
        scene.assets = std::make_shared<const Assets>(std::move(m_assets));
        return scene;
    }

private:
    double logBetween(double a, double b) {
        return std::exp(m_random.between(std::log(a), std::log(b)));
    }
    dvec3 direction() {
        const double z = m_random.between(-1, 1), a = m_random.between(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(a), r * std::sin(a), z};
    }
    dvec3 inRoom() {
        return {m_random.number() * m_room.x, m_random.number() * m_room.y,
                m_random.number() * m_room.z};
    }
    glm::vec3 color(double maximum) {
        return glm::vec3(dvec3(m_random.number(), m_random.number(), m_random.number()) * maximum);
    }
    bool isThing(double share) { return m_random.chance(share); }

    void addMaterials() {
        const int count = isThing(0.4) ? 1 : m_random.whole(2, 5);
        for (int k = 0; k < count; ++k) {
            Material m;
            m.name = fmt::format("Material {}", k + 1);
            static constexpr float kAlbedos[] = {0, 1, 0.99f, 0.5f};
            if (isThing(0.4))
                m.baseColor = glm::vec4(glm::vec3(kAlbedos[m_random.whole(0, 3)]), 1);
            else
                m.baseColor = glm::vec4(color(1), 1);
            m.metallic = isThing(0.2) ? float(m_random.number()) : 0;
            m.roughness = isThing(0.3) ? float(m_random.number()) : 1;
            if (isThing(0.15))
                m.emission = color(logBetween(1e-6, 1e6));
            m.doubleSided = isThing(0.3);
            if (isThing(0.03)) {
                m.alphaMode = isThing(0.5) ? AlphaMode::Mask : AlphaMode::Blend;
                m.baseColor.w = float(m_random.number());
            }
            m_materials.push_back(m);
        }
    }

    std::uint32_t addMesh(Mesh mesh) {
        if (!m_scaledByNode)
            for (glm::vec3& p : mesh.positions)
                p *= float(m_size);
        removeBadTriangles(mesh);
        if (mesh.normals.empty())
            generateFlatNormals(mesh);
        mendNormals(mesh);
        mesh.material = std::uint32_t(m_random.whole(0, int(m_materials.size()) - 1));
        m_assets.meshes.push_back(std::move(mesh));
        return std::uint32_t(m_assets.meshes.size() - 1);
    }

    /// Adds a node at `position`, in units of the room.
    void addNode(std::uint32_t mesh, dvec3 position, Transform t, bool dynamic) {
        Node node;
        node.name = fmt::format("Object {}", m_nodes.size() + 1);
        t.translation = position * m_size + m_offset;
        if (m_scaledByNode)
            t.scale *= float(m_size);
        node.transform = t;
        node.meshes = {mesh};
        node.dynamic = dynamic;
        m_nodes.push_back(std::move(node));
    }

    void addShell() {
        m_room = dvec3(m_random.between(0.3, 1), m_random.between(0.2, 0.6), 1);
        const double draw = m_random.number();
        Mesh shell;
        if (draw < 0.45) {
            m_shellName = "closed room";
            addFaces(shell, dvec3(0), m_room, AllFaces, true);
        } else if (draw < 0.55) {
            m_shellName = "ball";
            addBall(shell, m_room * 0.5, 0.5, m_random.whole(1, 3), true);
        } else if (draw < 0.7) {
            m_shellName = "floor";
            addFaces(shell, dvec3(0), m_room, NegativeY, true);
        } else if (draw < 0.9) {
            m_shellName = "open room";
            addFaces(shell, dvec3(0), m_room, AllFaces & ~(1U << m_random.whole(0, 5)), true);
        } else {
            m_shellName = "nothing";
            return;
        }
        addNode(addMesh(std::move(shell)), dvec3(0), {}, false);
    }

    Mesh thing() {
        Mesh mesh;
        const dvec3 size = dvec3(m_random.between(0.05, 0.4), m_random.between(0.05, 0.4),
                                 m_random.between(0.05, 0.4)) *
                           (isThing(0.1) ? logBetween(1e-4, 1) : 1);
        switch (m_random.whole(0, 8)) {
        case 0:
        case 1:
            addFaces(mesh, -size / 2.0, size / 2.0, AllFaces, false);
            break;
        case 2:
            addBall(mesh, dvec3(0), size.x / 2, m_random.whole(0, 2), false);
            break;
        case 3:
            addFaces(mesh, -size / 2.0, size / 2.0, 1U << m_random.whole(0, 5), isThing(0.5));
            break;
        case 4:
            addNeedles(mesh, size.x, logBetween(1e-6, 1e-2), m_random.whole(1, 6), m_random);
            break;
        case 5: { // faces that lie on each other, turned alike or not
            const unsigned face = 1U << m_random.whole(0, 5);
            const int copies = m_random.whole(2, 3);
            for (int k = 0; k < copies; ++k)
                addFaces(mesh, -size / 2.0, size / 2.0, face, isThing(0.5));
            break;
        }
        case 6: // without thickness, or next to none
            addFaces(mesh, -size / 2.0,
                     dvec3(size.x, size.y, isThing(0.5) ? -size.z : -size.z + 1e-6) / 2.0,
                     NegativeZ | PositiveZ, false);
            break;
        case 7: {
            const double large = m_random.number();
            const int n = large < 0.0005  ? 708
                          : large < 0.005 ? m_random.whole(30, 150)
                                          : m_random.whole(1, 8);
            addHills(mesh, size, n, m_random);
            break;
        }
        case 8: {
            const dvec3 a = inRoom() * 0.3, b = inRoom() * 0.3, c = inRoom() * 0.3;
            addTriangle(mesh, a, b, c);
            break;
        }
        }
        return mesh;
    }

    void addObjects() {
        const double draw = m_random.number();
        const int count = draw < 0.001  ? m_random.whole(500, 5000)
                          : draw < 0.01 ? m_random.whole(20, 200)
                                        : m_random.whole(0, isThing(0.5) ? 3 : 8);
        for (int k = 0; k < count; ++k) {
            const bool again = !m_assets.meshes.empty() && isThing(count > 10 ? 0.9 : 0.15);
            const std::uint32_t mesh =
                again ? std::uint32_t(m_random.whole(0, int(m_assets.meshes.size()) - 1))
                      : addMesh(thing());
            Transform t;
            if (isThing(0.4)) {
                const dvec3 axis = direction();
                const double half = m_random.between(0, std::numbers::pi);
                t.rotation = glm::quat(float(std::cos(half)), glm::vec3(axis * std::sin(half)));
            }
            if (isThing(0.3))
                t.scale = glm::vec3(dvec3(logBetween(0.3, 2), logBetween(0.3, 2), 1));
            if (isThing(0.1))
                t.scale.x = -t.scale.x;
            dvec3 position = inRoom();
            if (isThing(0.3)) // through a wall, or flush with it
                position[m_random.whole(0, 2)] = isThing(0.5) ? 0 : m_random.between(-0.1, 0.1);
            addNode(mesh, position, t, isThing(0.08));
        }
    }

    /// Position of a light in world space.
    glm::vec3 lightPlace(const Document& document) {
        if (isThing(0.15) && !m_nodes.empty()) { // on a triangle, or at its corner
            const auto index = std::size_t(m_random.whole(0, int(m_nodes.size()) - 1));
            const Mesh& mesh = m_assets.meshes[m_nodes[index].meshes[0]];
            if (mesh.triangleCount() > 0) {
                const auto k = mesh.triangle(std::size_t(m_random.bits() % mesh.triangleCount()));
                const glm::vec3 a = mesh.positions[k[0]], b = mesh.positions[k[1]],
                                c = mesh.positions[k[2]];
                const glm::vec3 p = isThing(0.3) ? a : (a + b + c) / 3.f;
                const glm::mat4 placed(Placements(document).of(m_ids[index]).toWorld);
                return placed * glm::vec4(p, 1);
            }
        }
        dvec3 position = inRoom();
        if (isThing(0.1))
            position[m_random.whole(0, 2)] = m_random.between(-0.3, 0);
        return toWorld(document.origin, position * m_size + m_offset);
    }

    void addLights(const Document& document) {
        const int count = isThing(0.02) ? m_random.whole(10, 32) : m_random.whole(0, 3);
        for (int k = 0; k < count; ++k) {
            Light l;
            l.name = fmt::format("Light {}", k + 1);
            l.kind = LightKind(m_random.whole(0, 3));
            l.enabled = !isThing(0.05);
            l.position = lightPlace(document);
            l.direction = glm::normalize(glm::vec3(direction()));
            l.color = isThing(0.3) ? glm::vec3(1) : color(1);
            double strength = logBetween(1e-6, 1e6);
            const bool ranged = l.kind == LightKind::Point || l.kind == LightKind::Spot;
            if (ranged && isThing(0.7))
                strength *= m_size * m_size; // about as bright in a room of any size
            l.strength = float(std::min(strength, 1e9));
            l.range = ranged && isThing(0.2) ? float(m_size * m_random.number()) : 0;
            l.outerAngle = float(m_random.between(0.05, 1.55));
            l.innerAngle = float(m_random.number()) * l.outerAngle;
            l.size = glm::clamp(
                glm::vec2(float(m_size * logBetween(0.01, 1)), float(m_size * logBetween(0.01, 1))),
                kMinLightSize, kMaxLightSize);
            l.roll = float(m_random.between(-3, 3));
            m_lights.push_back(l);
        }
    }

    void addSky() {
        if (isThing(0.5))
            return;
        const double strength = logBetween(1e-3, 1e3);
        m_sky.kind = isThing(0.5) ? SkyKind::Color : SkyKind::Gradient;
        m_sky.radiance = color(strength);
        m_sky.horizon = color(strength);
        m_sky.ground = color(strength);
    }

    void addSettings() {
        BakeSettings& s = m_settings;
        s.surfels = std::uint32_t(m_random.whole(64, 200));
        s.lightmapCaches = std::uint32_t(logBetween(1, 300));
        if (isThing(0.1))
            s.texelsPerMetre = float(std::min(logBetween(3, 12) / m_size, 9e5));
        s.links = std::uint32_t(isThing(0.1) ? 4096 : logBetween(1, 65));
        s.rays = std::uint32_t(logBetween(16, 200));
        s.bands = std::uint32_t(isThing(0.5) ? 3 : m_random.whole(2, 8));
        s.chromaBands = std::uint32_t(isThing(0.6) ? 0 : m_random.whole(0, 8));
        if (isThing(0.6))
            s.grid = {std::uint32_t(m_random.whole(1, 4)), std::uint32_t(m_random.whole(1, 4)),
                      std::uint32_t(m_random.whole(1, 4))};
        static constexpr std::uint32_t kBounces[] = {1, 2, 3, 8, 9, 1000, 1000, 1000};
        m_relight.maxBounces = kBounces[m_random.whole(0, 7)];
        m_relight.dynamicOcclusion = isThing(0.7);
        s.placement = SurfelPlacement(m_random.whole(0, 2));
        s.linker = isThing(0.75) ? Linker::Gather : Linker::FormFactor;
        s.cut = isThing(0.7) ? CutCriterion::Detail : CutCriterion::SolidAngle;
        s.storage = isThing(0.6) ? LinkStorage::Rtp : LinkStorage::Sh;
        s.clustering = isThing(0.7) ? Clustering::Agglomerative : Clustering::KdTree;
        if (isThing(0.2)) {
            s.clusterNormalWeight = float(logBetween(1e-3, 100));
            s.clusterBalanceWeight = float(logBetween(1e-3, 100));
        }
    }

    RandomStream m_random;
    double m_size = 1;
    dvec3 m_offset{0}, m_room{1};
    bool m_scaledByNode = false;
    std::string m_shellName;
    Assets m_assets;
    std::vector<Material> m_materials;
    std::vector<Node> m_nodes;
    std::vector<ObjectId> m_ids; ///< of the nodes
    std::vector<Light> m_lights;
    Sky m_sky;
    BakeSettings m_settings;
    RelightSettings m_relight;
};

} // namespace

HostileScene hostileScene(std::uint64_t seed) {
    return HostileMaker(seed).make();
}

} // namespace limn
