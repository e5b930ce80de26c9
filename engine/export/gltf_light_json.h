// SPDX-License-Identifier: MIT
#pragma once

#include "engine/json/json.h"
#include "engine/scene/camera.h"
#include "engine/scene/light/light.h"

namespace limn {

/// A light of KHR_lights_punctual, without its place. Precondition: not a Rectangle, which the
/// extension does not know.
Json lightJson(const Light& light);

/// The node that carries light number `index` of the extension.
Json lightNode(const Light& light, std::size_t index);

/// A node that only marks a rectangle light and describes it in extras.limn, because glTF has no
/// such light: size [m], radiance [nits]. Its -Z axis points the way that light travels.
Json rectangleNode(const Light& light);

/// A perspective camera that sees from `zNear` [m] on, and the node that carries it as camera
/// number `index`.
Json cameraJson(const Camera& camera, float zNear);
Json cameraNode(const Camera& camera, std::size_t index);

/// The 16 numbers of a glTF matrix, column by column.
Json matrixJson(const glm::mat4& m);

} // namespace limn
