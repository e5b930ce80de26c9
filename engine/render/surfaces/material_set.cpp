// SPDX-License-Identifier: MIT
#include "engine/render/surfaces/material_set.h"

#include "engine/math/sh.h"
#include "engine/render/surfaces/uv_slots.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/scene/surface/receiver_bands.h"

#include <cassert>
#include <cmath>
#include <cstring>
#include <set>

namespace limn::render {

using shared::GpuMaterial;

namespace {

constexpr std::array kSetTypes = {
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

struct TextureUse {
    const TextureRef& ref;
    bool srgb;
    std::uint32_t feature;
};

/// Textures of a material in the order of TEXTURE_*.
std::array<TextureUse, TEXTURE_COUNT> texturesOf(const Material& m) {
    return {{{m.baseColorTexture, true, FEATURE_BASE_COLOR_TEXTURE},
             {m.metallicRoughnessTexture, false, FEATURE_METALLIC_ROUGHNESS_TEXTURE},
             {m.normalTexture, false, FEATURE_NORMAL_TEXTURE},
             {m.emissiveTexture, true, FEATURE_EMISSIVE_TEXTURE}}};
}

bool usable(const Assets& assets, const TextureRef& ref) {
    return ref.image >= 0 && std::size_t(ref.image) < assets.images.size() &&
           assets.images[std::size_t(ref.image)].width > 0;
}

VkSamplerAddressMode addressMode(Wrap wrap) {
    switch (wrap) {
    case Wrap::Repeat:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case Wrap::Clamp:
        return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case Wrap::Mirror:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

GpuMaterial factorsOf(const Material& m) {
    GpuMaterial g{};
    g.baseColor = m.baseColor;
    g.emission = m.emission;
    g.metallic = m.metallic;
    g.roughness = m.roughness;
    g.normalScale = m.normalScale;
    g.alphaCutoff = alphaCutoff(m);
    g.transmission = m.transmission;
    g.dielectricF0 = dielectricF0(m.ior);
    const auto textures = texturesOf(m);
    const UvSlots slots = uvSlots(m);
    for (std::size_t k = 0; k < textures.size(); ++k) {
        const TextureRef& t = textures[k].ref;
        // KHR_texture_transform: translation * rotation * scale, with rotation (c, s; -s, c) in its
        // v-down space.
        const float c = std::cos(t.rotation), s = std::sin(t.rotation);
        g.uvRows[2 * k] = {c * t.scale.x, s * t.scale.y, t.offset.x, float(slots.of(t.texCoord))};
        g.uvRows[2 * k + 1] = {-s * t.scale.x, c * t.scale.y, t.offset.y, 0};
    }
    return g;
}

} // namespace

MaterialSet::MaterialSet(gpu::Device& device)
    : m_device(device), m_layout(gpu::createSetLayout(device, kSetTypes)) {
    const auto align = std::uint32_t(device.properties.limits.minUniformBufferOffsetAlignment);
    m_stride = (std::uint32_t(sizeof(GpuMaterial)) + align - 1) / align * align;
    m_white =
        gpu::Image(device, gpu::ImageDesc::texture(1, 1, VK_FORMAT_R8G8B8A8_UNORM, 1, "white"));
    const std::uint32_t texel = ~0u;
    gpu::Uploader(device).image(m_white, std::as_bytes(std::span(&texel, 1)));
}

VkSampler MaterialSet::sampler(const TextureRef& ref) {
    gpu::Sampler& s = m_samplers[{ref.wrapU, ref.wrapV, ref.nearest}];
    if (!s)
        s = gpu::createSampler(m_device,
                               {.filter = ref.nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR,
                                .wrapU = addressMode(ref.wrapU),
                                .wrapV = addressMode(ref.wrapV)});
    return s.handle;
}

void MaterialSet::uploadTextures(const Scene& scene) {
    if (m_assets != scene.assets)
        m_textures.clear();
    m_assets = scene.assets;
    std::set<TextureKey> used;
    for (const Material& m : scene.materials)
        for (const TextureUse& use : texturesOf(m))
            if (m_assets && usable(*m_assets, use.ref))
                used.insert({use.ref.image, use.srgb});
    std::erase_if(m_textures, [&](const auto& entry) { return !used.contains(entry.first); });
    gpu::Uploader uploader(m_device);
    for (const TextureKey& key : used) {
        if (m_textures.contains(key))
            continue;
        const Image& source = m_assets->images[std::size_t(key.first)];
        gpu::ImageDesc desc = gpu::ImageDesc::texture(
            source.width, source.height,
            key.second ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM,
            gpu::mipCount(source.width, source.height), source.name.c_str());
        desc.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        gpu::Image image(m_device, desc);
        uploader.imageMakingMips(image, std::as_bytes(std::span(source.rgba)));
        m_textures.emplace(key, std::move(image));
    }
}

void MaterialSet::createSets(std::size_t count) {
    m_sets.clear();
    m_pool = {};
    m_factors = {};
    if (count == 0)
        return;
    m_pool = gpu::createDescriptorPool(m_device, std::uint32_t(count), kSetTypes);
    m_factors = gpu::Buffer(m_device, {.size = VkDeviceSize(m_stride) * count * kFrameSlots,
                                       .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                       .memory = gpu::MemoryKind::Upload,
                                       .name = "material factors"});
    for (std::size_t i = 0; i < count; ++i)
        m_sets.push_back(gpu::allocateSet(m_device, m_pool, m_layout));
}

void MaterialSet::writeSet(std::uint32_t material, const Material& m) {
    const VkDescriptorSet set = m_sets[material];
    gpu::writeBuffer(m_device, set, 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, m_factors.handle,
                     0, sizeof(GpuMaterial));
    const auto textures = texturesOf(m);
    for (std::uint32_t k = 0; k < textures.size(); ++k) {
        const TextureUse& use = textures[k];
        const auto found = m_textures.find({use.ref.image, use.srgb});
        const bool has = found != m_textures.end();
        if (has)
            features[material] |= use.feature;
        gpu::writeTexture(m_device, set, 1 + k, has ? found->second.view : m_white.view,
                          sampler(use.ref));
    }
}

// Whether image and sampler are the same. The texture transform is part of the factors.
static bool sameImage(const TextureRef& a, const TextureRef& b) {
    return a.image == b.image && a.wrapU == b.wrapU && a.wrapV == b.wrapV && a.nearest == b.nearest;
}

// Whether descriptor sets, features and masks stay valid, because only factors differ.
static bool sameTextures(const Material& a, const Material& b) {
    return sameImage(a.baseColorTexture, b.baseColorTexture) &&
           sameImage(a.normalTexture, b.normalTexture) &&
           sameImage(a.metallicRoughnessTexture, b.metallicRoughnessTexture) &&
           sameImage(a.emissiveTexture, b.emissiveTexture) && a.alphaMode == b.alphaMode &&
           a.doubleSided == b.doubleSided;
}

static bool sameMask(const Material& a, const Material& b) {
    return limn::isGlassSheet(a) == limn::isGlassSheet(b) && isCutout(a) == isCutout(b) &&
           (!isCutout(a) || (a.baseColorTexture == b.baseColorTexture &&
                             alphaCutoff(a) == alphaCutoff(b) && a.baseColor.a == b.baseColor.a));
}

bool MaterialSet::update(const Scene& scene) {
    bool newSets = m_assets != scene.assets || m_materials.size() != scene.materials.size();
    bool newMasks = newSets;
    for (std::size_t i = 0; i < scene.materials.size() && !newMasks; ++i) {
        newSets |= !sameTextures(m_materials[i], scene.materials[i]);
        newMasks |= !sameMask(m_materials[i], scene.materials[i]);
    }
    if (newSets || m_materials != scene.materials) {
        ++version;
        bands.clear();
        transmits.clear();
        for (const Material& m : scene.materials) {
            transmits.push_back(m.transmission > 0);
            bands.push_back(std::uint8_t(receiverBands(*scene.assets, m, kMaxBands)));
        }
    }
    m_materials = scene.materials;
    if (!newSets && !newMasks)
        return false;
    uploadTextures(scene);
    createSets(m_materials.size());
    features.assign(m_materials.size(), 0);
    doubleSided.assign(m_materials.size(), false);
    isGlassSheet.assign(m_materials.size(), false);
    for (std::uint32_t i = 0; i < m_materials.size(); ++i) {
        writeSet(i, m_materials[i]);
        if (isCutout(m_materials[i]))
            features[i] |= FEATURE_ALPHA_MASK;
        doubleSided[i] = m_materials[i].doubleSided;
        isGlassSheet[i] = limn::isGlassSheet(m_materials[i]);
    }
    return newMasks;
}

void MaterialSet::writeFactors(std::uint32_t slot) {
    char* out = static_cast<char*>(m_factors.mapped) + slot * m_materials.size() * m_stride;
    for (const Material& m : m_materials) {
        const GpuMaterial g = factorsOf(m);
        std::memcpy(out, &g, sizeof g);
        out += m_stride;
    }
}

void MaterialSet::bind(VkCommandBuffer cmd, VkPipelineLayout pipelineLayout, std::uint32_t material,
                       std::uint32_t slot) const {
    assert(material < m_sets.size());
    const std::uint32_t offset = (slot * std::uint32_t(m_sets.size()) + material) * m_stride;
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelineLayout, 1, 1,
                            &m_sets[material], 1, &offset);
}

} // namespace limn::render
