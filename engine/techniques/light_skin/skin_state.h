// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/light_skin/draw_renewal.h"
#include "engine/techniques/light_skin/importance.h"
#include "engine/techniques/light_skin/skin_objects.h"
#include "engine/techniques/light_skin/virtual_lights.h"

#include <cstdint>
#include <functional>
#include <map>
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

    /// Whether further updates with the same inputs would renew more of the draws.
    bool isRenewing() const;

    const SkinObjects& objects() const { return m_objects; }
    const ViewSamples& samples() const { return m_samples; }
    /// The kept light with that shape; null if there is none.
    const SkinLight* lightOf(const Light& shape) const;

    /// These sources, for SkinObjects. Call after follow().
    std::vector<GatheredSource> gathered(std::span<const RsmSource> sources) const;

    /// Bytes of everything that updates read and write.
    std::uint64_t bytes() const;

private:
    void followSamples(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                       SkinCost& cost);
    bool castLights(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                    const Progress& progress, SkinCost& cost);
    void choose(const SkinInputs& now, const RsmSource& source, SkinCost& cost);
    void chooseAll(const SkinInputs& now, SkinCost& cost);
    bool gather(const SkinInputs& now, const Progress& progress, SkinCost& cost);

    /// What the kept results were made of.
    struct SampleKey {
        std::uint64_t surfaces = 0;
        std::optional<Viewpoint> view;
        std::uint32_t count = 0;
        bool all = false, visibleCaches = false;
        bool operator==(const SampleKey&) const = default;
    };
    struct ChoiceKey {
        std::uint64_t samples = 0;
        std::uint32_t vals = 0;
        float defence = 0;
        bool all = false;
        bool operator==(const ChoiceKey&) const = default;
    };

    /// The draws of a light, which last when it moves or an object does.
    struct KeptDraws {
        Light shape; ///< of the light for which they were made last
        LightDraws draws;
        DrawRenewal renewal;
    };

    SkinObjects m_objects;
    ViewSamples m_samples;
    std::vector<SkinLight> m_lights;
    std::map<std::uint32_t, KeptDraws> m_draws; ///< by index into Scene::lights
    std::uint32_t m_sources = 0;                ///< number of lights that shine
    Versioned<SampleKey> m_sampled;
    Versioned<ChoiceKey> m_choice;
    std::uint64_t m_gathers = 0; ///< of lights, since the beginning
};

} // namespace limn
