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

/// A material's textures may read this many sets of texture coordinates, TEXCOORD_0 and so on.
inline constexpr std::uint32_t kMaxUvSets = 16;

/// A texture as used by a material. uv' = offset + R(rotation) * (scale * uv), as in
/// KHR_texture_transform.
struct TextureRef {
    std::int32_t image = -1;    ///< index into Assets::images; -1: none
    std::uint32_t texCoord = 0; ///< set of coordinates, Mesh::uv()
    glm::vec2 offset{0}, scale{1};
    float rotation = 0; ///< [rad], counter-clockwise
    Wrap wrapU = Wrap::Repeat, wrapV = Wrap::Repeat;
    bool nearest = false;

    bool operator==(const TextureRef&) const = default;
};

/// An animated texture in one image: frames of equal size, row after row from the upper left, shown
/// in turn in an endless loop.
struct Flipbook {
    std::uint32_t columns = 1, rows = 1; ///< [1, 256]
    float framesPerSecond = 0;           ///< [0, 1000]; 0: shows the first frame only

    bool operator==(const Flipbook&) const = default;
};

/// Index of the frame shown `seconds` after the start; negative times run backwards.
std::uint32_t frameAt(const Flipbook& flipbook, double seconds);

/// glTF metallic-roughness. Factors multiply textures. Transport treats it as Lambertian with
/// albedo = min(baseColor * (1 - metallic) * (1 - transmission), 0.99).
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
    float transmission = 0; ///< share of the dielectric part that passes light on [0, 1]
    float ior = 1.5f;       ///< index of refraction of the dielectric, >= 1
    /// As in KHR_materials_volume, in units of the mesh. 0: a thin sheet, which does not bend
    /// light. Above 0, the mesh bounds a body, and rays find their own way through it: only
    /// programs that trace no rays read the number itself.
    float thickness = 0;
    TextureRef baseColorTexture;         ///< sRGB
    TextureRef metallicRoughnessTexture; ///< linear: roughness in G, metallic in B
    TextureRef normalTexture;            ///< linear, tangent space
    TextureRef emissiveTexture;          ///< sRGB
    /// Frames of the emissive texture. The texture's transform is then applied within a frame: it
    /// must not rotate unless columns == rows, because a TextureRef cannot express that.
    Flipbook emissiveFlipbook;

    bool operator==(const Material&) const = default;
};

/// The emissive texture with the frame shown `seconds` after the start.
TextureRef emissiveTextureAt(const Material& material, double seconds);

/// Whether emissiveTextureAt() changes with time.
bool isAnimated(const Material& material);

/// Whether light leaves both sides of a surface of this material.
bool isTwoSided(const Material& material);

} // namespace limn
