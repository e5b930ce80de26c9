// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/image.h"
#include "engine/relight/indirect_field.h"
#include "shaders/shared/gpu_frame.h"

namespace limn::render {

/// The indirect field on the GPU: nine layers of lightmap, and the grid as a storage buffer.
struct IndirectLight {
    gpu::Image lightmap; ///< RGBA32F, one layer per coefficient; 1x1 black where there is none
    gpu::Buffer grid;    ///< as IndirectField::grid; one element where there is none
    glm::uvec3 gridSize{0};
    Bounds gridBounds;
    std::uint64_t version = ~0ull;

    bool hasLightmap = false;
    bool hasGrid() const { return gridSize.x > 0; }
};

IndirectLight createIndirectLight(gpu::Device& device);

/// Uploads if field.version is new. False: nothing was done.
bool updateIndirectLight(gpu::Device& device, IndirectLight& target, const IndirectField& field);

/// Fills the grid's rows of `frame`.
void describeGrid(const IndirectLight& light, shared::GpuFrame& frame);

} // namespace limn::render
