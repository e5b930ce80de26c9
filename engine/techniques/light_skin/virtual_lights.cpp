// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/virtual_lights.h"

#include "engine/rsm/reflective_shadow_map.h"

#include <algorithm>
#include <numeric>

namespace limn {

std::uint64_t VirtualLights::bytes() const {
    return size() * (10 * sizeof(float) + 2 * sizeof(std::uint32_t));
}

void VirtualLights::add(glm::vec3 p, glm::vec3 n, glm::vec3 reflected, float discArea,
                        std::uint32_t of, std::uint32_t at) {
    for (int k = 0; k < 3; ++k) {
        position[std::size_t(k)].push_back(p[k]);
        normal[std::size_t(k)].push_back(n[k]);
        flux[std::size_t(k)].push_back(reflected[k]);
    }
    area.push_back(discArea);
    instance.push_back(of);
    cell.push_back(at);
}

VirtualLights castVirtualLights(const TraceScene& trace, const Scene& scene, const Light& light,
                                std::uint32_t mapSize, const Progress& progress) {
    const ReflectiveShadowMap map = castRsm(trace, scene, light, mapSize, progress);
    VirtualLights lights{.rays = map.rays};
    // The whole raster, whatever the light sees: texels then keep their numbers when it moves.
    const std::vector<RsmView> views =
        rsmViews(light, scene.bounds, mapSize, [](glm::vec3 p, glm::vec3) { return p; });
    lights.rows = views.empty() ? 0 : views[0].size;
    lights.columns = std::uint32_t(views.size()) * lights.rows;
    const auto cellOf = [&](const RsmTexel& t) {
        return (t.view * lights.rows + t.place.x) * lights.rows + t.place.y;
    };
    std::vector<std::uint32_t> order(map.texels.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return cellOf(map.texels[i]); });
    for (const std::uint32_t i : order) {
        const RsmTexel& t = map.texels[i];
        lights.add(t.position, t.normal, t.albedo * t.incident, t.area, t.instance, cellOf(t));
    }
    return lights;
}

} // namespace limn
