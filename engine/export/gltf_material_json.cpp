// SPDX-License-Identifier: MIT
#include "engine/export/gltf_material_json.h"

#include <algorithm>

namespace limn {

namespace {

// Numbers of the glTF 2.0 specification.
constexpr int kNearest = 9728, kLinear = 9729, kLinearMips = 9987;
constexpr int kRepeat = 10497, kClamp = 33071, kMirror = 33648;

int wrapMode(Wrap wrap) {
    switch (wrap) {
    case Wrap::Repeat:
        return kRepeat;
    case Wrap::Clamp:
        return kClamp;
    case Wrap::Mirror:
        return kMirror;
    }
    return kRepeat;
}

/// Index of `value` in the array, to which it is added if it is not there.
std::size_t indexIn(Json& array, const Json& value) {
    const auto found = std::find(array.begin(), array.end(), value);
    if (found != array.end())
        return std::size_t(found - array.begin());
    array.push_back(value);
    return array.size() - 1;
}

} // namespace

Json GltfMaterials::texture(const TextureRef& ref) {
    const auto image = std::find(images.begin(), images.end(), ref.image);
    const auto number = std::size_t(image - images.begin());
    if (image == images.end())
        images.push_back(ref.image);
    const std::size_t sampler =
        indexIn(samplers, {{"magFilter", ref.nearest ? kNearest : kLinear},
                           {"minFilter", ref.nearest ? kNearest : kLinearMips},
                           {"wrapS", wrapMode(ref.wrapU)},
                           {"wrapT", wrapMode(ref.wrapV)}});
    Json info = {{"index", indexIn(textures, {{"sampler", sampler}, {"source", number}})}};
    if (ref.texCoord != 0)
        info["texCoord"] = exportedTexCoord(ref.texCoord);
    if (ref.offset == glm::vec2(0) && ref.scale == glm::vec2(1) && ref.rotation == 0)
        return info;
    extensions.insert("KHR_texture_transform");
    info["extensions"]["KHR_texture_transform"] = {{"offset", {ref.offset.x, ref.offset.y}},
                                                   {"rotation", ref.rotation},
                                                   {"scale", {ref.scale.x, ref.scale.y}}};
    return info;
}

void GltfMaterials::putTransmission(const Material& source, Json& json) {
    const auto put = [&](const char* name, const char* field, float value) {
        extensions.insert(name);
        json["extensions"][name][field] = value;
    };
    if (source.transmission > 0)
        put("KHR_materials_transmission", "transmissionFactor", source.transmission);
    if (source.ior != Material{}.ior)
        put("KHR_materials_ior", "ior", source.ior);
    if (source.thickness > 0)
        put("KHR_materials_volume", "thicknessFactor", source.thickness);
}

std::size_t GltfMaterials::index(const Material& source, std::uint32_t number, bool oneSided,
                                 std::uint32_t page) {
    const auto [known, isNew] = m_known.try_emplace({number, oneSided, page}, materials.size());
    if (!isNew)
        return known->second;
    Json json;
    if (!source.name.empty())
        json["name"] = source.name;
    const glm::vec4 c = source.baseColor;
    Json& pbr = json["pbrMetallicRoughness"];
    pbr = {{"baseColorFactor", {c.x, c.y, c.z, c.w}},
           {"metallicFactor", source.metallic},
           {"roughnessFactor", source.roughness}};
    if (source.baseColorTexture.image >= 0)
        pbr["baseColorTexture"] = texture(source.baseColorTexture);
    if (source.metallicRoughnessTexture.image >= 0)
        pbr["metallicRoughnessTexture"] = texture(source.metallicRoughnessTexture);
    if (source.normalTexture.image >= 0) {
        json["normalTexture"] = texture(source.normalTexture);
        json["normalTexture"]["scale"] = source.normalScale;
    }
    if (const TextureRef emissive = emissiveTextureAt(source, 0); emissive.image >= 0)
        json["emissiveTexture"] = texture(emissive);
    // Factors end at 1; what is brighter is in the strength.
    const glm::vec3 e = source.emission;
    const float strength = std::max({e.x, e.y, e.z, 1.f});
    json["emissiveFactor"] = {e.x / strength, e.y / strength, e.z / strength};
    if (strength > 1) {
        extensions.insert("KHR_materials_emissive_strength");
        json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    }
    putTransmission(source, json);
    if (source.alphaMode == AlphaMode::Mask) {
        json["alphaMode"] = "MASK";
        json["alphaCutoff"] = source.alphaCutoff;
    } else if (source.alphaMode == AlphaMode::Blend) {
        json["alphaMode"] = "BLEND";
    }
    json["doubleSided"] = source.doubleSided && !oneSided;
    json["extras"]["limn"]["material"] = number;
    if (page > 0)
        json["extras"]["limn"]["lightmapPage"] = page;
    materials.push_back(std::move(json));
    return known->second;
}

} // namespace limn
