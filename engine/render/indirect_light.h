// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/render/gpu_field.h"
#include "shaders/shared/gpu_frame.h"

#include <memory>

namespace limn::render {

/// The indirect field that frames sample.
struct IndirectLight {
    std::shared_ptr<const GpuField> field;
    std::shared_ptr<const std::vector<std::uint16_t>> depth; ///< gridDepth of what was uploaded
};

/// Black where the field is empty. How far cells see is the bake's: it is not uploaded again where
/// `before` has it.
IndirectLight uploadIndirectLight(gpu::Device& device, const IndirectField& field,
                                  const IndirectLight& before = {});

/// limn::reflectionTable() as a sampled array of RGBA32F.
gpu::Image uploadReflectionTable(gpu::Device& device);

/// Fills the grid's rows of `frame`, and the field's unit.
void describeField(const GpuField& field, shared::GpuFrame& frame);

} // namespace limn::render
