// SPDX-License-Identifier: MIT
#include "engine/export/gltf_light_json.h"

#include "engine/export/vector_json.h"
#include "engine/scene/light/photometry.h"
#include "engine/scene/light/rectangle_light.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// A frame at `position` whose -Z axis is `direction` and whose X axis is `across`.
glm::mat4 frame(glm::vec3 position, glm::vec3 direction, glm::vec3 across) {
    const glm::vec3 z = -direction;
    return {glm::vec4(across, 0), glm::vec4(glm::cross(z, across), 0), glm::vec4(z, 0),
            glm::vec4(position, 1)};
}

const char* typeOf(LightKind kind) {
    switch (kind) {
    case LightKind::Directional:
        return "directional";
    case LightKind::Point:
        return "point";
    case LightKind::Spot:
        return "spot";
    case LightKind::Rectangle:
        break;
    }
    return "";
}

/// Colours of glTF end at 1; what is brighter is in the intensity.
struct Intensity {
    Json color;
    float factor = 1;

    explicit Intensity(glm::vec3 c) : factor(std::max({c.x, c.y, c.z, 1.f})) {
        color = {c.x / factor, c.y / factor, c.z / factor};
    }
};

} // namespace

Json matrixJson(const glm::mat4& m) {
    Json json = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            json.push_back(m[column][row]);
    return json;
}

Json lightJson(const Light& whole) {
    const Light light = withoutProfile(whole);
    const Intensity intensity(light.color);
    Json json = {{"name", light.name},
                 {"type", typeOf(light.kind)},
                 {"color", intensity.color},
                 {"intensity", light.strength * intensity.factor}};
    if (light.kind != LightKind::Directional && light.range > 0)
        json["range"] = light.range;
    if (light.kind == LightKind::Spot)
        json["spot"] = {{"innerConeAngle", light.innerAngle}, {"outerConeAngle", light.outerAngle}};
    return json;
}

Json areaLightJson(const Light& light) {
    const Intensity intensity(light.color);
    return {{"name", light.name},       {"type", "rect"},
            {"color", intensity.color}, {"intensity", light.strength * intensity.factor},
            {"size", light.size.y},     {"rect", {{"aspect", light.size.x / light.size.y}}}};
}

Json profileUseJson(const Light& light, std::size_t index) {
    const Intensity intensity(light.color);
    return {{"light", index},
            {"multiplier", light.strength * intensity.factor / light.profile->peak},
            {"color", intensity.color}};
}

Json lightNode(const Light& light) {
    const LightRectangle rectangle = lightRectangle(light);
    return {{"name", light.name},
            {"matrix", matrixJson(frame(light.position, rectangle.normal,
                                        glm::normalize(rectangle.halfWidth)))}};
}

Json cameraJson(const Camera& camera, float zNear) {
    return {{"name", camera.name},
            {"type", "perspective"},
            {"perspective", {{"yfov", camera.fovY}, {"znear", zNear}}}};
}

Json cameraNode(const Camera& camera, std::size_t index) {
    return {{"name", camera.name},
            {"camera", index},
            {"matrix", matrixJson(glm::inverse(viewMatrix(camera)))}};
}

} // namespace limn
