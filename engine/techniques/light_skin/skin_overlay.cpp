// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_overlay.h"

#include "engine/math/luminance.h"
#include "engine/math/sampling.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/scene/origin.h"
#include "engine/techniques/light_skin/light_skin.h"
#include "engine/techniques/light_skin/skin_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kMarkPi = std::numbers::pi_v<float>;
constexpr std::size_t kShownVirtualLights = 8192; ///< of each light, besides the chosen ones
constexpr std::size_t kMaxProxies = 4000;         ///< when none is picked
constexpr float kDotScale = 0.1f;                 ///< radius of dots over the caches' spacing
constexpr std::uint32_t kWayDots = 24;            ///< from a cache to its proxy
constexpr std::uint32_t kSphereDots = 64;         ///< on a proxy's sphere
constexpr std::size_t kWeightsOverlay = 3;        ///< in kSkinOverlays
const glm::vec3 kDiffuseColor(0.2f, 0.8f, 1), kGlossyColor(1, 0.85f, 0.2f),
    kShaderColor(0.95f, 0.2f, 0.1f), kPickColor(1, 1, 1), kSampleColor(0.3f, 1, 0.3f);

float meanLuminance(std::span<const glm::vec3> values) {
    double sum = 0;
    std::size_t count = 0;
    for (const glm::vec3 v : values)
        if (const float y = luminance(v); y > 0) {
            sum += double(y);
            ++count;
        }
    return count > 0 ? float(sum / double(count)) : 1;
}

OverlayMark discOf(const LightCaches& caches, std::size_t c, glm::vec3 color) {
    return {.position = caches.position[c],
            .radius = std::sqrt(caches.area[c] / kMarkPi),
            .normal = caches.normal[c],
            .color = packColor(color)};
}

OverlayData cacheOverlay(const LitSkin& lit, std::uint32_t picked) {
    OverlayData out;
    const float mean = meanLuminance(lit.irradiance);
    for (std::size_t c = 0; c < lit.caches->size(); ++c)
        out.marks.push_back(
            discOf(*lit.caches, c, c == picked ? kPickColor : lightColor(lit.irradiance[c], mean)));
    out.legend.title = "Irradiance at light caches, before shade";
    out.legend.entries = lightColorEntries(mean, "W/m²");
    out.legend.notes = {
        fmt::format("{} caches; a disc has the area that its cache stands for", out.marks.size())};
    return out;
}

OverlayData importanceOverlay(const LitSkin& lit) {
    OverlayData out;
    for (const ShownVirtualLight& light : lit.lights) {
        const float radius = std::sqrt(light.area / kMarkPi);
        out.marks.push_back(
            {.position = light.position,
             .radius = radius,
             .normal = light.normal,
             .color = packColor(viridis(light.importance / (light.importance + 1)))});
        if (light.weight > 0)
            out.marks.push_back({.position = light.position,
                                 .radius = radius * std::sqrt(1 + light.weight),
                                 .normal = light.normal,
                                 .color = packColor(kShaderColor),
                                 .shape = MarkShape::Ring});
    }
    out.legend.title = "Importance of virtual area lights";
    for (const float share : {3.f, 1.f, 1 / 3.f, 0.f})
        out.legend.entries.push_back(
            {packColor(viridis(share / (share + 1))),
             share > 0 ? fmt::format("{:.2g} times the mean", share) : "none"});
    out.legend.entries.push_back(
        {packColor(kShaderColor),
         fmt::format("ring: one of the {} chosen, of the area it stands for", lit.chosen)});
    out.legend.notes = {fmt::format("{} of {} texels are drawn", lit.lights.size(), lit.allLights)};
    return out;
}

void addDot(glm::vec3 position, float radius, glm::vec3 color, OverlayData& out) {
    out.marks.push_back({.position = position, .radius = radius, .color = packColor(color)});
}

/// A proxy of a cache, the way to it and the sphere around all it stands for.
void addProxy(const LitSkin& lit, std::size_t c, const ProxyLight& proxy, glm::vec3 color,
              OverlayData& out) {
    const float dot = kDotScale * lit.caches->spacing;
    const glm::vec3 from = lit.caches->position[c];
    for (std::uint32_t i = 1; i < kWayDots; ++i)
        addDot(glm::mix(from, proxy.position, float(i) / kWayDots), dot / 2, color, out);
    addDot(proxy.position, 2 * dot, color, out);
    const DirectionSet directions(kSphereDots, true, 0);
    for (std::uint32_t i = 0; i < directions.count; ++i)
        addDot(proxy.position + directions[i] * proxy.radius(), dot / 2, color, out);
}

OverlayData proxyOverlay(const LitSkin& lit, std::uint32_t picked) {
    OverlayData out;
    const LightCaches& caches = *lit.caches;
    const std::size_t count = caches.size();
    out.legend.title = "Proxy lights";
    if (picked >= count) {
        const float mean = meanLuminance({lit.flux.data(), count});
        const std::size_t step = (count + kMaxProxies - 1) / kMaxProxies;
        for (std::size_t c = 0; c < count; c += std::max<std::size_t>(step, 1))
            addDot(lit.proxies[c].diffuse.position, kDotScale * caches.spacing,
                   lightColor(lit.flux[c], mean), out);
        out.legend.entries = lightColorEntries(mean, "W");
        out.legend.notes = {
            fmt::format("Flux of {} of {} diffuse proxy lights", out.marks.size(), count)};
        return out;
    }
    out.marks.push_back(discOf(caches, picked, kPickColor));
    addProxy(lit, picked, lit.proxies[picked].diffuse, kDiffuseColor, out);
    out.legend.entries = {{packColor(kPickColor), "the picked cache"},
                          {packColor(kDiffuseColor), "its diffuse proxy light"}};
    if (!lit.exponents.empty()) {
        addProxy(lit, picked, lit.proxies[picked].glossy, kGlossyColor, out);
        out.legend.entries.push_back({packColor(kGlossyColor), "its glossy proxy light"});
    }
    if (lit.shade)
        for (const ShadingDiscs::Shader& shader :
             ShadingDiscs(caches).shadersOf(picked, lit.proxies[picked].diffuse))
            out.marks.push_back(discOf(caches, shader.cache, kShaderColor));
    out.legend.entries.push_back({packColor(kShaderColor), "caches that shade the diffuse one"});
    out.legend.notes = {"A sphere has twice the largest deviation of the virtual lights' places"};
    return out;
}

OverlayData weightOverlay(const LitSkin& lit, const SkinWeights& weights) {
    OverlayData out;
    const float largest =
        weights.count > 0
            ? *std::max_element(weights.weight.begin(), weights.weight.begin() + weights.count)
            : 1;
    for (std::size_t i = 0; i < weights.count; ++i)
        out.marks.push_back(
            discOf(*lit.caches, weights.cache[i], viridis(weights.weight[i] / largest)));
    out.legend.title = "Weights of caches";
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back({packColor(viridis(float(k) / 4)),
                                      fmt::format("{:.1f} %", double(25 * float(k) * largest))});
    out.legend.notes = {fmt::format("{} caches light this place", weights.count)};
    return out;
}

OverlayData sampleOverlay(const LitSkin& lit) {
    OverlayData out;
    for (std::size_t i = 0; i < lit.samples.size(); ++i)
        out.marks.push_back({.position = lit.samples.position[i],
                             .radius = 2 * kDotScale * lit.caches->spacing,
                             .normal = lit.samples.normal[i],
                             .color = packColor(kSampleColor)});
    out.legend.title = "View samples";
    out.legend.entries = {{packColor(kSampleColor), fmt::format("{} places", out.marks.size())}};
    if (out.marks.empty())
        out.legend.notes = {"Every texel lights the caches, so none is needed"};
    return out;
}

/// Weights at the place of a cache.
SkinWeights weightsAt(const LightCaches& caches, const Scene& scene, std::uint32_t c) {
    const std::uint32_t instance = caches.instance[c];
    const MeshCache& cache =
        caches.instances[instance].skin->caches[c - caches.instances[instance].first];
    std::array<std::uint32_t, NearestCaches::kLength> list;
    const std::size_t count = caches.find({.instance = instance,
                                           .triangle = cache.triangle,
                                           .u = cache.u,
                                           .v = cache.v,
                                           .position = caches.position[c],
                                           .normal = caches.normal[c],
                                           .mesh = &scene.meshOf(scene.instances[instance])},
                                          list);
    return skinWeights(caches, {list.data(), count}, caches.position[c], caches.normal[c]);
}

/// Adds some of a light's texels, all chosen ones among them.
void addShown(const SkinLight& light, LitSkin& lit) {
    const VirtualLights& all = light.lights;
    std::vector<float> weight(all.size(), 0);
    for (std::size_t i = 0; i < light.chosen.light.size(); ++i)
        weight[light.chosen.light[i]] = light.chosen.weight[i];
    double sum = 0;
    for (const float importance : light.importance)
        sum += double(importance);
    const double mean = all.size() > 0 ? sum / double(all.size()) : 0;
    const std::size_t step = (all.size() + kShownVirtualLights - 1) / kShownVirtualLights;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (weight[i] <= 0 && step > 1 && mixBits(std::uint32_t(i)) % step != 0)
            continue;
        ShownVirtualLight shown{all.positionOf(i), all.normalOf(i), all.area[i], 1, weight[i]};
        if (mean > 0)
            shown.importance = float(double(light.importance[i]) / mean);
        lit.lights.push_back(shown);
    }
    lit.allLights += all.size();
    lit.chosen += light.chosen.light.size();
}

/// Normal of the side that was hit.
glm::vec3 sideOf(const Hit& hit) {
    return hit.frontFace ? hit.geometricNormal : -hit.geometricNormal;
}

/// The caches in the list of the surface that was hit.
std::vector<std::uint32_t> listAt(const LightCaches& caches, const Scene& scene, const Hit& hit) {
    if (hit.instance >= scene.instances.size())
        return {};
    std::array<std::uint32_t, NearestCaches::kLength> list;
    const std::size_t count = caches.find({.instance = hit.instance,
                                           .triangle = hit.triangle,
                                           .u = hit.u,
                                           .v = hit.v,
                                           .position = hit.position,
                                           .normal = sideOf(hit),
                                           .mesh = &scene.meshOf(scene.instances[hit.instance])},
                                          list);
    return {list.begin(), list.begin() + count};
}

} // namespace

LitSkin litSkinOf(const SkinState& state, const SkinInputs& inputs) {
    LitSkin lit{.caches = state.objects().caches(),
                .proxies = state.objects().proxies(),
                .irradiance =
                    std::vector<glm::vec3>(state.objects().caches()->size(), glm::vec3(0)),
                .flux = state.objects().fluxes(state.gathered(inputs.sources)),
                .exponents = state.objects().exponents(),
                .samples = state.samples(),
                .shade = inputs.settings.shade};
    for (const RsmSource& source : inputs.sources) {
        const SkinLight& light = *state.lightOf(source.shape);
        for (std::size_t c = 0; c < lit.irradiance.size(); ++c)
            lit.irradiance[c] += source.colour * light.sums[c].diffuse.light;
        addShown(light, lit);
    }
    return lit;
}

const Technique& SkinSnapshot::technique() const {
    return kLightSkinTechnique;
}

OverlayData SkinSnapshot::overlay(const OverlayRequest& request, const Scene& scene,
                                  const LightSnapshot* /*light*/) const {
    if (!request.kind)
        return {};
    switch (request.kind - kSkinOverlays.data()) {
    case 0:
        return cacheOverlay(m_lit, request.pick);
    case 1:
        return importanceOverlay(m_lit);
    case 2:
        return proxyOverlay(m_lit, request.pick);
    case kWeightsOverlay:
        return request.pick < pickCount()
                   ? weightOverlay(m_lit, weightsAt(*m_lit.caches, scene, request.pick))
                   : OverlayData{};
    case 4:
        return sampleOverlay(m_lit);
    default:
        return {};
    }
}

std::optional<std::uint32_t> SkinSnapshot::pickAt(const Scene& scene, const Hit& hit) const {
    const std::vector<std::uint32_t> list = listAt(*m_lit.caches, scene, hit);
    if (list.empty())
        return {};
    return *std::ranges::min_element(list, {}, [&](std::uint32_t c) {
        return glm::distance(m_lit.caches->position[c], hit.position);
    });
}

std::vector<OverlayLine> SkinSnapshot::describeAt(const OverlayRequest& request, const Scene& scene,
                                                  const Hit& hit,
                                                  const LightSnapshot* light) const {
    if (request.kind != &kSkinOverlays[kWeightsOverlay])
        return LightSnapshot::describeAt(request, scene, hit, light);
    const LightCaches& caches = *m_lit.caches;
    const SkinWeights weights =
        skinWeights(caches, listAt(caches, scene, hit), hit.position, sideOf(hit));
    std::vector<OverlayLine> lines = {
        {OverlayLine::Style::Heading, fmt::format("Lit by {} caches", weights.count)}};
    for (std::size_t i = 0; i < weights.count; ++i)
        lines.push_back(
            {OverlayLine::Style::Plain,
             fmt::format("{:.1f} % of cache {}, {:.3g} m away", double(100 * weights.weight[i]),
                         weights.cache[i],
                         glm::distance(caches.position[weights.cache[i]], hit.position))});
    return lines;
}

std::optional<std::uint32_t> SkinSnapshot::nearestPick(const OverlaySource& other,
                                                       std::uint32_t pick) const {
    const LightCaches& before = *static_cast<const SkinSnapshot&>(other).m_lit.caches;
    const std::vector<glm::vec3>& places = m_lit.caches->position;
    if (places.empty() || pick >= before.size())
        return {};
    const auto nearest = std::ranges::min_element(
        places, {}, [&](glm::vec3 p) { return glm::distance(p, before.position[pick]); });
    return std::uint32_t(nearest - places.begin());
}

std::vector<OverlayLine> SkinSnapshot::describePick(const Scene& scene, std::uint32_t pick) const {
    using Style = OverlayLine::Style;
    const LightCaches& caches = *m_lit.caches;
    if (pick >= caches.size())
        return {};
    const glm::vec3 e = m_lit.irradiance[pick];
    std::vector<OverlayLine> lines = {
        {Style::Plain, fmt::format("Cache {} of {}", pick, caches.size())},
        {Style::Plain, placeText(scene.origin, caches.position[pick])},
        {Style::Plain, fmt::format("Area {:.3g} m²", caches.area[pick]),
         "Of the surfaces that are nearer to it than to other caches"},
        {Style::Plain, fmt::format("Irradiance {:.3g} {:.3g} {:.3g} W/m²", e.x, e.y, e.z),
         "That it receives, before shade"}};
    const auto describe = [&](const char* heading, const ProxyLight& proxy, glm::vec3 flux) {
        lines.push_back({Style::Separator, ""});
        lines.push_back({Style::Heading, heading});
        lines.push_back(
            {Style::Plain,
             fmt::format("{:.3g} m away, spread {:.3g} m",
                         glm::distance(proxy.position, caches.position[pick]), proxy.radius()),
             "The spread is twice the largest deviation of what it stands for"});
        lines.push_back(
            {Style::Plain, fmt::format("Flux {:.3g} {:.3g} {:.3g} W", flux.x, flux.y, flux.z)});
        lines.push_back({Style::Plain,
                         fmt::format("Shaded by {:.0f} %", double(100 * (1 - proxy.lit))),
                         "Share of its light that other caches take on the way"});
    };
    describe("Diffuse proxy light", m_lit.proxies[pick].diffuse, m_lit.flux[pick]);
    if (!m_lit.exponents.empty())
        describe("Glossy proxy light", m_lit.proxies[pick].glossy,
                 m_lit.flux[caches.size() + pick]);
    return lines;
}

} // namespace limn
