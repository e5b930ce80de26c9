// SPDX-License-Identifier: MIT
#include "engine/scene/camera.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace limn {

glm::mat4 viewMatrix(const Camera& camera) {
    glm::vec3 forward = camera.target - camera.eye;
    if (!(glm::dot(forward, forward) > 0))
        forward = {0, 0, -1};
    forward = glm::normalize(forward);
    glm::vec3 up = camera.up;
    if (std::abs(glm::dot(forward, up)) > 0.9999f)
        up = std::abs(forward.y) > 0.9f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
    // Far from the origin, floats cannot distinguish the eye from a point one metre ahead.
    return glm::translate(glm::lookAtRH(glm::vec3(0), forward, up), -camera.eye);
}

glm::mat4 projectionMatrix(const Camera& camera, float aspect, float zNear, float zFar) {
    return glm::perspectiveRH_ZO(camera.fovY, aspect, zNear, zFar);
}

glm::vec3 rayDirection(const Camera& camera, float aspect, float ndcX, float ndcY) {
    const glm::mat3 toWorld = glm::transpose(glm::mat3(viewMatrix(camera)));
    const float h = std::tan(camera.fovY / 2);
    return toWorld * glm::vec3(ndcX * h * aspect, ndcY * h, -1.f);
}

} // namespace limn
