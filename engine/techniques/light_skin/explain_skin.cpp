// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/explain_skin.h"

#include "engine/field/field_reading.h"

#include <algorithm>
#include <map>
#include <utility>

namespace limn {

namespace {

/// The chosen lights of each object.
std::map<std::uint32_t, GatheringLights> byInstance(const SkinLight& light, float diagonal) {
    std::map<std::uint32_t, ChosenLights> chosen;
    for (std::size_t i = 0; i < light.chosen.light.size(); ++i) {
        ChosenLights& part = chosen[light.lights.instance[light.chosen.light[i]]];
        part.light.push_back(light.chosen.light[i]);
        part.weight.push_back(light.chosen.weight[i]);
    }
    std::map<std::uint32_t, GatheringLights> from;
    for (const auto& [instance, part] : chosen)
        from.emplace(instance, gatheringLights(light.lights, part, diagonal));
    return from;
}

/// What the numbers of a reading receive of virtual lights, times their weights and the proxies'
/// flux per light.
glm::dvec3 valueOfLights(const SkinState& state, const SkinInputs& inputs,
                         const FieldReading& reading, const GatheringLights& from) {
    const std::size_t caches = state.objects().caches()->size();
    const glm::vec3* eye = inputs.eye();
    glm::dvec3 sum(0);
    for (const FieldReading::PartNumber& number : reading.partNumbers) {
        const bool glossy = number.index >= caches;
        const std::size_t c = glossy ? number.index - caches : number.index;
        const CacheSums received =
            gatherLight(from, gatheringCache(*state.objects().caches(), state.objects().exponents(),
                                             glossy ? eye : nullptr, c));
        const CacheProxies& both = state.objects().proxies()[c];
        const ProxyLight& proxy = glossy ? both.glossy : both.diffuse;
        const glm::vec3 light = glossy ? received.glossy.light : received.diffuse.light;
        sum += glm::dvec3(number.weight * light) * (double(proxy.fluxOfLight) * double(proxy.lit));
    }
    return sum;
}

} // namespace

Explanation explainSkin(const SkinState& state, const SkinInputs& inputs, const Scene& scene,
                        const FieldReading& reading, const ExplainOptions& options) {
    Explanation e{.bounces = 1};
    std::map<std::uint32_t, glm::dvec3> byObject;
    for (const RsmSource& source : inputs.sources) {
        glm::dvec3 ofLight(0);
        for (const auto& [instance, from] :
             byInstance(*state.lightOf(source.shape), state.objects().caches()->diagonal)) {
            if (std::ranges::find(options.black, instance) != options.black.end())
                continue;
            const glm::dvec3 value =
                glm::dvec3(source.colour) * valueOfLights(state, inputs, reading, from);
            ofLight += value;
            byObject[instance] += value;
        }
        addRow(e.byOrigin, {.kind = LightRowKind::Light,
                            .label = scene.lights[source.index].name,
                            .index = source.index,
                            .value = glm::vec3(ofLight)});
    }
    if (!options.black.empty())
        return e;
    std::vector<LightRow> senders;
    for (const auto& [instance, value] : byObject)
        senders.push_back({.kind = LightRowKind::Surface,
                           .label = objectLabel(scene, instance),
                           .index = instance,
                           .value = glm::vec3(value)});
    for (LightRow& row : strongest(std::move(senders), options.rows))
        addRow(e.bySender, std::move(row));
    return e;
}

} // namespace limn
