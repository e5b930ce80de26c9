// SPDX-License-Identifier: MIT
#include "engine/render/kept_lights.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>

namespace limn {

/// Sets `kept`. Growing the number of places frees all of them.
void KeptLights::makeRoom(std::uint32_t lights) {
    const VkDeviceSize perLight = std::max<std::size_t>(m_points, 1) * sizeof(float),
                       maxBytes = std::min<VkDeviceSize>(
                           kMaxBytes, m_device.properties.limits.maxStorageBufferRange);
    kept = std::uint32_t(std::min<VkDeviceSize>(lights, maxBytes / perLight));
    if (!unit || kept > m_places.size()) {
        const VkDeviceSize room =
            std::min<VkDeviceSize>(std::max(2 * kept, 1U), maxBytes / perLight);
        m_places.assign(room, {});
        unit = {m_device,
                {.size = std::max<VkDeviceSize>(room, 1) * perLight,
                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                 .name = "light of lights"}};
    }
    if (const VkDeviceSize bytes = 2 * std::max(kept, 1U) * sizeof(std::uint32_t);
        !places || places.size < bytes)
        places = {m_device,
                  {.size = 2 * bytes,
                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                   .memory = gpu::MemoryKind::Upload,
                   .name = "places of lights"}};
}

void KeptLights::forget() {
    m_places.assign(m_places.size(), {});
}

void KeptLights::assign(const ShadowedLights& lights) {
    assert(lights.shapes.size() == lights.count);
    makeRoom(lights.count);
    if (lights.casters != m_casters)
        forget();
    m_casters = lights.casters;
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    for (std::uint32_t p = 0; p < m_places.size(); ++p) {
        if (m_places[p].taken)
            known.emplace(m_places[p].shape, p);
        m_places[p].taken = false;
    }
    std::vector<std::uint32_t> placeOf(kept), freshLights;
    for (std::uint32_t k = 0; k < kept; ++k) {
        const auto found = known.find(lights.shapes[k]);
        if (found == known.end()) {
            freshLights.push_back(k);
            continue;
        }
        placeOf[k] = found->second;
        m_places[found->second].taken = true;
    }
    std::uint32_t free = 0;
    for (const std::uint32_t k : freshLights) {
        while (m_places[free].taken)
            ++free;
        m_places[free] = {lights.shapes[k], true};
        placeOf[k] = free;
    }
    fresh = std::uint32_t(freshLights.size());
    auto* out = static_cast<std::uint32_t*>(places.mapped);
    std::ranges::copy(placeOf, out);
    std::ranges::copy(freshLights, out + kept);
}

} // namespace limn
