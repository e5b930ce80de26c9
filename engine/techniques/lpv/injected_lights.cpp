// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/injected_lights.h"

#include "engine/math/sampling.h"
#include "engine/rsm/reflective_shadow_map.h"
#include "engine/scene/light/unit_light.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/lpv/blockers.h"

#include <algorithm>
#include <map>
#include <numbers>

namespace limn {

namespace {

/// A lobe about `normal` from a surface at `p`.
LobeSample lobeOff(const Lattice& lattice, glm::vec3 p, glm::vec3 normal, glm::vec3 weight) {
    const glm::vec3 off = p + normal * (lattice.cell * 0.5f);
    return {lattice.index(lattice.at(off)), normal, weight};
}

} // namespace

InjectedLight injectLight(const TraceScene& trace, const Scene& scene, const Light& light,
                          std::uint32_t mapSize, const Lattice& lattice, const Progress& progress) {
    const ReflectiveShadowMap map = castRsm(trace, scene, light, mapSize, progress);
    std::map<std::uint32_t, std::vector<LobeSample>> samples; // by instance
    for (const RsmTexel& t : map.texels)
        samples[t.instance].push_back(
            lobeOff(lattice, t.position, t.normal,
                    t.albedo * (t.incident * std::numbers::inv_pi_v<float>)));
    InjectedLight injected{
        .shape = unitLight(light), .allTexels = map.texels.size(), .rays = map.rays};
    const std::size_t shown = std::min(map.texels.size(), kShownTexels);
    for (std::size_t k = 0; k < shown; ++k) {
        // One of each stretch at random: even steps would pick texels in rows.
        const std::size_t begin = k * map.texels.size() / shown,
                          end = (k + 1) * map.texels.size() / shown;
        const RsmTexel& t = map.texels[begin + mixBits(std::uint32_t(k)) % (end - begin)];
        injected.texels.push_back({t.position, t.normal, t.albedo * t.incident});
    }
    for (const auto& [instance, ofIt] : samples)
        injected.parts.push_back({instance, sumByCell(ofIt, lattice.cells())});
    return injected;
}

std::vector<InjectedInstance> injectEmitters(const Scene& scene, const Lattice& lattice) {
    std::vector<InjectedInstance> parts;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!emits(scene.materialOf(instance)))
            continue;
        std::vector<SurfacePiece> pieces;
        addPieces(scene, i, lattice.cell * 0.5f, pieces);
        std::vector<LobeSample> samples;
        for (const SurfacePiece& p : pieces) {
            const glm::vec3 radiance = surfaceMaterialOver(scene, instance, p.triangle,
                                                           p.barycentric.x, p.barycentric.y, p.area)
                                           .emission;
            samples.push_back(lobeOff(lattice, p.position, p.normal, radiance * p.area));
            if (p.twoSided)
                samples.push_back(lobeOff(lattice, p.position, -p.normal, radiance * p.area));
        }
        parts.push_back({i, sumByCell(samples, lattice.cells())});
    }
    return parts;
}

void addInjected(std::span<const InjectedInstance> parts, glm::vec3 colour, const Lattice& lattice,
                 std::span<const std::uint32_t> black, CellLight& cells) {
    for (const InjectedInstance& part : parts) {
        if (std::ranges::find(black, part.instance) != black.end())
            continue;
        for (const CellLobe& cell : part.cells) {
            Lobe lobe = cell.lobe;
            for (glm::vec3& harmonic : lobe)
                harmonic *= colour;
            cells.add(glm::ivec3(lattice.place(cell.cell)), lobe);
        }
    }
}

} // namespace limn
