// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/export/export_format.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include "engine/techniques/illuminance/bake/baker.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <string>

#include <memory>
#include <utility>

namespace limn {

/// A room with a two-sided sheet, two placements of a ball, lights of every kind and a camera.
inline Document roomDocument(Assets& assets) {
    using namespace simple;
    Document d;
    assets.meshes = {box(glm::vec3(0), glm::vec3(4, 3, 5), true, 0), sphere(0.4f, 2, false, 1),
                     quad({2, 0.5f, 1}, {0, 1, 0}, {0.3f, 0, 1}, 2)};
    Material wall = lambert({0.7f, 0.5f, 0.3f}), ball = lambert({0.2f, 0.3f, 0.6f}, {3, 6, 9}),
             sheet = lambert(glm::vec3(0.4f));
    wall.name = "wall";
    ball.roughness = 0.25f;
    ball.metallic = 0.5f;
    sheet.doubleSided = true;
    for (const Material& m : {wall, ball, sheet})
        addObject(d, m);
    for (const auto& [mesh, x] : {std::pair<std::uint32_t, double>(0, 0), {1, 1}, {1, 3}, {2, 0}}) {
        Node node;
        node.name = "node " + std::to_string(x);
        node.meshes = {mesh};
        node.transform.translation = mesh == 1 ? glm::dvec3(x, 0.5, 2) : glm::dvec3(0);
        addObject(d, node);
    }
    Light point{.name = "lamp", .position = {2, 2.5f, 2}, .color = {1, 2, 0.5f}, .strength = 8};
    point.range = 20;
    Light spot{.name = "spot", .kind = LightKind::Spot, .position = {1, 2.9f, 1}, .strength = 30};
    spot.direction = glm::normalize(glm::vec3(0.3f, -1, 0.2f));
    spot.innerAngle = 0.2f;
    spot.outerAngle = 0.7f;
    Light sun{.name = "sun", .kind = LightKind::Directional, .strength = 2};
    sun.direction = glm::normalize(glm::vec3(0.1f, -1, 0.4f));
    Light panel{.name = "panel", .kind = LightKind::Rectangle, .position = {2, 2.8f, 4}};
    panel.strength = 5;
    Light off = point;
    off.enabled = false;
    for (const Light& light : {point, spot, sun, panel, off})
        addObject(d, light);
    addObject(d, Camera{.name = "eye", .eye = {3.5f, 1.5f, 4.5f}, .target = {1, 1, 1}});
    BakeSettings bake;
    bake.surfels = 600;
    bake.lightmapCaches = 1200;
    bake.rays = 64;
    bake.links = 48;
    addObject(d, bake);
    return d;
}

/// A document with its bake, lit until bounces change nothing, to export.
struct ExportedRoom {
    ExportedRoom(Document d, std::shared_ptr<const Assets> a)
        : document(std::move(d)), scene(flatten(document, std::move(a))), trace(scene),
          baked(bakeOf(trace)), relighter(baked) {
        relighter.relight(scene, trace, 64);
    }

    ExportScene view(const ExportFolders& folders = {}) const {
        return {document, scene, trace, baked->lightmap, relighter.field(), &data, folders};
    }

    Document document;
    Scene scene;
    TraceScene trace;
    std::shared_ptr<const Bake> baked;
    BakedIlluminance data{baked};
    Relighter relighter;

private:
    static std::shared_ptr<const Bake> bakeOf(const TraceScene& trace) {
        Result<Bake> made = bake(trace);
        EXPECT_TRUE(made) << made.error().message;
        return std::make_shared<const Bake>(std::move(*made));
    }
};

} // namespace limn
