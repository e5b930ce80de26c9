// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/light_skin/gather_light.h"
#include "engine/techniques/light_skin/importance.h"
#include "engine/techniques/light_skin/light_caches.h"
#include "engine/techniques/light_skin/proxy_lights.h"
#include "engine/techniques/light_skin/proxy_shade.h"
#include "engine/techniques/light_skin/skin_inputs.h"
#include "engine/techniques/light_skin/virtual_lights.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace limn {

/// A light with all that follows from it but its colour.
struct SkinLight {
    Light shape; ///< unitLight()
    VirtualLights lights;
    std::vector<float> importance;
    ChosenLights chosen;
    std::vector<CacheSums> sums; ///< by cache
    // Versions of what these were made of; 0: they were not yet.
    std::uint64_t importanceOf = 0, chosenOf = 0, sumsOf = 0;

    std::uint64_t bytes() const;
};

/// What following the inputs took.
struct SkinCost {
    double cacheMs = 0, mapMs = 0, importanceMs = 0, choiceMs = 0, gatherMs = 0, shadeMs = 0;
    std::uint64_t rays = 0, traced = 0;     ///< of maps and view samples; lights cast anew
    std::uint64_t meshes = 0, gathered = 0; ///< meshes given caches; lights gathered anew
};

/// What a scene's lights do to the caches on its objects, on the CPU, kept from one update to the
/// next. Only what has changed is made again: an edit of colours casts, chooses and gathers
/// nothing.
class SkinState {
public:
    /// Returns the trace scene of the scene that is lit. It is called only where rays are needed.
    using TraceOf = std::function<const TraceScene&()>;

    /// Brings everything up to date with `now`, the inputs of `scene`. Returns false if cancelled;
    /// what was finished by then is kept.
    bool follow(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                const Progress& progress, SkinCost& cost);

    const std::shared_ptr<const LightCaches>& caches() const { return m_caches; }
    const std::vector<float>& exponents() const { return m_exponents; }
    const std::vector<CacheProxies>& proxies() const { return m_proxies; }
    const ViewSamples& samples() const { return m_samples; }
    const ShadingDiscs& discs() const { return *m_discs; }
    /// The kept light with that shape; null if there is none.
    const SkinLight* lightOf(const Light& shape) const;

    /// Flux of the diffuse proxies, then of the glossy ones [W], for light of these sources.
    std::vector<glm::vec3> fluxes(std::span<const RsmSource> sources) const;

    /// Bytes of everything that updates read and write.
    std::uint64_t bytes() const;

private:
    void followSurfaces(const Scene& scene, const SkinInputs& now, SkinCost& cost);
    void followSamples(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                       SkinCost& cost);
    bool castLights(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                    const Progress& progress, SkinCost& cost);
    void choose(const SkinInputs& now, SkinLight& light, SkinCost& cost);
    bool gather(const Scene& scene, const SkinInputs& now, const Progress& progress,
                SkinCost& cost);
    bool placeProxies(const SkinInputs& now, const Progress& progress, SkinCost& cost);

    /// What the kept results were made of.
    struct SurfaceKey {
        RsmSurfaces surfaces;
        SkinLayout layout;
        std::uint32_t mapSize = 0;
        bool operator==(const SurfaceKey&) const = default;
    };
    struct SampleKey {
        std::uint64_t surfaces = 0;
        std::optional<Viewpoint> view;
        std::uint32_t count = 0;
        bool all = false;
        bool operator==(const SampleKey&) const = default;
    };
    struct ChoiceKey {
        std::uint64_t samples = 0;
        std::uint32_t vals = 0;
        float defence = 0;
        bool all = false;
        bool operator==(const ChoiceKey&) const = default;
    };
    struct GatherKey {
        std::uint64_t surfaces = 0;
        std::vector<SkinGloss> gloss;
        std::optional<glm::vec3> eye;
        bool operator==(const GatherKey&) const = default;
    };
    struct ProxyKey {
        std::uint64_t gathers = 0;
        std::vector<Light> shapes; ///< that shine
        bool shade = false;
        bool operator==(const ProxyKey&) const = default;
    };
    /// A key with the number of times that it has changed.
    template <class Key>
    struct Versioned {
        Key key;
        std::uint64_t version = 0;
        bool follow(Key now) {
            if (version > 0 && now == key)
                return false;
            key = std::move(now);
            ++version;
            return true;
        }
    };

    MeshSkins m_skins;
    std::shared_ptr<const LightCaches> m_caches;
    std::optional<ShadingDiscs> m_discs;
    std::vector<float> m_exponents;
    float m_diagonal = 0;
    ViewSamples m_samples;
    std::vector<SkinLight> m_lights;
    std::vector<CacheProxies> m_proxies;
    Versioned<SurfaceKey> m_surfaces;
    Versioned<SampleKey> m_sampled;
    Versioned<ChoiceKey> m_choice;
    Versioned<GatherKey> m_gather;
    std::uint64_t m_gathers = 0;      ///< of lights, since the beginning
    std::optional<ProxyKey> m_placed; ///< of m_proxies
};

} // namespace limn
