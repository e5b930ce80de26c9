// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/image.h"
#include "engine/scene/scene.h"
#include "shaders/shared/grid_lookup.h"

#include <memory>

namespace limn {

/// An IndirectField on the GPU for shaders to sample, packed as field_packing.h says.
struct GpuField {
    /// RGBA16F, fieldLayers() of them, in SHADER_READ_ONLY_OPTIMAL; 1x1 black without a lightmap.
    gpu::Image lightmap;
    gpu::Buffer grid; ///< storage buffer, packed likewise; one element if there is no grid
    float scale = 1;  ///< stored values are multiplied by this; > 0
    /// Same contents as IndirectField::gridDepth or gridMoments; null if the cells see everything.
    std::shared_ptr<const gpu::Buffer> gridDepth;
    std::uint32_t gridWeights = GRID_DEPTHS; ///< what gridDepth holds, of grid_lookup.h

    std::uint32_t bands = 3, chroma = 3;
    glm::uvec3 gridSize{0}; ///< cells; 0: no grid
    Bounds gridBounds;

    bool continues = false; ///< as IndirectField::continues

    bool hasGrid() const { return gridSize.x > 0; }
};

/// Creates an image for GpuField::lightmap with undefined contents. Shaders may sample it;
/// `written` is added to its usage.
gpu::Image createFieldLightmap(gpu::Device& device, std::uint32_t width, std::uint32_t height,
                               std::uint32_t layers, VkImageUsageFlags written);

/// What a field that shaders write is made for.
struct WrittenFieldDesc {
    std::uint32_t lightmapWidth = 0, lightmapHeight = 0; ///< texels; 0: no lightmap
    std::uint32_t bands = 3, chroma = 3;
    glm::uvec3 gridSize{0}; ///< cells; 0: no grid
    Bounds gridBounds;
    std::shared_ptr<const gpu::Buffer> gridDepth; ///< as GpuField::gridDepth
    bool continues = false;                       ///< as IndirectField::continues
};

/// Creates a black field whose lightmap is a storage image and whose grid is a storage buffer.
/// Throws VulkanError when out of memory.
std::shared_ptr<GpuField> createWrittenField(gpu::Device& device, const WrittenFieldDesc& desc);

/// Records what must surround compute shaders that write into a field: frames that were submitted
/// before have read the old values, and later ones see the new. In between, the lightmap is in
/// GENERAL.
void beginFieldWrite(VkCommandBuffer cmd, const GpuField& field);
void endFieldWrite(VkCommandBuffer cmd, const GpuField& field);

/// Copies a field of createWrittenField() to the CPU, without its depths. Waits for the GPU.
IndirectField readField(gpu::Device& device, const GpuField& field);

} // namespace limn
