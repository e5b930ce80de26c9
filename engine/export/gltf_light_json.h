// SPDX-License-Identifier: MIT
#pragma once

#include "engine/json/json.h"
#include "engine/scene/camera.h"
#include "engine/scene/light/light.h"

namespace limn {

/// A light of KHR_lights_punctual, without its place; that of a profile is spread evenly over its
/// cone. Precondition: not a Rectangle, which the extension does not know.
Json lightJson(const Light& light);

/// A light of EXT_lights_area, without its place. Precondition: a Rectangle.
Json areaLightJson(const Light& light);

/// What a node says of its light by EXT_lights_ies, where `index` is that of its profile.
/// Precondition: the light has one.
Json profileUseJson(const Light& light, std::size_t index);

/// The node of a light of any kind, without extensions. Its -Z axis points the way that light
/// travels, and X along the width of lightRectangle().
Json lightNode(const Light& light);

/// A perspective camera that sees from `zNear` [m] on, and the node that carries it as camera
/// number `index`.
Json cameraJson(const Camera& camera, float zNear);
Json cameraNode(const Camera& camera, std::size_t index);

/// The 16 numbers of a glTF matrix, column by column.
Json matrixJson(const glm::mat4& m);

} // namespace limn
