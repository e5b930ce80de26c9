// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/render/gpu_field.h"
#include "engine/render/passes/geometry_passes.h"
#include "shaders/shared/gpu_frame.h"

#include <memory>

namespace limn::render {

/// The indirect field that frames sample.
struct IndirectLight {
    std::shared_ptr<const GpuField> field;
    /// IndirectField::gridDepth or gridMoments of the uploaded field, to tell whether they changed.
    std::shared_ptr<const void> cells;
};

/// Uploads `field`; an empty field becomes black. What weights the grid's cells changes rarely, so
/// it is reused from `before` if it holds the same.
IndirectLight uploadIndirectLight(gpu::Device& device, const IndirectField& field,
                                  const IndirectLight& before = {});

/// Fills in the members of `frame` that describe the grid, and the field's unit.
void describeField(const GpuField& field, shared::GpuFrame& frame);
/// Fills in how surfaces read the field, besides its grid.
void describeField(const GpuField& field, GeometryView& view);

} // namespace limn::render
