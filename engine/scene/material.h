// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

enum class Wrap : std::uint8_t { Repeat, Clamp, Mirror };
enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

/// A texture as a material uses it. uv' = offset + R(rotation) * (scale * uv), as
/// KHR_texture_transform.
struct TextureRef {
    std::int32_t image = -1;    ///< index into Assets::images; -1: none
    std::uint32_t texCoord = 0; ///< 0 or 1
    glm::vec2 offset{0}, scale{1};
    float rotation = 0; ///< [rad], counter-clockwise
    Wrap wrapU = Wrap::Repeat, wrapV = Wrap::Repeat;
    bool nearest = false;

    bool operator==(const TextureRef&) const = default;
};

/// glTF metallic-roughness. Factors multiply textures. Transport treats it as Lambertian with
/// albedo = min(baseColor * (1 - metallic), 0.99).
struct Material {
    std::string name;
    glm::vec4 baseColor{1}; ///< linear, alpha in w; each in [0, 1]
    float metallic = 0;     ///< [0, 1]
    float roughness = 1;    ///< [0, 1]
    glm::vec3 emission{0};  ///< radiance [nits], emissiveFactor * emissive_strength; >= 0
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    float normalScale = 1;
    TextureRef baseColorTexture;         ///< sRGB
    TextureRef metallicRoughnessTexture; ///< linear: roughness in G, metallic in B
    TextureRef normalTexture;            ///< linear, tangent space
    TextureRef emissiveTexture;          ///< sRGB

    bool operator==(const Material&) const = default;
};

} // namespace limn
