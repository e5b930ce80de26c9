// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gpu/buffer.h"
#include "engine/render/gpu_field.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/caches/light_links.h"
#include "shaders/shared/gpu_relight.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace limn {

/// All GPU buffers that relighting reads and writes. shaders/shared/gpu_relight.h describes their
/// contents.
struct RelightBuffers {
    gpu::Buffer surfels, innerNodes, levels, caches, links, fills, fillSources; ///< of the bake
    gpu::Buffer lightPoints; ///< for each of Surfels::litAt() its position and packOctWord() of its
                             ///< normal
    gpu::Buffer direct, albedo, emitted; ///< inputs
    gpu::Buffer indirect, radiosity, sh; ///< results of the steps; 0 at first
    gpu::Buffer change;                  ///< of kBounces bounces; mapped
    gpu::Buffer order; ///< the grid's caches, then room for kCacheLists lists of the lightmap's
    std::shared_ptr<const gpu::Buffer> gridDepth; ///< depth maps of the field's grid
    std::shared_ptr<GpuField> field;              ///< output, from makeRelitField()

    std::vector<std::uint32_t> levelBegin; ///< as TreeLevels::begin
    std::uint32_t fillCount = 0,
                  lightmapFills = 0; ///< number of invalid caches; those of the lightmap come first

    static constexpr std::size_t kCacheLists = 3;
    static constexpr std::uint32_t kBounces = 4; ///< of one submission

    /// Buffers in the order of their bindings, without the lightmap's, which comes last.
    std::vector<const gpu::Buffer*> inBindingOrder() const;
};

/// Packs caches for RelightBuffers::caches; only their links before `ends` are read.
std::vector<shared::GpuCache> packCaches(const Caches& caches, LinkEnds ends);

/// Uploads a bake without creating a field; `lanes` is the size of a group of surfels. Fails when a
/// buffer would be larger than the device can bind, naming both sizes.
Result<RelightBuffers> createRelightBuffers(gpu::Device& device, const Bake& bake,
                                            std::uint32_t lanes);

/// Creates a black field of `bands` bands, at most the bake's, of which `chroma` are in colour, and
/// black harmonics.
void makeRelitField(gpu::Device& device, const Bake& bake, std::uint32_t bands,
                    std::uint32_t chroma, RelightBuffers& buffers);

} // namespace limn
