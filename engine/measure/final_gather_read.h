// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/final_gather.h"

#include <optional>

namespace limn {

/// Where a ray meets a surface at fewer texels' widths than these, the field is not read there but
/// the ray goes on, because light that comes from so near varies too much for texels.
inline constexpr float kFewestTexels = 4;

/// A ray that meets near surfaces only, as in a gap, ends after as many.
inline constexpr std::uint32_t kMostGatherBounces = 16;

template <class Reader>
void FinalGather::readBounced(StraightSample met, const Sampler& own, glm::vec3 weight,
                              Reader& reader) const {
    const std::uint32_t via = met.hit.instance;
    for (std::uint32_t bounce = 1; met.point && reader.reflects(met.hit.instance); ++bounce) {
        weight *= met.point->albedo / glm::pi<float>();
        reader.directLight(met, {mixBits(own.seed, kOnLightDimension + bounce), own.index}, weight,
                           bounce, via);
        if (bounce == kMostGatherBounces ||
            !(met.hit.t < kFewestTexels * m_widths[met.hit.instance])) {
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
    Weights weights;
    for (std::uint32_t part = 0; part < kGatherParts; ++part)
        weights[part] = float(shares[part]) * weightOf(*p);
    const FieldPoint at = pointOf(m_field, hit, *p), straightAt = pointOf(straight(), hit, *p);
    reader.fieldIrradiance(at, weights[Shown], Shown);
    reader.fieldIrradiance(straightAt, -weights[Straight], Straight);
    reader.fieldIrradiance(straightAt, weights[Bounced], Bounced);
    reader.fieldIrradiance(at, -weights[Bounced], Bounced);
    const std::uint32_t rays = m_options.gatherRays;
    for (std::uint32_t k = 0; k < rays; ++k) {
        const Sampler own{pixel.gather.seed, s * rays + k};
        const StraightSample found = sampleStraightLight(m_trace, m_sources, *p, own, guide);
        for (const FoundLight& f : found.found)
            if (f.irradiance != glm::vec3(0))
                reader.arrives(f, weights[Straight] / float(rays) * f.irradiance, Straight,
                               f.instance);
        if (found.weight > 0 && found.hit)
            readBounced(found, own, found.weight / float(rays) * weights[Bounced], reader);
    }
}

template <class Reader>
void FinalGather::read(std::uint32_t x, std::uint32_t y, Reader& reader) const {
    const GatherTile tile = tileOf(x / kGatherTile * kGatherTile, y / kGatherTile * kGatherTile);
    const std::uint32_t pixel = (y - tile.y) * kGatherTile + x - tile.x,
                        first = tile.first[pixel].count, more = tile.more[pixel].count;
    // Of one of the first samples, or of a further one.
    const auto shares = [&](bool further) {
        std::array<double, kGatherParts> each;
        for (std::uint32_t part = 0; part < kGatherParts; ++part) {
            const double w = tile.shareOfMore[part][pixel];
            each[part] = tile.kept[part][pixel] * (further ? w / more : (1 - w) / first);
        }
        return each;
    };
    for (std::uint32_t s = 0; s < first; ++s)
        sample(x, y, s, nullptr, shares(false), reader);
    for (std::uint32_t s = 0; s < more; ++s)
        sample(x, y, first + s, &tile.guide, shares(true), reader);
}

} // namespace limn
