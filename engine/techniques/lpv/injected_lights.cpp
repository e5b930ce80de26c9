// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/injected_lights.h"

#include "engine/rsm/reflective_shadow_map.h"

#include <numbers>

namespace limn {

InjectedLight injectLight(const TraceScene& trace, const Scene& scene, const Light& light,
                          std::uint32_t mapSize, const Lattice& lattice, const Progress& progress) {
    const ReflectiveShadowMap map = castRsm(trace, scene, light, mapSize, progress);
    std::vector<LobeSample> samples;
    samples.reserve(map.texels.size());
    for (const RsmTexel& texel : map.texels) {
        const glm::vec3 off = texel.position + texel.normal * (lattice.cell * 0.5f);
        samples.push_back({lattice.index(lattice.at(off)), texel.normal,
                           texel.albedo * (texel.incident * std::numbers::inv_pi_v<float>)});
    }
    return {rsmShape(light), sumByCell(samples, lattice.cells()), map.texels.size(), map.rays};
}

void addLight(const InjectedLight& light, glm::vec3 colour, const Lattice& lattice,
              CellLight& cells) {
    for (const CellLobe& cell : light.cells) {
        Lobe lobe = cell.lobe;
        for (glm::vec3& harmonic : lobe)
            harmonic *= colour;
        cells.add(glm::ivec3(lattice.place(cell.cell)), lobe);
    }
}

} // namespace limn
