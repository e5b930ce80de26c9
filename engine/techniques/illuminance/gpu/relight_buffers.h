// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gpu/buffer.h"
#include "engine/render/gpu_field.h"
#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/relight/caches/light_links.h"
#include "shaders/shared/gpu_relight.h"

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

namespace limn {

/// Everything relighting reads and writes, on the GPU. What each holds:
/// shaders/shared/gpu_relight.h.
struct RelightBuffers {
    gpu::Buffer surfels, innerNodes, levels, caches, links, fills, fillSources; ///< of the bake
    gpu::Buffer direct, albedo, emitted;                                        ///< what comes in
    gpu::Buffer indirect, radiosity, sh; ///< what is worked out; 0 at first
    gpu::Buffer change;                  ///< mapped
    gpu::Buffer order; ///< the grid's caches, then room for kCacheLists lists of the lightmap's
    std::shared_ptr<const gpu::Buffer> gridDepth; ///< of the field
    std::shared_ptr<GpuField> field;              ///< what comes out; of makeRelitField()

    std::vector<std::uint32_t> levelBegin;          ///< as TreeLevels::begin
    std::uint32_t fillCount = 0, lightmapFills = 0; ///< invalid caches; those of the lightmap first

    static constexpr std::size_t kCacheLists = 3;

    /// In the order of their bindings. The lightmap's comes last and is not among them.
    std::vector<const gpu::Buffer*> inBindingOrder() const;
};

/// RelightBuffers::caches, of which links before `ends` are read.
std::vector<shared::GpuCache> packCaches(const Caches& caches, LinkEnds ends);

/// Uploads a bake, without a field; `lanes` is the size of a group of surfels. Fails when a buffer
/// would be larger than what the device can bind, naming both sizes.
Result<RelightBuffers> createRelightBuffers(gpu::Device& device, const Bake& bake,
                                            std::uint32_t lanes);

/// Fills buffers with 0. What was submitted before must not use them any more.
void clearBuffers(gpu::Device& device, std::initializer_list<VkBuffer> buffers);

/// A black field of so many bands, no more than the bake's, `chroma` of them in colour, and black
/// harmonics.
void makeRelitField(gpu::Device& device, const Bake& bake, std::uint32_t bands,
                    std::uint32_t chroma, RelightBuffers& buffers);

} // namespace limn
