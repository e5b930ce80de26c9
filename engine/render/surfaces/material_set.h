// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/image.h"
#include "engine/gpu/uploader.h"
#include "engine/scene/scene.h"
#include "shaders/shared/gpu_material.h"

#include <array>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

namespace limn::render {

constexpr std::uint32_t kFrameSlots = 2; ///< frames that may be in flight

/// Textures and factors of all materials: descriptor set 1 of the geometry passes.
/// Textures are bound per material, because not every device can index descriptors.
class MaterialSet {
public:
    explicit MaterialSet(gpu::Device& device);

    /// Updates textures: uploads new images and drops those no longer used. Returns true if an
    /// alpha mask changed.
    bool update(const Scene& scene);

    /// Writes the factors for the frame that uses `slot`.
    void writeFactors(std::uint32_t slot);

    VkDescriptorSetLayout layout() const { return m_layout.handle; }
    void bind(VkCommandBuffer cmd, VkPipelineLayout pipelineLayout, std::uint32_t material,
              std::uint32_t slot) const;

    std::uint64_t version = 0; ///< increases when any material changed

    /// FEATURE_* of each material.
    std::vector<std::uint32_t> features;
    std::vector<bool> doubleSided;
    std::vector<bool> isGlassSheet;  ///< per material: casts no shadow
    std::vector<bool> transmits;     ///< per material: something is seen through it
    std::vector<std::uint8_t> bands; ///< bands of indirect light that each material reflects

private:
    using TextureKey = std::pair<std::int32_t, bool>; ///< image, sRGB
    using SamplerKey = std::tuple<Wrap, Wrap, bool>;

    void uploadTextures(const Scene& scene);
    void createSets(std::size_t count);
    void writeSet(std::uint32_t material, const Material& m);
    VkSampler sampler(const TextureRef& ref);

    gpu::Device& m_device;
    gpu::DescriptorSetLayout m_layout;
    gpu::DescriptorPool m_pool;
    std::vector<VkDescriptorSet> m_sets;
    std::shared_ptr<const Assets> m_assets;
    std::map<TextureKey, gpu::Image> m_textures;
    std::map<SamplerKey, gpu::Sampler> m_samplers;
    gpu::Image m_white;
    gpu::Buffer m_factors; ///< kFrameSlots times one stride per material
    std::uint32_t m_stride = 0;
    std::vector<Material> m_materials;
};

} // namespace limn::render
