// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_material.h"

#include "engine/gltf/gltf_value.h"
#include "engine/scene/light/light.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/scene/surface/material_textures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace limn {

static const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions,
                                        const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

static glm::vec2 pair(const tinygltf::Value* value, glm::vec2 missing) {
    if (!value || !value->IsArray() || value->ArrayLen() != 2)
        return missing;
    return {number(&value->Get(0), missing.x), number(&value->Get(1), missing.y)};
}

static Wrap wrapOf(int mode) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::Clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::Mirror;
    default:
        return Wrap::Repeat;
    }
}

static void applyTransform(TextureRef& texture, const tinygltf::Value& transform,
                           GltfRepairs& repairs) {
    const glm::vec2 offset = pair(member(transform, "offset"), {0, 0});
    const glm::vec2 scale = pair(member(transform, "scale"), {1, 1});
    const float rotation = number(member(transform, "rotation"), 0);
    if (!std::isfinite(offset.x + offset.y + scale.x + scale.y + rotation)) {
        repairs.add("texture transforms not finite left out");
        return;
    }
    texture.offset = offset;
    texture.scale = scale;
    texture.rotation = rotation;
    const float set = number(member(transform, "texCoord"), float(texture.texCoord));
    texture.texCoord = set >= 0 && set < float(kMaxUvSets) ? std::uint32_t(set) : kMaxUvSets;
}

/// Index of a texture's image, which EXT_texture_webp may name; the other one is for programs that
/// cannot read it. That of KHR_texture_basisu, most kinds of which are not read, is the last
/// choice. -1: it has none.
static std::int32_t imageOf(const tinygltf::Texture& source) {
    const auto named = [&](const char* name) {
        const tinygltf::Value* value = extension(source.extensions, name);
        const std::optional<std::size_t> image =
            value ? wholeNumber(member(*value, "source")) : std::nullopt;
        return image ? std::int32_t(*image) : -1;
    };
    const std::int32_t webp = named("EXT_texture_webp");
    if (webp >= 0)
        return webp;
    return source.source >= 0 ? source.source : named("KHR_texture_basisu");
}

template <class Info>
static TextureRef readTexture(const tinygltf::Model& model, const Info& info,
                              GltfRepairs& repairs) {
    TextureRef texture;
    if (info.index < 0 || std::size_t(info.index) >= model.textures.size())
        return texture;
    const tinygltf::Texture& source = model.textures[std::size_t(info.index)];
    texture.image = imageOf(source);
    if (texture.image < 0 || std::size_t(texture.image) >= model.images.size()) {
        repairs.add("textures without a readable image left out");
        return {};
    }
    texture.texCoord = info.texCoord < 0 ? 0 : std::uint32_t(info.texCoord);
    if (source.sampler >= 0 && std::size_t(source.sampler) < model.samplers.size()) {
        const tinygltf::Sampler& sampler = model.samplers[std::size_t(source.sampler)];
        texture.wrapU = wrapOf(sampler.wrapS);
        texture.wrapV = wrapOf(sampler.wrapT);
        texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    if (const tinygltf::Value* transform = extension(info.extensions, "KHR_texture_transform"))
        applyTransform(texture, *transform, repairs);
    if (texture.texCoord >= kMaxUvSets) {
        repairs.add(fmt::format("textures on TEXCOORD_{} or higher left out", kMaxUvSets));
        return {};
    }
    return texture;
}

/// Clamps `value` to [lower, upper] and reports a repair if it was outside.
static float ranged(double value, float lower, float upper, GltfRepairs& repairs) {
    const float inside = std::clamp(float(value), lower, upper);
    const double change = std::abs(double(inside) - value);
    if (!std::isfinite(value) || change > 1e-6 * std::abs(value))
        repairs.add("material numbers out of range brought into it");
    return inside;
}

static glm::vec3 readEmission(const tinygltf::Material& source, GltfRepairs& repairs) {
    glm::vec3 emission(0);
    if (source.emissiveFactor.size() == 3)
        for (int c = 0; c < 3; ++c)
            emission[c] = ranged(source.emissiveFactor[std::size_t(c)], 0, kMaxLight, repairs);
    if (const auto* e = extension(source.extensions, "KHR_materials_emissive_strength"))
        emission *= ranged(double(number(member(*e, "emissiveStrength"), 1)), 0, 1e7f, repairs);
    for (int c = 0; c < 3; ++c)
        emission[c] = ranged(double(emission[c]), 0, kMaxLight, repairs);
    return emission;
}

/// Sets how light passes through: KHR_materials_transmission, _ior and _volume, of which textures
/// and absorption are left out.
static void readTransmission(const tinygltf::Material& source, Material& m, GltfRepairs& repairs) {
    if (const auto* e = extension(source.extensions, "KHR_materials_transmission")) {
        m.transmission = ranged(double(number(member(*e, "transmissionFactor"), 0)), 0, 1, repairs);
        repairs.add("transmission textures left out", member(*e, "transmissionTexture") ? 1 : 0);
    }
    if (const auto* e = extension(source.extensions, "KHR_materials_ior")) {
        const float ior = number(member(*e, "ior"), m.ior);
        if (ior == 0) // the extension's sign for a surface that reflects everything
            repairs.add("indices of refraction of 0 taken as 1.5");
        else
            m.ior = ranged(double(ior), 1, std::numeric_limits<float>::max(), repairs);
    }
    if (const auto* e = extension(source.extensions, "KHR_materials_volume")) {
        m.thickness = ranged(double(number(member(*e, "thicknessFactor"), 0)), 0,
                             std::numeric_limits<float>::max(), repairs);
        const bool absorbs = member(*e, "attenuationDistance") || member(*e, "attenuationColor");
        repairs.add("absorption within bodies left out", absorbs ? 1 : 0);
        repairs.add("thickness textures left out", member(*e, "thicknessTexture") ? 1 : 0);
    }
}

/// A texture that an extension names.
static TextureRef readExtensionTexture(const tinygltf::Model& model, const tinygltf::Value* value,
                                       GltfRepairs& repairs) {
    tinygltf::TextureInfo info;
    if (!value)
        return {};
    info.index = int(number(member(*value, "index"), -1));
    info.texCoord = int(number(member(*value, "texCoord"), 0));
    if (const tinygltf::Value* extensions = member(*value, "extensions"))
        for (const std::string& name : extensions->Keys())
            info.extensions[name] = extensions->Get(name);
    return readTexture(model, info, repairs);
}

/// Up to four numbers in [0, 1]; missing ones are `missing`.
static glm::vec4 readColor(const tinygltf::Value* value, float missing, GltfRepairs& repairs) {
    glm::vec4 color(missing);
    for (std::size_t c = 0;
         value && value->IsArray() && c < std::min<std::size_t>(value->ArrayLen(), 4); ++c)
        color[int(c)] = ranged(double(number(&value->Get(int(c)), missing)), 0, 1, repairs);
    return color;
}

/// Applies the strength of KHR_materials_specular to what is no metal, by the index of refraction
/// whose reflectance is as large. Of its colour the mean is taken; what light passes through keeps
/// its index.
static void readSpecular(const tinygltf::Material& source, Material& m, GltfRepairs& repairs) {
    const auto* e = extension(source.extensions, "KHR_materials_specular");
    if (!e)
        return;
    float strength = ranged(double(number(member(*e, "specularFactor"), 1)), 0, 1, repairs);
    const tinygltf::Value* color = member(*e, "specularColorFactor");
    if (color && color->IsArray() && color->ArrayLen() == 3) {
        float mean = 0;
        for (int c = 0; c < 3; ++c)
            mean += ranged(double(number(&color->Get(c), 1)), 0, 1e6f, repairs) / 3;
        strength *= mean;
    }
    repairs.add("textures of the strength and colour of reflections left out",
                member(*e, "specularTexture") || member(*e, "specularColorTexture") ? 1 : 0);
    if (m.transmission == 0)
        m.ior = iorOfF0(dielectricF0(m.ior) * strength);
}

/// KHR_materials_unlit: the surface sends its colour, taken as nits, whatever light it is in, and
/// reflects none.
static void makeUnlit(Material& m) {
    m.emission = glm::vec3(m.baseColor);
    m.emissiveTexture = m.baseColorTexture;
    m.baseColor = glm::vec4(glm::vec3(0), m.baseColor.w);
    m.metallic = 0;
    m.roughness = 1;
    m.ior = 1;
    m.normalTexture = m.metallicRoughnessTexture = {};
}

/// Converts KHR_materials_pbrSpecularGlossiness. A surface whose diffuse colour is black and whose
/// reflection is stronger than that of a dielectric is a metal. Any other one is a dielectric, of
/// which the colour of its reflection is left out.
static void readSpecularGlossiness(const tinygltf::Model& model, const tinygltf::Value& e,
                                   Material& m, GltfRepairs& repairs) {
    constexpr float kDielectric = 0.04f; // reflectance of an index of refraction of 1.5
    const glm::vec4 diffuse = readColor(member(e, "diffuseFactor"), 1, repairs);
    const glm::vec4 specular = readColor(member(e, "specularFactor"), 1, repairs);
    const bool isMetal = std::max({diffuse.x, diffuse.y, diffuse.z}) == 0 &&
                         std::max({specular.x, specular.y, specular.z}) > kDielectric;
    m.baseColor = glm::vec4(glm::vec3(isMetal ? specular : diffuse), diffuse.w);
    m.metallic = isMetal ? 1.f : 0.f;
    m.roughness = 1 - ranged(double(number(member(e, "glossinessFactor"), 1)), 0, 1, repairs);
    m.baseColorTexture = readExtensionTexture(
        model, member(e, isMetal ? "specularGlossinessTexture" : "diffuseTexture"), repairs);
    m.metallicRoughnessTexture = {};
    if (!isMetal && !member(e, "specularGlossinessTexture")) // by which the factor is multiplied
        m.ior = iorOfF0((specular.x + specular.y + specular.z) / 3);
    repairs.add("materials of specular reflection and glossiness converted to metal and roughness");
    repairs.add("glossiness textures left out", member(e, "specularGlossinessTexture") ? 1 : 0);
}

Material readMaterial(const tinygltf::Model& model, std::size_t index, GltfRepairs& repairs) {
    const tinygltf::Material& source = model.materials[index];
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material m;
    m.name = source.name.empty() ? fmt::format("Material {}", index) : source.name;
    if (pbr.baseColorFactor.size() == 4)
        for (int c = 0; c < 4; ++c)
            m.baseColor[c] = ranged(pbr.baseColorFactor[std::size_t(c)], 0, 1, repairs);
    m.metallic = ranged(pbr.metallicFactor, 0, 1, repairs);
    m.roughness = ranged(pbr.roughnessFactor, 0, 1, repairs);
    m.emission = readEmission(source, repairs);
    if (source.alphaMode == "MASK")
        m.alphaMode = AlphaMode::Mask;
    else if (source.alphaMode == "BLEND")
        m.alphaMode = AlphaMode::Blend;
    else if (source.alphaMode != "OPAQUE")
        repairs.add("materials of unknown alphaMode taken as OPAQUE");
    m.alphaCutoff = ranged(source.alphaCutoff, 0, 1e30f, repairs);
    m.doubleSided = source.doubleSided;
    m.normalScale = float(source.normalTexture.scale);
    readTransmission(source, m, repairs);
    m.baseColorTexture = readTexture(model, pbr.baseColorTexture, repairs);
    m.metallicRoughnessTexture = readTexture(model, pbr.metallicRoughnessTexture, repairs);
    m.normalTexture = readTexture(model, source.normalTexture, repairs);
    m.emissiveTexture = readTexture(model, source.emissiveTexture, repairs);
    if (const auto* e = extension(source.extensions, "KHR_materials_pbrSpecularGlossiness"))
        readSpecularGlossiness(model, *e, m, repairs);
    else
        readSpecular(source, m, repairs);
    // Without its texture, nobody knows how much of a surface is meant to shine.
    if (source.emissiveTexture.index >= 0 && m.emissiveTexture.image < 0)
        m.emission = glm::vec3(0);
    if (extension(source.extensions, "KHR_materials_unlit"))
        makeUnlit(m);
    repairs.add("materials that read more than two sets of texture coordinates, of which the "
                "viewport shows two",
                uvSetsOf(m).size() > 2 ? 1 : 0);
    return m;
}

} // namespace limn
