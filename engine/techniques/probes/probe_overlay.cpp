// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_overlay.h"

#include "engine/math/luminance.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/scene/origin.h"
#include "engine/techniques/probes/probe_surface_overlay.h"
#include "engine/techniques/probes/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using Style = OverlayLine::Style;

constexpr float kBallScale = 0.12f;         // a ball's radius over the distance of probes
constexpr std::uint32_t kMaxDots = 200000;  // of all balls
constexpr std::uint32_t kDrawnRays = 48;    // of a probe's rays, beside what they meet
constexpr std::uint32_t kDotsAlongRay = 32; // of those drawn

const glm::vec3 kInSolidColor(1, 0, 1), kStaleColor(0.9f, 0.45f, 0), kRayColor(0.5f, 0.5f, 0.55f),
    kSkyColor(0.35f, 0.7f, 0.9f);

float ballRadius(const ProbeGrid& grid) {
    const glm::vec3 step = grid.step();
    return kBallScale * std::min({step.x, step.y, step.z});
}

OverlayMark square(glm::vec3 position, float radius, glm::vec3 color) {
    return {.position = position,
            .radius = radius,
            .color = packColor(color),
            .shape = MarkShape::Square};
}

/// Marks a probe in a solid where it stands, and on the surfaces around, which hide it.
void addInSolid(const ProbeMaps& maps, std::uint32_t probe, float radius,
                std::vector<OverlayMark>& marks) {
    const glm::vec3 position = maps.grid.position(probe);
    marks.push_back(square(position, radius, kInSolidColor));
    for (int axis = 0; axis < 3; ++axis)
        for (const float way : {1.f, -1.f}) {
            glm::vec3 d(0);
            d[axis] = way;
            const std::uint32_t texel = maps.map.texelAt(d);
            const ProbeHit& hit = maps.hits[std::size_t(probe) * maps.map.texels() + texel];
            if (hit.instance == ~0U || hit.side != kInSolid)
                continue;
            OverlayMark mark =
                square(position + maps.map.direction(texel) * (hit.distance + 0.1f * radius),
                       radius, kInSolidColor);
            mark.normal = d;
            marks.push_back(mark);
        }
}

glm::vec3 radianceAt(const ProbeHarmonics& light, glm::vec3 direction) {
    float y[kIrradianceBands * kIrradianceBands];
    shBasis(kIrradianceBands, direction, y);
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < light.size(); ++i)
        sum += light[i] * y[i];
    return sum;
}

/// Mean radiance over all directions.
glm::vec3 meanRadiance(const ProbeHarmonics& light) {
    return light[0] / (2 * std::sqrt(std::numbers::pi_v<float>));
}

/// Mean luminance of the probes whose light is used; 1 if they are dark.
float middleOf(const LitProbes& lit) {
    double sum = 0;
    std::uint32_t count = 0;
    for (std::size_t p = 0; p < lit.light.size(); ++p)
        if (!lit.maps.inSolid[p]) {
            sum += double(luminance(meanRadiance(lit.light[p])));
            ++count;
        }
    return sum > 0 ? float(sum / count) : 1;
}

OverlayData ballOverlay(const LitProbes& lit) {
    const ProbeGrid& grid = lit.maps.grid;
    const float middle = middleOf(lit), radius = ballRadius(grid);
    const DirectionSet directions(std::clamp(kMaxDots / std::max(grid.count(), 1U), 48U, 512U),
                                  true, 0);
    std::vector<glm::vec3> color(directions.count);
    OverlayData out;
    std::uint32_t solid = 0;
    for (std::uint32_t p = 0; p < grid.count(); ++p) {
        const glm::vec3 position = grid.position(p);
        if (lit.maps.inSolid[p]) {
            ++solid;
            addInSolid(lit.maps, p, radius, out.marks);
            continue;
        }
        for (std::uint32_t k = 0; k < directions.count; ++k) {
            const glm::vec3 radiance = radianceAt(lit.light[p], directions[k]);
            color[k] = luminance(radiance) < 0 ? kNegativeLight
                                               : lightColor(glm::max(radiance, 0.f), middle);
        }
        addBall(position, radius, directions, color, out.marks);
    }
    out.legend.title = "Probes and the light that reaches them";
    out.legend.entries = lightColorEntries(middle, "nits");
    out.legend.entries.push_back({packColor(kNegativeLight), "less than none: the harmonics ring"});
    out.legend.entries.push_back(
        {packColor(kInSolidColor), fmt::format("square: a probe in a solid, not used, {}", solid)});
    out.legend.notes = {
        fmt::format("{} x {} x {} probes; a ball's side shows the light that comes from there",
                    grid.size.x, grid.size.y, grid.size.z),
        "Probes in solids are marked on the surfaces around them, too"};
    return out;
}

/// What a probe's rays met.
struct Seen {
    std::uint32_t fronts = 0, backs = 0, solids = 0, skies = 0;
    float nearest = std::numeric_limits<float>::max(), farthest = 0; ///< of surfaces [m]
    double sum = 0;                                                  ///< of distances [m]

    std::uint32_t surfaces() const { return fronts + backs + solids; }
};

Seen seenBy(const ProbeMaps& maps, std::uint32_t probe) {
    Seen seen;
    for (std::uint32_t t = 0; t < maps.map.texels(); ++t) {
        const ProbeHit& hit = maps.hits[std::size_t(probe) * maps.map.texels() + t];
        if (hit.instance == ~0U) {
            ++seen.skies;
            continue;
        }
        ++(hit.side == kInSolid ? seen.solids : hit.side == 0 ? seen.fronts : seen.backs);
        seen.nearest = std::min(seen.nearest, hit.distance);
        seen.farthest = std::max(seen.farthest, hit.distance);
        seen.sum += double(hit.distance);
    }
    return seen;
}

OverlayData rayOverlay(const LitProbes& lit, std::uint32_t probe) {
    const ProbeMaps& maps = lit.maps;
    const float radius = ballRadius(maps.grid);
    const glm::vec3 from = maps.grid.position(probe);
    const Seen seen = seenBy(maps, probe);
    const float far = seen.surfaces() > 0 ? seen.farthest : 1;
    const std::uint32_t texels = maps.map.texels(), every = std::max(texels / kDrawnRays, 1U);
    OverlayData out;
    out.marks.push_back({.position = from,
                         .radius = 1.5f * radius,
                         .color = packColor(maps.inSolid[probe] ? kInSolidColor : glm::vec3(1)),
                         .shape = MarkShape::Ring});
    for (std::uint32_t t = 0; t < texels; ++t) {
        const ProbeHit& hit = maps.hits[std::size_t(probe) * texels + t];
        const glm::vec3 d = maps.map.direction(t);
        const bool sky = hit.instance == ~0U;
        const float length = sky ? 3 * radius : hit.distance;
        glm::vec3 color = sky ? kSkyColor : viridis(hit.distance / far);
        if (hit.side == kInSolid)
            color = kInSolidColor;
        // A mark covers a part of what its texel does, and stands off the surface.
        const float size = sky ? 0.2f * radius : 0.8f * hit.distance / float(maps.map.side);
        out.marks.push_back({.position = from + d * std::max(length - size, 0.f),
                             .radius = size,
                             .color = packColor(color)});
        for (std::uint32_t k = 1; t % every == every / 2 && !sky && k < kDotsAlongRay; ++k)
            out.marks.push_back({.position = from + d * (length * float(k) / kDotsAlongRay),
                                 .radius = 0.06f * radius,
                                 .color = packColor(kRayColor)});
    }
    out.legend.title = fmt::format("What probe {} sees", probe);
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back({packColor(viridis(float(k) / 4)),
                                      fmt::format("surface at {:.3g} m", far * float(k) / 4)});
    out.legend.entries.push_back(
        {packColor(kInSolidColor), fmt::format("back of a solid: {} rays", seen.solids)});
    out.legend.entries.push_back({packColor(kSkyColor), fmt::format("sky: {} rays", seen.skies)});
    out.legend.notes = {fmt::format("{} rays; one in {} is drawn", texels, every)};
    return out;
}

OverlayData ageOverlay(const LitProbes& lit) {
    const ProbeGrid& grid = lit.maps.grid;
    const float radius = 1.5f * ballRadius(grid);
    std::uint32_t oldest = 0, stale = 0, never = 0;
    for (const ProbeAge& age : lit.ages) {
        stale += age.stale ? 1 : 0;
        never += age.lit ? 0 : 1;
        if (age.lit)
            oldest = std::max(oldest, age.updates);
    }
    OverlayData out;
    const auto colorOf = [&](std::uint32_t updates) {
        return viridis(1 - float(updates) / float(std::max(oldest, 1U)));
    };
    for (std::uint32_t p = 0; p < grid.count(); ++p) {
        const ProbeAge& age = lit.ages[p];
        const glm::vec3 position = grid.position(p);
        if (age.stale)
            out.marks.push_back(square(position, radius, kStaleColor));
        else if (age.lit)
            out.marks.push_back(
                {.position = position, .radius = radius, .color = packColor(colorOf(age.updates))});
    }
    out.legend.title = "Age of probes";
    out.legend.entries = {{packColor(colorOf(0)), "disc: lit by the last update"}};
    if (oldest > 0)
        out.legend.entries.push_back(
            {packColor(colorOf(oldest)), fmt::format("disc: lit {} updates before", oldest)});
    out.legend.entries.push_back(
        {packColor(kStaleColor), fmt::format("square: stale, {} of {}", stale, grid.count())});
    out.legend.notes = {"A stale probe is lit as the scene was before it changed"};
    if (never > 0)
        out.legend.notes.push_back(fmt::format("{} have never been lit", never));
    return out;
}

OverlayLine rayLine(std::uint32_t rays, std::uint32_t all, const char* what) {
    return {Style::Plain, fmt::format("{:5.1f} %  {}", 100 * double(rays) / double(all), what)};
}

} // namespace

const Technique& ProbeSnapshot::technique() const {
    return kProbesTechnique;
}

OverlayData ProbeSnapshot::overlay(const OverlayRequest& request, const Scene& scene,
                                   const LightSnapshot* /*light*/) const {
    if (!request.kind)
        return {};
    if (request.kind->pick == OverlayPick::Required && request.pick >= pickCount())
        return {.legend = {request.kind->label, {}, {"Click a surface to pick a probe"}}};
    switch (request.kind - kProbeOverlays.data()) {
    case 0:
        return ballOverlay(m_lit);
    case 1:
        return rayOverlay(m_lit, request.pick);
    case 2:
        return ageOverlay(m_lit);
    case 3:
        return probeWeightOverlay(m_lit.maps, scene, request.pick);
    case 4:
        return probeVisibilityOverlay(m_lit.maps, scene, request.pick);
    case 5:
        return probeMarchOverlay(m_lit.maps, scene, request.pick);
    default:
        return {};
    }
}

std::optional<std::uint32_t> ProbeSnapshot::nearest(glm::vec3 place) const {
    const ProbeGrid& grid = m_lit.maps.grid;
    if (grid.count() == 0)
        return {};
    const glm::vec3 cell = glm::floor((place - grid.bounds.lower) / grid.step());
    const glm::uvec3 c(glm::clamp(cell, glm::vec3(0), glm::vec3(grid.size - 1U)));
    return (c.z * grid.size.y + c.y) * grid.size.x + c.x;
}

std::optional<std::uint32_t> ProbeSnapshot::pickAt(const Scene& /*scene*/, const Hit& hit) const {
    if (pickCount() == 0)
        return {};
    // The probe in front of the surface rather than the one in what it bounds.
    const glm::vec3 step = m_lit.maps.grid.step(),
                    n = hit.geometricNormal * (hit.frontFace ? 1.f : -1.f);
    return nearest(hit.position + n * (0.5f * std::min({step.x, step.y, step.z})));
}

std::optional<std::uint32_t> ProbeSnapshot::nearestPick(const OverlaySource& other,
                                                        std::uint32_t pick) const {
    return nearest(static_cast<const ProbeSnapshot&>(other).m_lit.maps.grid.position(pick));
}

std::vector<OverlayLine> ProbeSnapshot::describePick(const Scene& scene, std::uint32_t pick) const {
    const ProbeMaps& maps = m_lit.maps;
    const Seen seen = seenBy(maps, pick);
    const ProbeAge& age = m_lit.ages[pick];
    const glm::vec3 mean = meanRadiance(m_lit.light[pick]);
    const std::uint32_t all = maps.map.texels();
    std::vector<OverlayLine> lines = {
        {Style::Plain, fmt::format("Probe {}{}", pick, maps.inSolid[pick] ? ", in a solid" : ""),
         "More than a quarter of the rays of a probe in a solid meet backs; its light is not used"},
        {Style::Plain, placeText(scene.origin, maps.grid.position(pick))},
        {Style::Plain, fmt::format("Mean light {:.3g} {:.3g} {:.3g} nits", mean.x, mean.y, mean.z),
         "Red, green and blue radiance that reaches the probe, averaged over all directions"},
        {Style::Plain,
         age.stale          ? "Stale"
         : age.updates == 0 ? "Lit by the last update"
                            : fmt::format("Lit {} updates before the last", age.updates),
         "A stale probe is lit as the scene was before it changed"},
        {Style::Separator, ""},
        {Style::Heading, "What its rays meet"},
        rayLine(seen.fronts, all, "fronts"),
        rayLine(seen.backs, all, "backs of two-sided surfaces"),
        rayLine(seen.solids, all, "backs of solids"),
        rayLine(seen.skies, all, "the sky")};
    if (seen.surfaces() > 0)
        lines.push_back({Style::Plain,
                         fmt::format("{:.3g} to {:.3g} m away, {:.3g} m on average", seen.nearest,
                                     seen.farthest, seen.sum / seen.surfaces()),
                         "Distances of the surfaces"});
    return lines;
}

} // namespace limn
