// SPDX-License-Identifier: MIT
#include "engine/render/shadows/light_table.h"

#include "engine/core/hash.h"
#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>

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
    if (const LightProfile* profile = profileOf(light)) {
        g.halfWidth = profileAxes(light)[0];
        g.profileSize = profile->rows | profile->columns << 16;
        g.firstVertical = profile->firstVertical;
        g.lastVertical = profile->lastVertical;
    }
    return g;
}

/// Adds the values of a light's profile to those of others, which come after `rows` lights, and
/// tells the light where they are. Lights that share a profile share its values.
static void addProfile(const LightProfile* profile, std::size_t rows,
                       std::map<const LightProfile*, std::uint32_t>& begins,
                       std::vector<float>& values, GpuLight& light) {
    if (!profile)
        return;
    const auto begin = std::uint32_t(rows * sizeof(GpuLight) / sizeof(float) + values.size());
    const auto [place, isNew] = begins.emplace(profile, begin);
    if (isNew)
        values.insert(values.end(), profile->share.begin(), profile->share.end());
    light.profile = place->second;
}

/// Entry of ShadowedLights::shapes; independent of where the light's views and its profile are in
/// the table.
static std::uint64_t shapeOf(GpuLight light, const LightProfile* profile,
                             const shared::GpuShadowView* views) {
    std::uint64_t seed =
        hashBytes(views, (light.shadowViews + light.cascades) * sizeof(shared::GpuShadowView));
    if (profile)
        seed = hashBytes(profile->share.data(), profile->share.size() * sizeof(float), seed);
    light.strength = glm::vec3(1);
    light.firstView = light.profile = 0;
    return hashBytes(&light, sizeof light, seed);
}

/// `more` follows `values`.
template <class T>
static void write(gpu::Device& device, gpu::Buffer& buffer, const std::vector<T>& values,
                  const char* name, const std::vector<float>& more = {}) {
    const VkDeviceSize first = values.size() * sizeof(T),
                       bytes = first + more.size() * sizeof(float);
    if (!buffer || buffer.size < bytes)
        buffer = gpu::Buffer(device, {.size = std::max<VkDeviceSize>(2 * bytes, 1024),
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                      .memory = gpu::MemoryKind::Upload,
                                      .name = name});
    if (first > 0)
        std::memcpy(buffer.mapped, values.data(), first);
    if (!more.empty())
        std::memcpy(static_cast<std::byte*>(buffer.mapped) + first, more.data(), bytes - first);
}

void writeLightTable(gpu::Device& device, LightTable& table, const std::vector<Light>& lights,
                     const std::vector<ShadowSlot>& slots,
                     const std::vector<shared::GpuShadowView>& views) {
    assert(slots.size() == lights.size());
    std::vector<GpuLight> rows;
    std::vector<const LightProfile*> profiles; // of each row
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (slots[i].count > 0) {
            rows.push_back(gpuLight(lights[i], slots[i]));
            profiles.push_back(profileOf(lights[i]));
        }
    std::map<const LightProfile*, std::uint32_t> begins;
    std::vector<float> values;
    table.shapes.clear();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        addProfile(profiles[i], rows.size(), begins, values, rows[i]);
        table.shapes.push_back(shapeOf(rows[i], profiles[i], views.data() + rows[i].firstView));
    }
    write(device, table.lights, rows, "lights", values);
    write(device, table.shadowViews, views, "shadow views");
    table.count = std::uint32_t(rows.size());
}

} // namespace limn::render
