// SPDX-License-Identifier: MIT
#include "engine/gallery/coloured_street.h"

#include "engine/gallery/mesh_builder.h"
#include "engine/scene/mesh/mesh_repair.h"

#include <array>
#include <memory>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

using glm::dvec3;

constexpr double kLength = 42, kHalfWidth = 5, kDepth = 7; ///< of the street; of the houses [m]

/// Adds meshes to a document, each as a node of its own.
class StreetMaker {
public:
    std::uint32_t addMaterial(const char* name, glm::vec3 color, float roughness = 1) {
        Material m;
        m.name = name;
        m.baseColor = glm::vec4(color, 1);
        m.roughness = roughness;
        addObject(scene.document, m);
        return m_materials++;
    }
    Node& add(const std::string& name, Mesh mesh, std::uint32_t material) {
        removeBadTriangles(mesh);
        mesh.name = name;
        mesh.material = material;
        Node node;
        node.name = name;
        node.meshes = {std::uint32_t(assets->meshes.size())};
        assets->meshes.push_back(std::move(mesh));
        const ObjectId id = addObject(scene.document, std::move(node));
        return std::get<Node>(scene.document.objects.at(id));
    }

    GeneratedScene scene;
    std::shared_ptr<Assets> assets = std::make_shared<Assets>();

private:
    std::uint32_t m_materials = 0;
};

Mesh boxMesh(dvec3 lower, dvec3 upper) {
    Mesh mesh;
    addBox(mesh, lower, upper);
    return mesh;
}

void addHouses(StreetMaker& maker, std::uint32_t plaster, std::uint32_t brick) {
    constexpr std::array kWidths = {9., 7., 11., 6., 9.};
    constexpr std::array kHeights = {8., 6.5, 9., 7., 8.};
    double x = 0;
    for (std::size_t k = 0; k < kWidths.size(); ++k) {
        const std::string number = std::to_string(k + 1);
        maker.add("Shaded house " + number,
                  boxMesh({x, 0, kHalfWidth}, {x + kWidths[k], kHeights[k], kHalfWidth + kDepth}),
                  plaster);
        maker.add("Sunny house " + number,
                  boxMesh({x, 0, -kHalfWidth - kDepth},
                          {x + kWidths[k], kHeights[kWidths.size() - 1 - k], -kHalfWidth}),
                  brick);
        x += kWidths[k];
    }
}

} // namespace

GeneratedScene colouredStreet() {
    StreetMaker maker;
    const std::uint32_t plaster = maker.addMaterial("Plaster", glm::vec3(0.7f)),
                        brick = maker.addMaterial("Brick", {0.3f, 0.25f, 0.2f}),
                        asphalt = maker.addMaterial("Asphalt", glm::vec3(0.2f));
    Mesh ground;
    addQuad(ground, {-4, 0, -kHalfWidth - kDepth}, {-4, 0, kHalfWidth + kDepth},
            {kLength + 4, 0, kHalfWidth + kDepth}, {kLength + 4, 0, -kHalfWidth - kDepth});
    maker.add("Ground", std::move(ground), asphalt);
    addHouses(maker, plaster, brick);
    constexpr std::array<std::pair<const char*, glm::vec3>, 3> kPlanes = {
        {{"Red plane", {0.85f, 0.05f, 0.05f}},
         {"Green plane", {0.05f, 0.7f, 0.1f}},
         {"Blue plane", {0.05f, 0.1f, 0.8f}}}};
    for (std::size_t k = 0; k < kPlanes.size(); ++k) {
        const double x = 10 + 9 * double(k);
        maker.add(kPlanes[k].first, boxMesh({x, 0.1, -4.5}, {x + 6, 5.1, -4.4}),
                  maker.addMaterial(kPlanes[k].first, kPlanes[k].second));
    }
    Mesh car;
    addBox(car, {-2, 0.3, -0.85}, {2, 0.95, 0.85});
    addBox(car, {-1.1, 0.95, -0.7}, {0.9, 1.5, 0.7}, AllFaces & ~unsigned(NegativeY));
    Node& node =
        maker.add("Car", std::move(car), maker.addMaterial("Car", {0.9f, 0.4f, 0.02f}, 0.35f));
    node.dynamic = true;
    node.transform.translation = {17, 0, -3};
    Light sun;
    sun.name = "Sun";
    sun.kind = LightKind::Directional;
    sun.direction = -glm::normalize(glm::vec3(0.3f, 1.2f, 1));
    sun.strength = 15;
    addObject(maker.scene.document, sun);
    Sky dark;
    dark.radiance = glm::vec3(0);
    addObject(maker.scene.document, dark);
    Camera camera;
    camera.eye = {5, 2.2f, -2.5f};
    camera.target = {20, 2.4f, 3};
    addObject(maker.scene.document, camera);
    maker.scene.kind = SceneKind::Street;
    maker.scene.assets = maker.assets;
    maker.scene.description = "a street with coloured planes and a car in the sun";
    return std::move(maker.scene);
}

} // namespace limn
