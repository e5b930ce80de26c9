// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/baked_illuminance.h"

#include "engine/techniques/illuminance/bake/bake_cost.h"
#include "engine/techniques/illuminance/bake/bake_prediction.h"
#include "engine/techniques/illuminance/format/bake_defect.h"
#include "engine/techniques/illuminance/format/bake_file.h"
#include "engine/techniques/illuminance/illuminance.h"
#include "engine/techniques/illuminance/illuminance_snapshot.h"
#include "engine/techniques/illuminance/overlay/cut_text.h"
#include "engine/techniques/illuminance/overlay/link_cut.h"
#include "engine/techniques/illuminance/overlay/overlay.h"
#include "engine/techniques/illuminance/overlay/surface_text.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

static std::vector<LightingCounter> countersOf(const BakeCounts& c) {
    return {{"triangles", "Triangles", "Of the baked scene", double(c.triangles)},
            {"surfels", "Surfels", "", double(c.surfels)},
            {"clusters", "Clusters", "", double(c.clusters)},
            {"caches", "Caches", "Lightmap texels and grid cells", double(c.caches)},
            {"invalid_caches", "  invalid", "Inside walls; filled from their neighbours",
             double(c.invalidCaches)},
            {"links", "Links", "", double(c.links)},
            {"rays", "Rays", "Traced by the last bake", double(c.rays)}};
}

static std::vector<LightingCounter> countersOf(const BakeBytes& b) {
    const auto bytes = [](const char* id, const char* label, std::uint64_t value) {
        return LightingCounter{id, label, "", double(value), CounterUnit::Bytes};
    };
    return {bytes("surfels", "Surfels", b.surfels), bytes("clusters", "Clusters", b.clusters),
            bytes("links", "Links", b.links), bytes("caches", "Caches", b.caches)};
}

const Technique& BakedIlluminance::technique() const {
    return kIlluminanceTechnique;
}

glm::uvec3 BakedIlluminance::gridSize() const {
    return m_bake->caches.size() > m_bake->caches.lightmapCount ? m_bake->gridSize : glm::uvec3(0);
}

PrecomputedReport BakedIlluminance::report() const {
    return {countersOf(m_bake->counts), countersOf(bytesOf(*m_bake)), m_bake->seconds,
            m_bake->keptStages, m_bake->notes};
}

// The power of four that the bytes of the links reach.
std::string BakedIlluminance::sizeClass() const {
    return fmt::format("links 4^{}", std::bit_width(bytesOf(*m_bake).links) / 2);
}

PrecomputedCost BakedIlluminance::expectedCost(const Scene& scene, const BakeSettings& wanted,
                                               const PrecomputedCost& measured) const {
    if (wanted == m_bake->settings)
        return measured; // without the rounding of what follows
    Scene with = scene;
    with.bake = m_bake->settings;
    const BakeWork expected = expectedWork(with), made = workOf(*m_bake, expected);
    with.bake = wanted;
    const BakeWork next = expectedWork(with) * (made / expected);
    PrecomputedCost cost = measured;
    for (auto& [stage, seconds] : cost.seconds)
        seconds *= stageWork(stage, next) / stageWork(stage, made);
    cost.updateMs = 0;
    for (LightingStep& step : cost.update)
        cost.updateMs += step.ms *= updateWork(step.id, next) / updateWork(step.id, made);
    cost.bytes *= next.bytes / made.bytes;
    return cost;
}

std::string BakedIlluminance::defect(const Scene& scene) const {
    return bakeDefect(*m_bake, &scene);
}

Result<void> BakedIlluminance::write(const std::string& path) const {
    return writeBake(path, *m_bake);
}

static Overlay kindOf(const OverlayKind* kind) {
    return kind ? Overlay(kind - kOverlays.data()) : Overlay::None;
}

static OverlayOptions optionsOf(const OverlayRequest& request) {
    return {.kind = kindOf(request.kind), .depth = request.depth, .cache = request.pick};
}

static const LitBake* litOf(const LightSnapshot* light) {
    return light ? &static_cast<const IlluminanceSnapshot*>(light)->lit : nullptr;
}

OverlayData BakedIlluminance::overlay(const OverlayRequest& request, const Scene& scene,
                                      const LightSnapshot* light) const {
    return makeOverlay(*m_bake, scene, optionsOf(request), litOf(light));
}

std::uint32_t BakedIlluminance::maxOverlayDepth() const {
    return treeDepth(m_bake->tree);
}

std::optional<std::uint32_t> BakedIlluminance::pickAt(const Scene& scene, const Hit& hit) const {
    return cacheAt(*m_bake, scene, hit);
}

// The cache of the same kind nearest to a place.
std::optional<std::uint32_t> BakedIlluminance::nearestPick(const OverlaySource& other,
                                                           std::uint32_t pick) const {
    const Caches& caches = m_bake->caches;
    const Caches& before = static_cast<const BakedIlluminance&>(other).bake()->caches;
    std::optional<std::uint32_t> nearest;
    float best = std::numeric_limits<float>::max();
    for (std::uint32_t c = 0; c < caches.size(); ++c)
        if (const float d = glm::distance(caches.position[c], before.position[pick]);
            caches.kind[c] == before.kind[pick] && d < best)
            nearest = c, best = d;
    return nearest;
}

std::vector<OverlayLine> BakedIlluminance::describePick(const Scene& scene,
                                                        std::uint32_t pick) const {
    return describeCut(*m_bake, scene, pick);
}

std::vector<OverlayLine> BakedIlluminance::describeAt(const OverlayRequest& request,
                                                      const Scene& scene, const Hit& hit,
                                                      const LightSnapshot* light) const {
    return describeSurface(*m_bake, scene, optionsOf(request), hit, litOf(light));
}

const std::shared_ptr<const Bake>& bakeOf(const Precomputed& data) {
    assert(&data.technique() == &kIlluminanceTechnique);
    return static_cast<const BakedIlluminance&>(data).bake();
}

Prediction predictIlluminance(const Scene& scene, bool stored) {
    const BakePrediction p = predictBake(scene, stored);
    return {.caches = p.caches,
            .minTexels = p.minTexels,
            .bytes = countersOf(p.bytes),
            .file = p.file,
            .working = p.working};
}

BakeSettings previewSettings(BakeSettings settings) {
    settings.rays = std::min(settings.rays, 64U);
    settings.links = std::min(settings.links, 32U);
    settings.surfels = std::min(settings.surfels, 8192U);
    return settings;
}

} // namespace limn
