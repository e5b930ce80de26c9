// SPDX-License-Identifier: MIT
#include "engine/render/indirect_light.h"

#include "engine/core/log.h"
#include "engine/field/field_packing.h"
#include "engine/field/grid_depth.h"
#include "engine/gpu/uploader.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include <fmt/format.h>

namespace limn::render {

static gpu::Image uploadLightmap(gpu::Device& device, gpu::Uploader& uploader,
                                 const IndirectField& field, float scale) {
    assert(field.lightmap.size() ==
           std::size_t(field.lightmapWidth) * field.lightmapHeight * field.coefficients());
    const std::uint32_t layers = fieldLayers(field.bands, field.chroma());
    const std::vector<glm::u16vec4> texels =
        field.lightmap.empty() ? std::vector<glm::u16vec4>(layers, glm::u16vec4(0))
                               : packField(field.lightmap, field.bands, field.chroma(), scale);
    gpu::Image image = createFieldLightmap(device, field.lightmapWidth, field.lightmapHeight,
                                           layers, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    uploader.image(image, std::as_bytes(std::span(texels)));
    return image;
}

// What weights the grid's cells; empty if nothing does.
static std::span<const std::byte> cellMapsOf(const IndirectField& field) {
    if (field.gridMoments)
        return std::as_bytes(std::span(field.gridMoments->texels));
    return field.gridDepth ? std::as_bytes(std::span(*field.gridDepth))
                           : std::span<const std::byte>();
}

// Creates a new field, because a frame in flight may still sample the old one.
static std::shared_ptr<const GpuField> uploadField(gpu::Device& device, const IndirectField& field,
                                                   std::shared_ptr<const gpu::Buffer> cellMaps) {
    gpu::Uploader uploader(device);
    auto out = std::make_shared<GpuField>();
    out->scale = fieldScale(std::max(brightestOf(field.lightmap), brightestOf(field.grid)));
    out->lightmap = uploadLightmap(device, uploader, field, out->scale);
    std::vector<glm::u16vec4> cells =
        packField(field.grid, field.bands, field.chroma(), out->scale);
    const std::size_t bytes = cells.size() * sizeof(glm::u16vec4);
    const bool fits = bytes <= device.properties.limits.maxStorageBufferRange;
    if (!fits)
        logWarning(
            fmt::format("the grid of {} MiB is larger than this device can bind: no indirect "
                        "light without lightmap",
                        bytes >> 20));
    const bool any = bytes > 0 && fits;
    if (!any)
        cells.assign(1, glm::u16vec4(0));
    out->grid = uploader.buffer(std::as_bytes(std::span(cells)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                "grid");
    out->bands = field.bands;
    out->chroma = field.chroma();
    out->continues = field.continues;
    out->gridSize = any ? field.gridSize : glm::uvec3(0);
    out->gridBounds = field.gridBounds;
    const std::span<const std::byte> maps = cellMapsOf(field);
    if (any && !maps.empty())
        out->gridDepth = cellMaps ? std::move(cellMaps)
                                  : std::make_shared<const gpu::Buffer>(uploader.buffer(
                                        maps, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "grid depths"));
    if (field.gridMoments)
        out->gridWeights = field.gridMoments->smooth ? GRID_SMOOTH_MOMENTS : GRID_MOMENTS;
    uploader.flush(); // before other work is submitted
    return out;
}

IndirectLight uploadIndirectLight(gpu::Device& device, const IndirectField& field,
                                  const IndirectLight& before) {
    const std::shared_ptr<const void> cells =
        field.gridMoments ? std::shared_ptr<const void>(field.gridMoments) : field.gridDepth;
    const bool same = before.cells && before.cells == cells;
    return {.field = uploadField(device, field, same ? before.field->gridDepth : nullptr),
            .cells = cells};
}

void describeField(const GpuField& field, GeometryView& view) {
    view.bands = field.bands;
}

void describeField(const GpuField& field, shared::GpuFrame& frame) {
    frame.fieldUnit = 1 / field.scale;
    frame.cutBelow = field.continues ? 1.f : 0.f;
    if (!field.hasGrid())
        return;
    const glm::vec3 size = glm::max(field.gridBounds.size(), glm::vec3(1e-20f));
    frame.gridLower = field.gridBounds.lower;
    frame.gridSize = field.gridSize;
    frame.gridScale = glm::vec3(field.gridSize) / size;
    frame.gridReach = gridReach(field.gridBounds, field.gridSize);
    frame.gridWeights = field.gridDepth ? field.gridWeights : GRID_PLAIN;
    frame.gridCells = field.gridSize.x * field.gridSize.y * field.gridSize.z;
}

} // namespace limn::render
