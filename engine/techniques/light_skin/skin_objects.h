// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/light_skin/gather_light.h"
#include "engine/techniques/light_skin/light_caches.h"
#include "engine/techniques/light_skin/proxy_lights.h"
#include "engine/techniques/light_skin/proxy_shade.h"
#include "engine/techniques/light_skin/skin_inputs.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace limn {

/// A key with the number of times that it has changed.
template <class Key>
struct Versioned {
    Key key;
    std::uint64_t version = 0;

    /// Returns whether that is a change.
    bool follow(Key now) {
        if (version > 0 && now == key)
            return false;
        key = std::move(now);
        ++version;
        return true;
    }
};

/// What following the inputs took.
struct SkinCost {
    double cacheMs = 0, mapMs = 0, importanceMs = 0, choiceMs = 0, gatherMs = 0, shadeMs = 0;
    std::uint64_t rays = 0, traced = 0;     ///< of maps and view samples; lights cast anew
    std::uint64_t meshes = 0, gathered = 0; ///< meshes given caches; lights gathered anew
};

/// A light that shines, with what caches receive of one of colour 1 and strength 1.
struct GatheredSource {
    const Light* shape;
    glm::vec3 colour;
    const std::vector<CacheSums>* sums;
};

/// The objects of a scene with their caches and proxies, which do not depend on who gathers the
/// light.
class SkinObjects {
public:
    /// Brings the caches up to date with `now`, the inputs of `scene`. Returns whether maps of
    /// lights are out of date, too.
    bool follow(const Scene& scene, const SkinInputs& now, SkinCost& cost);

    /// Places and shades the proxies, where that is out of date. `gathers` changes whenever any
    /// sums do. Call after follow(). Returns false if cancelled.
    bool place(const SkinInputs& now, std::span<const GatheredSource> sources,
               std::uint64_t gathers, const Progress& progress, SkinCost& cost);

    /// Flux of the diffuse proxies, then of the glossy ones [W]. Call after place().
    std::vector<glm::vec3> fluxes(std::span<const GatheredSource> sources) const;

    const std::shared_ptr<const LightCaches>& caches() const { return m_caches; }
    const std::vector<float>& exponents() const { return m_exponents; }
    const std::vector<CacheProxies>& proxies() const { return m_proxies; }

    // Increase whenever that changes; 0: not yet.
    std::uint64_t surfaces() const { return m_surfaces.version; } ///< what maps and caches are of
    /// How caches gather: their places, the eye, and the exponents of their lobes.
    std::uint64_t gathering() const { return m_gathering.version; }

    std::uint64_t bytes() const;

private:
    struct SurfaceKey {
        RsmSurfaces surfaces;
        SkinLayout layout;
        std::uint32_t mapSize = 0;
        bool operator==(const SurfaceKey&) const = default;
    };
    struct GatheringKey {
        std::uint64_t surfaces = 0;
        std::vector<SkinGloss> gloss;
        std::optional<glm::vec3> eye;
        bool operator==(const GatheringKey&) const = default;
    };
    struct ProxyKey {
        std::uint64_t gathers = 0;
        std::vector<Light> shapes; ///< that shine
        bool shade = false;
        bool operator==(const ProxyKey&) const = default;
    };

    MeshSkins m_skins;
    std::shared_ptr<const LightCaches> m_caches;
    std::optional<ShadingDiscs> m_discs;
    std::vector<float> m_exponents; ///< empty where nothing glossy is asked for
    std::vector<CacheProxies> m_proxies;
    Versioned<SurfaceKey> m_surfaces;
    Versioned<GatheringKey> m_gathering;
    std::optional<ProxyKey> m_placed; ///< of m_proxies
};

/// Distance below which lights beside a view sample count alike [m]: diagonal / 30.
inline float nearestSample(float diagonal) {
    return std::max(diagonal / 30, 1e-20f);
}

} // namespace limn
