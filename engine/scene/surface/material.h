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

/// A film in one image: frames of equal size, row after row from the upper left, shown in turn for
/// ever.
struct Flipbook {
    std::uint32_t columns = 1, rows = 1; ///< [1, 256]
    float framesPerSecond = 0;           ///< [0, 1000]; 0: the first stands still

    bool operator==(const Flipbook&) const = default;
};

/// Which frame is shown `seconds` after the start; before it, the film runs backwards.
std::uint32_t frameAt(const Flipbook& film, double seconds);

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
    /// Of the emissive texture, whose transform then leads into a frame: it must not turn frames
    /// unless columns == rows, as no TextureRef says that.
    Flipbook emissiveFilm;

    bool operator==(const Material&) const = default;
};

/// The emissive texture as it is `seconds` after the start.
TextureRef emissiveTextureAt(const Material& material, double seconds);

/// Whether emissiveTextureAt() changes with time.
bool isAnimated(const Material& material);

/// Light leaves both sides of such a surface.
bool isTwoSided(const Material& material);

} // namespace limn
