// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/receiver_light.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace limn {

bool updateReceiverMaterials(const Receivers& receivers, const Scene& scene,
                             ReceiverMaterials& state) {
    const bool first = state.albedo.size() != receivers.size();
    if (!first && state.materials == scene.materials)
        return false;
    std::vector<char> stale(scene.materials.size(), 1);
    if (!first && state.materials.size() == scene.materials.size())
        std::ranges::transform(scene.materials, state.materials, stale.begin(),
                               std::not_equal_to{});
    state.albedo.resize(receivers.size());
    state.emission.resize(receivers.size());
    parallelRanges(receivers.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Instance& instance = scene.instances[receivers.instance[i]];
            if (!stale[instance.material])
                continue;
            const SurfaceMaterial m = surfaceMaterialOver(
                scene, instance, receivers.triangle[i], receivers.barycentric[i].x,
                receivers.barycentric[i].y, receivers.width[i] * receivers.width[i]);
            state.albedo[i] = m.albedo;
            state.emission[i] = m.emission;
        }
    });
    state.materials = scene.materials;
    return true;
}

bool noteChanges(bool gathering, bool light, const RelightSettings& settings,
                 Convergence& convergence) {
    const bool limitsChanged = convergence.applySettings(settings);
    if (gathering)
        convergence.skyChanged();
    else if (light)
        convergence.lightChanged();
    else if (!limitsChanged)
        return false;
    return convergence.restarts();
}

ReceiverAreas areasOf(const Receivers& receivers) {
    ReceiverAreas areas;
    for (const float width : receivers.width)
        areas.share.push_back(width * width);
    areas.total = std::accumulate(areas.share.begin(), areas.share.end(), 0.);
    for (float& share : areas.share)
        share = areas.total > 0 ? float(double(share) / areas.total) : 0;
    return areas;
}

} // namespace limn
