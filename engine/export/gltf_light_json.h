// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/camera.h"
#include "engine/scene/light/light.h"

#include <nlohmann/json.hpp>

namespace limn {

/// A light of KHR_lights_punctual, without its place. Precondition: not a Rectangle, which the
/// extension does not know.
nlohmann::ordered_json lightJson(const Light& light);

/// The node that carries light number `index` of the extension.
nlohmann::ordered_json lightNode(const Light& light, std::size_t index);

/// A node that only marks a rectangle light and describes it in extras.limn, because glTF has no
/// such light: size [m], radiance [nits]. Its -Z axis points the way that light travels.
nlohmann::ordered_json rectangleNode(const Light& light);

/// A perspective camera that sees from `zNear` [m] on, and the node that carries it as camera
/// number `index`.
nlohmann::ordered_json cameraJson(const Camera& camera, float zNear);
nlohmann::ordered_json cameraNode(const Camera& camera, std::size_t index);

/// The 16 numbers of a glTF matrix, column by column.
nlohmann::ordered_json matrixJson(const glm::mat4& m);

} // namespace limn
