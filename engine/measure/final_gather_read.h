// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/final_gather.h"

#include <optional>

namespace limn {

/// A ray that meets short ones only, as in a gap, ends after as many.
inline constexpr std::uint32_t kMostGatherBounces = 8;

template <class Reader>
void FinalGather::readNear(const StraightSample& found, const Hit& hit, const SurfacePoint& p,
                           const Weights& weights, Reader& reader) const {
    const FieldPoint all = pointOf(m_field, hit, p), straightAt = pointOf(straight(), hit, p);
    reader.fieldRadiance(straightAt, found.direction, weights[Straight], Straight);
    reader.fieldRadiance(straightAt, found.direction, -weights[Bounced], Bounced);
    reader.fieldRadiance(all, found.direction, weights[Bounced], Bounced);
}

template <class Reader>
void FinalGather::readBounced(StraightSample met, const Sampler& own, glm::vec3 weight,
                              Reader& reader) const {
    const std::uint32_t via = met.hit.instance;
    for (std::uint32_t bounce = 1; met.point && reader.reflects(met.hit.instance); ++bounce) {
        weight *= met.point->albedo / glm::pi<float>();
        reader.directLight(met, {mixBits(own.seed, kOnLightDimension + bounce), own.index}, weight,
                           bounce, via);
        const float texel = 2 * nearReach(m_near, met.hit);
        if (bounce == kMostGatherBounces || !(met.hit.t < texel)) {
            reader.fieldIrradiance(pointOf(m_field, met.hit, *met.point), weight, Bounced);
            return;
        }
        met = sampleStraightLight(m_trace, m_sources, *met.point,
                                  {mixBits(own.seed, bounce), own.index});
        for (const FoundLight& f : met.found)
            if (f.irradiance != glm::vec3(0))
                reader.arrives(f, weight * f.irradiance, Bounced, via);
        weight *= met.weight;
    }
}

template <class Reader>
void FinalGather::sample(std::uint32_t x, std::uint32_t y, std::uint32_t s, const LightGuide* guide,
                         std::array<double, kGatherParts> shares, Reader& reader) const {
    const PixelSample pixel(m_rays, m_options.seed, y * m_options.width + x, s);
    const Hit hit = m_trace.closestHit(pixel.ray);
    const std::optional<SurfacePoint> p = hit ? surfacePoint(m_trace, hit) : std::nullopt;
    if (!p || !reader.shows(hit.instance))
        return;
    Weights weights = {float(shares[Straight]) * weightOf(*p),
                       float(shares[Bounced]) * weightOf(*p)};
    const FieldPoint straightAt = pointOf(straight(), hit, *p);
    reader.fieldIrradiance(straightAt, -weights[Straight], Straight);
    reader.fieldIrradiance(straightAt, weights[Bounced], Bounced);
    reader.fieldIrradiance(pointOf(m_field, hit, *p), -weights[Bounced], Bounced);
    const std::uint32_t rays = m_options.gatherRays;
    for (glm::vec3& weight : weights)
        weight /= float(rays);
    const float reach = m_options.nearRays > 0 ? nearReach(m_near, hit) : 0;
    for (std::uint32_t k = 0; k < rays; ++k) {
        const Sampler own{pixel.gather.seed, s * rays + k};
        const StraightSample found = sampleStraightLight(m_trace, m_sources, *p, own, guide);
        for (const FoundLight& f : found.found)
            if (f.irradiance != glm::vec3(0))
                reader.arrives(f, weights[Straight] * f.irradiance, Straight, f.instance);
        if (!(found.weight > 0) || !found.hit)
            continue;
        // Near light has put the own light of what is near in the place of the field's already.
        const bool emits = found.point && found.point->emission != glm::vec3(0);
        const float near = nearWeight(m_near, reach, found.hit, emits);
        if (near > 0)
            readNear(
                found, hit, *p,
                {near * found.weight * weights[Straight], near * found.weight * weights[Bounced]},
                reader);
        if (near < 1)
            readBounced(found, own, (1 - near) * found.weight * weights[Bounced], reader);
    }
}

template <class Reader>
void FinalGather::read(std::uint32_t x, std::uint32_t y, Reader& reader) const {
    const GatherTile tile = tileOf(x / kGatherTile * kGatherTile, y / kGatherTile * kGatherTile);
    const std::uint32_t pixel = (y - tile.y) * kGatherTile + x - tile.x,
                        first = tile.first[pixel].count, more = tile.more[pixel].count;
    const auto shares = [&](double share) {
        return std::array{share * tile.kept[Straight][pixel], share * tile.kept[Bounced][pixel]};
    };
    const double w = tile.shareOfMore[pixel];
    for (std::uint32_t s = 0; s < first; ++s)
        sample(x, y, s, nullptr, shares((1 - w) / first), reader);
    for (std::uint32_t s = 0; s < more; ++s)
        sample(x, y, first + s, &tile.guide, shares(w / more), reader);
}

} // namespace limn
