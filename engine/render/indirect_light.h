// SPDX-License-Identifier: MIT
#pragma once

#include "engine/relight/indirect_field.h"
#include "engine/relight_gpu/gpu_field.h"
#include "shaders/shared/gpu_frame.h"

#include <memory>

namespace limn::render {

/// The indirect field that frames sample.
struct IndirectLight {
    std::shared_ptr<const GpuField> field;
    std::uint64_t version = ~0ull; ///< of the IndirectField that `field` was uploaded from
    std::shared_ptr<const std::vector<std::uint16_t>> depth; ///< its gridDepth
};

/// A black one.
IndirectLight createIndirectLight(gpu::Device& device);

/// Uploads if field.version is new. False: nothing was done.
bool updateIndirectLight(gpu::Device& device, IndirectLight& target, const IndirectField& field);

/// Fills the grid's rows of `frame`.
void describeGrid(const GpuField& field, shared::GpuFrame& frame);

} // namespace limn::render
