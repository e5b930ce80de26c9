// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/sparse_overlay.h"

#include "engine/lightmap/fine_blocks.h"
#include "engine/lightmap/texel_points.h"
#include "engine/math/luminance.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/scene/origin.h"
#include "engine/techniques/sparse_probes/relight_rays.h"
#include "engine/techniques/sparse_probes/sparse_probes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using Style = OverlayLine::Style;

constexpr float kBallScale = 0.12f;        // a ball's radius over the distance of probes
constexpr std::uint32_t kMaxDots = 200000; // of all balls
constexpr std::uint32_t kDotsAlongLine = 48;
constexpr std::uint32_t kLobeDots = 512;
constexpr float kLobeScale = 4; // a lobe's reach over a ball's radius

const glm::vec3 kUnlitColor(0.6f), kSkyColor(0.35f, 0.7f, 0.9f), kDarkColor(1, 0, 1);

/// A part of the mean distance from a probe to the next one.
float ballRadius(const SparseBake& bake) {
    double sum = 0;
    for (const glm::vec3 p : bake.probes) {
        float nearest = std::numeric_limits<float>::max();
        for (const glm::vec3 q : bake.probes)
            if (q != p)
                nearest = std::min(nearest, glm::distance(p, q));
        sum += bake.probes.size() > 1 ? double(nearest) : 1;
    }
    return kBallScale * float(sum / double(std::max<std::size_t>(bake.probes.size(), 1)));
}

/// Mean luminance of what probes see; 1 if they are dark.
float middleOf(const SparseBake& bake, const ProbeRadiance& light) {
    const std::size_t count = bake.coefficients();
    double sum = 0;
    for (std::size_t p = 0; p < bake.probes.size(); ++p) {
        const float* c = &light[p * 3 * count];
        sum += double(luminance(glm::vec3(c[0], c[count], c[2 * count]))) * 0.28209479;
    }
    return sum > 0 ? float(sum / double(bake.probes.size())) : 1;
}

OverlayData ballOverlay(const SparseBake& bake, const ProbeRadiance* light) {
    const auto probes = std::uint32_t(bake.probes.size());
    const std::size_t count = bake.coefficients();
    const float radius = ballRadius(bake), middle = light ? middleOf(bake, *light) : 1;
    const DirectionSet directions(std::clamp(kMaxDots / std::max(probes, 1U), 48U, 512U), true, 0);
    std::vector<glm::vec3> way, color(directions.count, kUnlitColor);
    for (std::uint32_t k = 0; k < directions.count; ++k)
        way.push_back(directions[k]);
    const std::vector<float> basis = relightBasis(way, int(bake.sparse.bands));
    OverlayData out;
    for (std::uint32_t p = 0; p < probes; ++p) {
        for (std::uint32_t k = 0; light && k < directions.count; ++k) {
            const float* c = &(*light)[p * 3 * count];
            glm::vec3 radiance(0);
            for (std::size_t i = 0; i < count; ++i)
                radiance += basis[k * count + i] * glm::vec3(c[i], c[count + i], c[2 * count + i]);
            color[k] = luminance(radiance) < 0 ? kNegativeLight
                                               : lightColor(glm::max(radiance, 0.f), middle);
        }
        addBall(bake.probes[p], radius, directions, color, out.marks);
    }
    out.legend.title = "Probes and the light that reaches them";
    if (light) {
        out.legend.entries = lightColorEntries(middle, "nits");
        out.legend.entries.push_back(
            {packColor(kNegativeLight), "less than none: the harmonics ring"});
    }
    out.legend.notes = {
        fmt::format("{} probes; a ball's side shows the light that comes from there", probes)};
    return out;
}

OverlayData unseenOverlay(const SparseBake& bake) {
    const std::vector<float>& unseen = bake.transport.unseen;
    OverlayData out;
    out.width = bake.lightmap.width;
    out.height = bake.lightmap.height;
    out.texels.resize(std::size_t(out.width) * out.height);
    out.finer = fineBlocks(bake.lightmap);
    const float maximum = unseen.empty() ? 0 : std::ranges::max(unseen),
                scale = std::max(maximum, 1e-6f);
    for (std::size_t r = 0; r < unseen.size(); ++r)
        out.texels[bake.receivers.texel[r]] = packColor(viridis(unseen[r] / scale));
    out.legend.title = "Share of the view that no probe sees";
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back({packColor(viridis(float(k) / 4)),
                                      fmt::format("{:.3g} %", 100 * maximum * float(k) / 4)});
    const double mean = std::accumulate(unseen.begin(), unseen.end(), 0.) /
                        double(std::max<std::size_t>(unseen.size(), 1));
    out.legend.notes = {fmt::format("{:.2g} % on average", 100 * mean),
                        bake.sparse.unchecked > 0 ? "It is taken from all probes of the texel"
                                                  : "It is black"};
    return out;
}

/// A receiver with the probes that light it.
struct PickedReceiver {
    WorldPoint point; ///< on the side that receives
    NearProbes near;
    float weights = 0; ///< their sum
};

PickedReceiver pickedReceiver(const SparseBake& bake, const Scene& scene, std::uint32_t r) {
    const Receivers& all = bake.receivers;
    PickedReceiver picked;
    picked.point =
        worldPoint(scene, scene.instances[all.instance[r]], {all.triangle[r], all.barycentric[r]});
    if (all.back[r])
        picked.point.normal = -picked.point.normal;
    picked.near = nearestProbes(bake.probes, picked.point.position);
    picked.weights = std::accumulate(picked.near.weight.begin(), picked.near.weight.end(), 0.f);
    return picked;
}

OverlayData receiverOverlay(const SparseBake& bake, const Scene& scene, std::uint32_t r) {
    const PickedReceiver picked = pickedReceiver(bake, scene, r);
    const float radius = ballRadius(bake), width = bake.receivers.width[r];
    const glm::vec3 from = picked.point.position + picked.point.normal * (0.1f * width);
    OverlayData out;
    out.marks.push_back({.position = from,
                         .radius = std::max(width, 0.5f * radius),
                         .color = packColor(glm::vec3(1)),
                         .shape = MarkShape::Ring});
    for (std::uint32_t k = 0; k < kProbesPerReceiver && picked.near.probe[k] != kNoProbe; ++k) {
        const glm::vec3 probe = bake.probes[picked.near.probe[k]];
        const float share = picked.near.weight[k] / picked.weights;
        const std::uint32_t color = packColor(viridis(share / 0.5f));
        out.marks.push_back({.position = probe, .radius = radius, .color = color});
        for (std::uint32_t d = 1; d < kDotsAlongLine; ++d)
            out.marks.push_back({.position = glm::mix(from, probe, float(d) / kDotsAlongLine),
                                 .radius = 0.06f * radius,
                                 .color = color});
    }
    out.legend.title = fmt::format("Probes of texel {}", r);
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back(
            {packColor(viridis(float(k) / 4)), fmt::format("weight {:.3g} %", 12.5f * float(k))});
    out.legend.notes = {"What a ray of the texel meets is taken from those of them that see it"};
    return out;
}

OverlayData rayOverlay(const SparseBake& bake, const Scene& scene, std::uint32_t r) {
    const std::uint16_t probe = pickedReceiver(bake, scene, r).near.probe[0];
    if (probe == kNoProbe)
        return {.legend = {"Relight rays", {}, {"There are no probes"}}};
    const glm::vec3 from = bake.probes[probe];
    const ReceiverPoints points = pointsOf(scene, bake.receivers);
    const std::vector<glm::vec3> directions = relightDirections(bake.sparse.rays);
    const std::uint32_t* hits = &bake.hits[std::size_t(probe) * directions.size()];
    const float radius = ballRadius(bake);
    float farthest = 0;
    for (std::size_t q = 0; q < directions.size(); ++q)
        if (hits[q] < kDarkHit)
            farthest = std::max(farthest, glm::distance(points.position[hits[q]], from));
    OverlayData out;
    out.marks.push_back({.position = from,
                         .radius = 1.5f * radius,
                         .color = packColor(glm::vec3(1)),
                         .shape = MarkShape::Ring});
    std::uint32_t skies = 0, darks = 0;
    for (std::size_t q = 0; q < directions.size(); ++q) {
        const std::uint32_t hit = hits[q];
        skies += hit == kSkyHit ? 1 : 0;
        darks += hit == kDarkHit ? 1 : 0;
        if (hit >= kDarkHit) {
            const glm::vec3 color = hit == kSkyHit ? kSkyColor : kDarkColor;
            out.marks.push_back({.position = from + directions[q] * (2 * radius),
                                 .radius = 0.1f * radius,
                                 .color = packColor(color)});
            continue;
        }
        const float width = bake.receivers.width[hit];
        out.marks.push_back(
            {.position = points.position[hit] + points.normal[hit] * (0.05f * width),
             .radius = 0.5f * width,
             .normal = points.normal[hit],
             .color = packColor(
                 viridis(glm::distance(points.position[hit], from) / std::max(farthest, 1e-6f)))});
    }
    out.legend.title = fmt::format("What lights probe {}", probe);
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back({packColor(viridis(float(k) / 4)),
                                      fmt::format("texel at {:.3g} m", farthest * float(k) / 4)});
    out.legend.entries.push_back({packColor(kSkyColor), fmt::format("sky: {} rays", skies)});
    out.legend.entries.push_back(
        {packColor(kDarkColor), fmt::format("back of a solid: {} rays", darks)});
    out.legend.notes = {fmt::format("{} rays", directions.size())};
    return out;
}

/// A receiver's weights of the harmonics of all probes.
std::vector<float> transportRow(const SparseBake& bake, std::uint32_t r) {
    std::vector<glm::vec3> one(bake.receivers.size(), glm::vec3(0)),
        row(bake.probes.size() * bake.coefficients(), glm::vec3(0));
    one[r] = glm::vec3(1);
    addTransposed(bake, one, row);
    std::vector<float> weights;
    for (const glm::vec3 w : row)
        weights.push_back(w.x);
    return weights;
}

OverlayData rowOverlay(const SparseBake& bake, const Scene& scene, std::uint32_t r) {
    const std::size_t count = bake.coefficients();
    const std::vector<float> row = transportRow(bake, r);
    const DirectionSet directions(kLobeDots, true, 0);
    std::vector<glm::vec3> way;
    for (std::uint32_t k = 0; k < directions.count; ++k)
        way.push_back(directions[k]);
    const std::vector<float> basis = relightBasis(way, int(bake.sparse.bands));
    std::vector<std::vector<float>> lobes(bake.probes.size()); // [1/sr]
    float maximum = 0;
    for (std::size_t p = 0; p < bake.probes.size(); ++p) {
        const std::span coefficients = std::span(row).subspan(p * count, count);
        if (std::ranges::all_of(coefficients, [](float w) { return w == 0; }))
            continue;
        for (std::uint32_t k = 0; k < directions.count; ++k) {
            lobes[p].push_back(std::inner_product(coefficients.begin(), coefficients.end(),
                                                  basis.begin() + k * count, 0.f));
            maximum = std::max(maximum, std::abs(lobes[p].back()));
        }
    }
    const PickedReceiver picked = pickedReceiver(bake, scene, r);
    const float radius = ballRadius(bake), width = bake.receivers.width[r];
    OverlayData out;
    out.marks.push_back({.position = picked.point.position + picked.point.normal * (0.1f * width),
                         .radius = std::max(width, 0.5f * radius),
                         .color = packColor(glm::vec3(1)),
                         .shape = MarkShape::Ring});
    std::vector<glm::vec3> color(directions.count);
    for (std::size_t p = 0; p < lobes.size(); ++p) {
        float longest = 0;
        for (std::size_t k = 0; k < lobes[p].size(); ++k) {
            longest = std::max(longest, std::abs(lobes[p][k]));
            color[k] = lobes[p][k] < 0 ? kNegativeLight : viridis(lobes[p][k] / maximum);
        }
        if (longest > 0)
            addLobe({bake.probes[p], kLobeScale * radius * longest / maximum}, directions, lobes[p],
                    color, out.marks);
    }
    out.legend.title = fmt::format("Transport to texel {}", r);
    for (int k = 4; k >= 1; --k)
        out.legend.entries.push_back(
            {packColor(viridis(float(k) / 4)), fmt::format("{:.3g}", maximum * float(k) / 4)});
    out.legend.entries.push_back({packColor(kNegativeLight), "below zero: few bands ring"});
    out.legend.notes = {"Irradiance that the texel gets per radiance and solid angle from each "
                        "side of a probe; lobes are as long as that"};
    return out;
}

OverlayData negativeOverlay(const SparseBake& bake, const ProbeRadiance* light) {
    OverlayData out;
    out.legend.title = "Irradiance before it is kept from being negative";
    if (!light) {
        out.legend.notes = {"Nothing is lit yet"};
        return out;
    }
    std::vector<glm::vec3> irradiance;
    gatherReceivers(bake, *light, NotNegative::Nothing, irradiance);
    double bright = 0;
    float minimum = 0;
    std::size_t below = 0;
    for (const glm::vec3 e : irradiance) {
        bright += double(std::max(luminance(e), 0.f));
        minimum = std::min(minimum, luminance(e));
        below += luminance(e) < 0 ? 1 : 0;
    }
    const float mean = float(bright / double(std::max<std::size_t>(irradiance.size(), 1))),
                middle = mean > 0 ? mean : 1;
    out.width = bake.lightmap.width;
    out.height = bake.lightmap.height;
    out.texels.resize(std::size_t(out.width) * out.height);
    out.finer = fineBlocks(bake.lightmap);
    for (std::size_t r = 0; r < irradiance.size(); ++r)
        out.texels[bake.receivers.texel[r]] = packColor(
            luminance(irradiance[r]) < 0 ? kNegativeLight
                                         : lightColor(glm::max(irradiance[r], 0.f), middle));
    out.legend.entries = lightColorEntries(middle, "lux");
    out.legend.entries.push_back(
        {packColor(kNegativeLight),
         fmt::format("less than none: {} of {} texels", below, irradiance.size())});
    out.legend.notes = {fmt::format("The least is {:.3g} lux, {:.2g} % of the mean", minimum,
                                    100 * minimum / middle)};
    return out;
}

} // namespace

const Technique& SparseSnapshot::technique() const {
    return kSparseProbesTechnique;
}

OverlayData sparseOverlay(const SparseBake& bake, const OverlayRequest& request, const Scene& scene,
                          const ProbeRadiance* light) {
    if (!request.kind)
        return {};
    const bool picked = request.pick < bake.receivers.size();
    switch (request.kind - kSparseOverlays.data()) {
    case 0:
        return ballOverlay(bake, light);
    case 1:
        return unseenOverlay(bake);
    case 5:
        return negativeOverlay(bake, light);
    default:
        break;
    }
    if (!picked)
        return {.legend = {request.kind->label, {}, {"Click a surface to pick a texel"}}};
    switch (request.kind - kSparseOverlays.data()) {
    case 2:
        return receiverOverlay(bake, scene, request.pick);
    case 3:
        return rayOverlay(bake, scene, request.pick);
    default:
        return rowOverlay(bake, scene, request.pick);
    }
}

std::vector<OverlayLine> describeReceiver(const SparseBake& bake, const Scene& scene,
                                          std::uint32_t receiver) {
    const PickedReceiver picked = pickedReceiver(bake, scene, receiver);
    std::vector<OverlayLine> lines = {
        {Style::Plain,
         fmt::format("Texel {}, {:.3g} m wide", receiver, bake.receivers.width[receiver])},
        {Style::Plain, placeText(scene.origin, picked.point.position)},
        {Style::Plain, fmt::format("{:.3g} % unseen", 100 * bake.transport.unseen[receiver]),
         "Share of what the texel sees that none of its probes sees"},
        {Style::Separator, ""},
        {Style::Heading, "Its probes"}};
    for (std::uint32_t k = 0; k < kProbesPerReceiver && picked.near.probe[k] != kNoProbe; ++k)
        lines.push_back(
            {Style::Plain,
             fmt::format("{:5.1f} %  probe {}, {:.3g} m away",
                         100 * picked.near.weight[k] / picked.weights, picked.near.probe[k],
                         glm::distance(bake.probes[picked.near.probe[k]], picked.point.position)),
             "Weight of the probe where all of them see the same"});
    return lines;
}

std::optional<std::uint32_t> nearestReceiver(const SparseBake& bake, const SparseBake& other,
                                             std::uint32_t receiver) {
    const Receivers &mine = bake.receivers, &theirs = other.receivers;
    std::optional<std::uint32_t> nearest;
    float minDistance = std::numeric_limits<float>::max();
    for (std::uint32_t r = 0; r < mine.size(); ++r) {
        if (mine.instance[r] != theirs.instance[receiver] || mine.back[r] != theirs.back[receiver])
            continue;
        // Any texel of another triangle is farther than all of the same one.
        const float way = mine.triangle[r] == theirs.triangle[receiver]
                              ? glm::distance(mine.barycentric[r], theirs.barycentric[receiver])
                              : 2;
        if (way < minDistance) {
            minDistance = way;
            nearest = r;
        }
    }
    return nearest;
}

} // namespace limn
