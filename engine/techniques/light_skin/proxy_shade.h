// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/light_skin/light_caches.h"
#include "engine/techniques/light_skin/proxy_lights.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// What something covers of the unit disc about a cache's normal, on which areas are form factors
/// times pi (Nusselt's analog), as a square with sides along the axes of that disc.
struct DiscSquare {
    glm::vec2 centre{0};
    float side = 0;
};

/// Area that two squares share.
float overlapOf(const DiscSquare& a, const DiscSquare& b);

/// Discs of all caches' areas, in the cells of a grid, by which they shade proxies.
class ShadingDiscs {
public:
    explicit ShadingDiscs(const LightCaches& caches);

    /// Share of a proxy's light that discs of other caches take on its way to cache `c`: of the
    /// square that the sphere around the proxy covers, the sum of what the squares of discs between
    /// both cover of it. Nothing where the sphere holds the cache.
    /// Lensing, Broll. LightSkin. 2013, as summed up by Bischoff, Schwandt, Broll. 2017, section
    /// 3.1.
    float shadeOf(std::size_t c, const ProxyLight& proxy) const;

    /// Calls visit(disc, share) for all discs that shade it.
    struct Shader {
        std::uint32_t cache = 0;
        float share = 0;
    };
    std::vector<Shader> shadersOf(std::size_t c, const ProxyLight& proxy) const;

    std::uint64_t bytes() const;

private:
    struct Cell {
        glm::vec3 middle{0};
        float radius = 0;      ///< around the middles of its discs [m]
        float largestArea = 0; ///< [m^2]
        std::uint32_t first = 0, count = 0;
    };
    template <class Visit>
    void visitShaders(std::size_t c, const ProxyLight& proxy, const Visit& visit) const;

    const LightCaches& m_caches;
    std::vector<Cell> m_cells;
    std::vector<std::uint32_t> m_discs; ///< numbers of caches, by cell
};

/// Discs whose form factor is below this shade nothing.
inline constexpr float kMinShadingFactor = 1e-4f;

/// Sets ProxyLight::lit of all proxies.
void shadeProxies(const LightCaches& caches, const ShadingDiscs& discs,
                  std::span<CacheProxies> proxies, const Progress& progress = {});

} // namespace limn
