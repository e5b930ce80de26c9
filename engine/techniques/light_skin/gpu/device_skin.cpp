// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/gpu/device_skin.h"

#include "engine/core/stopwatch.h"
#include "engine/lighting/relight.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/scene/light/unit_light.h"
#include "engine/techniques/light_skin/skin_overlay.h"
#include "engine/techniques/light_skin/skin_report.h"
#include "engine/techniques/light_skin/skin_state.h"

#include <algorithm>

namespace limn {

Result<std::unique_ptr<DeviceSkin>> DeviceSkin::create(gpu::Device& device, Viewport& viewport) {
    auto lights = GpuSkinLights::create(device, viewport);
    if (!lights)
        return tl::make_unexpected(lights.error());
    return std::unique_ptr<DeviceSkin>(new DeviceSkin(device, viewport, std::move(*lights)));
}

LightingReport DeviceSkin::update(const LightingInput& input, const Progress& progress) {
    Stopwatch whole;
    Cost cost;
    const std::uint64_t before = m_lights->dispatches();
    LightingReport report = relightUnlessSame(
        skinInputsOf(input.scene, input.view), m_inputs, isRenewing(), [&](const SkinInputs& now) {
            if (!relight(input.scene, now, progress, cost))
                return Relit::Cancelled;
            m_scene = input.scene;
            return isRenewing() ? Relit::InPart : Relit::Whole;
        });
    cost.dispatches = m_lights->dispatches() - before;
    if (m_pass)
        m_viewport.setIndirect(m_pass);
    describe(cost, report);
    report.lacks = sourcesLeftOut(input.scene, {.profiles = false});
    report.totalMs = whole.lap();
    return report;
}

/// Draws the maps of lights that have none. False if cancelled.
bool DeviceSkin::castMaps(const Scene& scene, const SkinInputs& now, const Progress& progress,
                          Cost& cost) {
    Stopwatch clock;
    std::erase_if(m_kept, [&](const Kept& kept) {
        return std::ranges::none_of(
            scene.lights, [&](const Light& light) { return unitLight(light) == kept.shape; });
    });
    for (const RsmSource& source : now.sources) {
        if (std::ranges::find(m_kept, source.shape, &Kept::shape) != m_kept.end())
            continue;
        if (progress.cancelled())
            return false;
        m_kept.push_back(
            {.shape = source.shape,
             .lights = m_lights->cast(source.shape, scene.bounds, now.settings.mapSize)});
        cost.views += m_kept.back().lights.views;
        ++cost.traced;
    }
    cost.mapMs += clock.lap();
    return true;
}

void DeviceSkin::followSamples(const Scene& scene, const SkinInputs& now, Cost& cost) {
    Stopwatch clock;
    const SkinSettings& s = now.settings;
    if (m_samples.follow({m_objects.surfaces(), s.all ? std::nullopt : now.view, s.samples, s.vals,
                          s.defence, s.all, s.visibleCaches})) {
        if (!s.all && now.view && s.visibleCaches) {
            m_lights->findSeenCaches(*m_objects.caches(), *now.view, scene.bounds);
            ++cost.views;
        } else if (!s.all && now.view) {
            m_lights->findSamples(*now.view, scene.bounds, s.samples);
            ++cost.views;
        } else if (!s.all) {
            m_lights->setSamples(samplesOfSurfaces(scene, s.samples));
        }
    }
    cost.importanceMs += clock.lap();
}

/// The draws of a light that are to be made now; none where they are not out of date.
std::optional<DrawBlock> DeviceSkin::drawsOf(const SkinInputs& now, const RsmSource& source,
                                             const Kept& light) {
    KeptDraws& kept = m_draws[source.index];
    const SkinSettings& s = now.settings;
    const bool changed = light.choice != m_samples.version;
    if (s.all || light.lights.count() <= s.vals) {
        kept.renewal = {};
        return changed ? std::optional(DrawBlock{}) : std::nullopt;
    }
    if (changed || kept.shape != light.shape)
        kept.renewal.begin({light.shape.kind, light.lights.columns, light.lights.rows,
                            std::uint32_t(now.sources.size()), s, now.view.has_value()});
    kept.shape = light.shape;
    return kept.renewal.isDue() ? std::optional(kept.renewal.next()) : std::nullopt;
}

bool DeviceSkin::isRenewing() const {
    return std::ranges::any_of(m_draws,
                               [](const auto& kept) { return kept.second.renewal.isDue(); });
}

/// Gathers the lights whose sums are out of date. False if cancelled.
bool DeviceSkin::gather(const SkinInputs& now, const Progress& progress, Cost& cost) {
    Stopwatch clock;
    const SkinSettings& s = now.settings;
    if (m_cachesOf != m_objects.gathering()) {
        m_lights->setCaches(*m_objects.caches(), m_objects.exponents());
        m_cachesOf = m_objects.gathering();
    }
    std::erase_if(m_draws, [&](const auto& draws) {
        return std::ranges::find(now.sources, draws.first, &RsmSource::index) == now.sources.end();
    });
    for (const RsmSource& source : now.sources) {
        if (std::ranges::find(now.sources, source.shape, &RsmSource::shape)->index != source.index)
            continue; // lights of the same shape have the same sums
        Kept& kept = *std::ranges::find(m_kept, source.shape, &Kept::shape);
        const std::optional<DrawBlock> part = drawsOf(now, source, kept);
        if (!part && kept.gathering == m_objects.gathering())
            continue;
        kept.gathering = kept.choice = 0;
        // Draws that are not out of date come out the same once more.
        if (!m_lights->gather(kept.lights,
                              {.count = s.vals,
                               .defence = s.defence,
                               .all = s.all,
                               .nearest = nearestSample(m_objects.caches()->diagonal),
                               .diagonal = m_objects.caches()->diagonal,
                               .eye = now.eye(),
                               .part = part.value_or(DrawBlock{}),
                               .draws = &m_draws[source.index].draws},
                              kept.sums, progress)) {
            m_draws.erase(source.index);
            return false;
        }
        kept.gathering = m_objects.gathering();
        kept.choice = m_samples.version;
        ++m_gathers;
        ++cost.gathered;
    }
    cost.gatherMs += clock.lap();
    return true;
}

std::vector<GatheredSource> DeviceSkin::gathered(const SkinInputs& now) const {
    std::vector<GatheredSource> all;
    for (const RsmSource& source : now.sources) {
        const Kept& kept = *std::ranges::find(m_kept, source.shape, &Kept::shape);
        all.push_back({&kept.shape, source.colour, &kept.sums});
    }
    return all;
}

SkinPart::Light DeviceSkin::lightOf(const SkinInputs& now) const {
    SkinPart::Light light{
        m_objects.caches(), m_objects.proxies(), m_objects.fluxes(gathered(now)), {}};
    if (const glm::vec3* eye = now.eye())
        light.eye = *eye;
    return light;
}

void DeviceSkin::show(const SkinInputs& now, Cost& cost) {
    Stopwatch clock;
    if (m_skinOf != m_objects.surfaces()) {
        m_skin = uploadSkin(m_device, *m_objects.caches());
        m_skinOf = m_objects.surfaces();
        cost.bytesUploaded += m_skin->bytes();
    }
    auto proxies = std::make_shared<const gpu::Buffer>(uploadProxies(m_device, lightOf(now)));
    cost.bytesUploaded += proxies->size;
    m_pass = std::make_shared<SkinPass>(m_device, m_viewport, m_skin, std::move(proxies),
                                        now.isGlossy());
    cost.fieldMs = clock.lap();
}

/// False if cancelled.
bool DeviceSkin::relight(const Scene& scene, const SkinInputs& now, const Progress& progress,
                         Cost& cost) {
    if (m_objects.follow(scene, now, cost))
        m_kept.clear();
    if (!castMaps(scene, now, progress, cost))
        return false;
    followSamples(scene, now, cost);
    if (!gather(now, progress, cost) ||
        !m_objects.place(now, gathered(now), m_gathers, progress, cost))
        return false;
    show(now, cost);
    return true;
}

IndirectField DeviceSkin::readField() const {
    IndirectField field;
    field.bands = 2;
    if (m_inputs)
        field.parts = {std::make_shared<const SkinPart>(lightOf(*m_inputs))};
    return field;
}

std::shared_ptr<const LightSnapshot> DeviceSkin::snapshot() const {
    if (!m_inputs)
        return nullptr;
    const TraceScene trace(m_scene);
    SkinState state;
    SkinCost cost;
    state.follow(
        m_scene, *m_inputs, [&]() -> const TraceScene& { return trace; }, {}, cost);
    return std::make_shared<const SkinSnapshot>(litSkinOf(state, *m_inputs));
}

void DeviceSkin::describe(const Cost& cost, LightingReport& report) const {
    std::uint64_t bytes = m_objects.bytes() + m_lights->bytes();
    for (const Kept& kept : m_kept)
        bytes += kept.lights.texels.size + kept.sums.size() * sizeof(CacheSums);
    if (m_pass)
        bytes += m_pass->bytes();
    describeSkin(m_objects, bytes, cost, report);
    report.steps.push_back({"field", "Field", "Caches and proxy lights are sent", cost.fieldMs});
    report.counters.push_back({"map_views", "Views drawn",
                               "Views drawn for shadow maps and view samples", double(cost.views)});
    report.counters.push_back(
        {"dispatches", "Dispatches", "Compute dispatches of the device", double(cost.dispatches)});
    report.counters.push_back({"bytes_uploaded", "Bytes uploaded",
                               "Caches, lists and proxy lights sent to the device",
                               double(cost.bytesUploaded)});
}

Result<std::unique_ptr<Lighting>> lightSkinOnDevice(gpu::Device& device, Viewport& viewport,
                                                    const Prepared& /*prepared*/) {
    return DeviceSkin::create(device, viewport);
}

} // namespace limn
