// SPDX-License-Identifier: MIT
#include "engine/render/shadows/light_table.h"

#include "engine/core/hash.h"
#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace limn::render {

using shared::GpuLight;

static_assert(LIGHT_MOST_IRRADIANCE == kMaxIrradiance);

static GpuLight gpuLight(const Light& light, const ShadowSlot& shadow) {
    GpuLight g{};
    g.position = light.position;
    g.inverseRange = light.range > 0 ? 1 / light.range : 0;
    g.direction = light.direction;
    g.kind = light.kind == LightKind::Directional ? LIGHT_DIRECTIONAL
             : light.kind == LightKind::Spot      ? LIGHT_SPOT
             : light.kind == LightKind::Rectangle ? LIGHT_RECTANGLE
                                                  : LIGHT_POINT;
    g.strength = light.color * light.strength;
    g.cosOuter = std::cos(light.outerAngle);
    g.spotScale = 1 / (std::max(std::cos(light.innerAngle), g.cosOuter + 1e-4f) - g.cosOuter);
    g.halfWidth = lightRectangle(light).halfWidth;
    g.halfHeight = light.size.y / 2;
    g.shadowViews = shadow.count;
    g.firstView = shadow.first;
    g.cascades = shadow.cascades;
    return g;
}

/// Entry of ShadowedLights::shapes; independent of where the light's views are in the table.
static std::uint64_t shapeOf(GpuLight light, const shared::GpuShadowView* views) {
    const std::uint64_t shadow =
        hashBytes(views, (light.shadowViews + light.cascades) * sizeof(shared::GpuShadowView));
    light.strength = glm::vec3(1);
    light.firstView = 0;
    return hashBytes(&light, sizeof light, shadow);
}

template <class T>
static void write(gpu::Device& device, gpu::Buffer& buffer, const std::vector<T>& values,
                  const char* name) {
    const VkDeviceSize bytes = values.size() * sizeof(T);
    if (!buffer || buffer.size < bytes)
        buffer = gpu::Buffer(device, {.size = std::max<VkDeviceSize>(2 * bytes, 1024),
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                      .memory = gpu::MemoryKind::Upload,
                                      .name = name});
    if (bytes > 0)
        std::memcpy(buffer.mapped, values.data(), bytes);
}

void writeLightTable(gpu::Device& device, LightTable& table, const std::vector<Light>& lights,
                     const std::vector<ShadowSlot>& slots,
                     const std::vector<shared::GpuShadowView>& views) {
    assert(slots.size() == lights.size());
    std::vector<GpuLight> rows;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (slots[i].count > 0)
            rows.push_back(gpuLight(lights[i], slots[i]));
    table.shapes.clear();
    for (const GpuLight& row : rows)
        table.shapes.push_back(shapeOf(row, views.data() + row.firstView));
    write(device, table.lights, rows, "lights");
    write(device, table.shadowViews, views, "shadow views");
    table.count = std::uint32_t(rows.size());
}

} // namespace limn::render
