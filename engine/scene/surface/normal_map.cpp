// SPDX-License-Identifier: MIT
#include "engine/scene/surface/normal_map.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace limn {

/// Squared length below which a vector has no direction.
static constexpr float kMinSquaredLength = 1e-20f;

glm::vec3 mappedNormal(const Scene& scene, const Instance& instance, std::uint32_t triangle,
                       glm::vec2 uv, glm::vec3 front) {
    const Material& material = scene.materialOf(instance);
    const Mesh& mesh = scene.meshOf(instance);
    const TextureRef& texture = material.normalTexture;
    const std::vector<glm::vec2>& uvs = mesh.uv(texture.texCoord);
    if (texture.image < 0 || mesh.tangents.empty() || uvs.empty())
        return front;
    const auto [a, b, c] = mesh.triangle(triangle);
    const auto interpolate = [&](const auto& values) {
        return (1 - uv.x - uv.y) * values[a] + uv.x * values[b] + uv.y * values[c];
    };
    const glm::vec4 tangent = interpolate(mesh.tangents);
    const glm::mat3 toWorld(instance.toWorld);
    glm::vec3 t = toWorld * glm::vec3(tangent);
    t -= front * glm::dot(front, t);
    const float squared = glm::dot(t, t);
    if (!(squared > kMinSquaredLength))
        return front;
    t /= std::sqrt(squared);
    const float mirrored = glm::determinant(toWorld) < 0 ? -1.f : 1.f;
    const glm::vec3 bitangent = glm::cross(front, t) * (mirrored * tangent.w);
    glm::vec3 m =
        glm::vec3(sampleTexture(*scene.assets, texture, interpolate(uvs), false)) * 2.f - 1.f;
    m.x *= material.normalScale;
    m.y *= material.normalScale;
    const glm::vec3 mapped = t * m.x + bitangent * m.y + front * m.z;
    const float length2 = glm::dot(mapped, mapped);
    return length2 > kMinSquaredLength ? mapped / std::sqrt(length2) : front;
}

} // namespace limn
