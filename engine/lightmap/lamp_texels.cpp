// SPDX-License-Identifier: MIT
#include "engine/lightmap/lamp_texels.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/lamp_light.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

namespace limn {

namespace {

constexpr std::uint32_t kRoughSamples = 4; ///< LampLight's, at each point of a texel
constexpr std::uint32_t kFewSamples = 2, kManySamples = 8; ///< at each point of a block

/// What the open points of a texel see.
struct TexelLight {
    double minimum = HUGE_VAL;  ///< irradiance [m^-2]
    double maximum = -HUGE_VAL; ///< less than `minimum` where no point is open
    bool nearLamp = false;      ///< a lamp lies within a texel's width of one of them

    void add(const TexelLight& o) {
        minimum = std::min(minimum, o.minimum);
        maximum = std::max(maximum, o.maximum);
        nearLamp = nearLamp || o.nearLamp;
    }
};

/// Mean over points, weighted by how open they are.
struct OpenMean {
    double sum = 0, weight = 0;

    void add(const LampIrradiance& e) {
        sum += e.open * e.value;
        weight += e.open;
    }
};

/// Estimate of a mean square.
struct SquareEstimate {
    double sum = 0, squares = 0, count = 0;

    void add(double product) {
        sum += product;
        squares += product * product;
        ++count;
    }
    double mean() const { return count > 0 ? sum / count : 0; }
    double deviation() const { ///< of the mean
        return count > 1 ? std::sqrt(std::max(squares - sum * mean(), 0.) / (count * (count - 1)))
                         : HUGE_VAL;
    }
};

double areaOf(const AtlasTexel& texel) {
    return double(texel.width) * double(texel.width);
}

/// Estimates how much light varies between texels.
class LampTexels {
public:
    LampTexels(const TraceScene& trace, std::uint32_t wanted)
        : m_trace(trace), m_light(trace), m_wanted(wanted) {}

    bool none() const { return m_light.none(); }
    std::uint64_t rays() const { return m_rays; }

    void look(const Atlas& atlas, std::size_t from, const Progress& progress);
    bool isNearLamp(std::uint32_t place, std::uint32_t width) const {
        return cornersAt(place, width).nearLamp;
    }
    bool mayVary(std::uint32_t place, std::uint32_t width, const AtlasTexel& owner) const;
    double promise(const AtlasTexel& owner, const std::vector<LocalTexel>& texels);
    double gain(const AtlasTexel& owner, const std::vector<LocalTexel>& texels, bool nearLamp);

    /// Squared error [m^-4], times the area, that a block must remove to be worth its texels.
    double minGain() const {
        return kBlockTexels * kLampError * kLampError * m_mean * m_mean * m_area / m_wanted;
    }

private:
    TexelLight cornersAt(std::uint32_t place, std::uint32_t width) const;
    LampIrradiance lightAt(const AtlasTexel& owner, const MeshPoint& point, std::uint32_t estimate,
                           const LampPoints& lamps) const;
    SquareEstimate error(const AtlasTexel& owner, const std::vector<LocalTexel>& texels,
                         std::uint32_t samples, std::uint32_t points);

    const TraceScene& m_trace;
    LampLight m_light;
    std::uint32_t m_wanted;
    std::vector<TexelLight> m_lightAt; ///< per place of the atlas
    double m_area = 0, m_mean = 0;     ///< of the texels, and the irradiance over it
    std::atomic<std::uint64_t> m_rays = 0;
};

/// Estimates the light of the atlas' texels from number `from` on.
void LampTexels::look(const Atlas& atlas, std::size_t from, const Progress& progress) {
    m_lightAt.resize(std::size_t(atlas.layout.width) * atlas.layout.height);
    // The same places of lamps for all texels, since differences matter.
    const LampPoints lamps = m_light.pointsOnLamps(kRoughSamples, 0);
    std::vector<double> mean(atlas.texels.size() - from);
    parallelRanges(mean.size(), 64, progress, "charts", [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const AtlasTexel& t = atlas.texels[from + i];
            TexelLight& light = m_lightAt[t.texel];
            for (std::uint32_t k = 0; k < t.count; ++k) {
                const WorldPoint p = texelPoint(m_trace.scene(), t, k);
                const LampIrradiance e =
                    m_light.at(p, t.width, seedOf(m_trace.scene(), t) + k, lamps);
                mean[i] += e.value / t.count;
                if (e.open > 0)
                    light.add({e.value, e.value, m_light.isNear(p.position, t.width, t.instance)});
            }
            m_rays += t.count * raysOf(kRoughSamples);
        }
    });
    if (from > 0)
        return;
    double flux = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        m_area += areaOf(atlas.texels[i]);
        flux += areaOf(atlas.texels[i]) * mean[i];
    }
    m_mean = m_area > 0 ? flux / m_area : 0;
}

TexelLight LampTexels::cornersAt(std::uint32_t place, std::uint32_t width) const {
    TexelLight all;
    for (const std::uint32_t corner : {place, place + 1, place + width, place + width + 1})
        all.add(m_lightAt[corner]);
    return all;
}

/// Whether the four texels of a place differ enough, or a lamp is near enough, to look closer.
bool LampTexels::mayVary(std::uint32_t place, std::uint32_t width, const AtlasTexel& owner) const {
    const TexelLight all = cornersAt(place, width);
    const double range = all.maximum - all.minimum;
    return range >= 0 && (all.nearLamp || 4 * range * range * areaOf(owner) > minGain());
}

/// An estimate of the light at a point of a block.
LampIrradiance LampTexels::lightAt(const AtlasTexel& owner, const MeshPoint& point,
                                   std::uint32_t estimate, const LampPoints& lamps) const {
    AtlasTexel one = owner;
    one.points[0] = point;
    const Scene& scene = m_trace.scene();
    return m_light.at(texelPoint(scene, one, 0), owner.width / float(kFineCells),
                      seedOf(scene, one) + estimate, lamps);
}

/// Estimates the squared difference [m^-4] between the light at points of a block and that between
/// its four corners. The product of the differences of two independent estimates has no bias by
/// their noise.
SquareEstimate LampTexels::error(const AtlasTexel& owner, const std::vector<LocalTexel>& texels,
                                 std::uint32_t samples, std::uint32_t points) {
    using Pair = std::array<double, 2>;
    // All points of a block see the same places of lamps, so that only what differs between them
    // appears as a difference.
    const std::uint32_t seed = seedOf(m_trace.scene(), owner);
    const std::array<LampPoints, 2> lamps = {m_light.pointsOnLamps(samples, seed),
                                             m_light.pointsOnLamps(samples, seed + 3)};
    std::array<std::array<OpenMean, 4>, 2> corner{};
    std::uint64_t looks = 0;
    for (const LocalTexel& t : texels)
        if (t.position.x % kFineCells == 0 && t.position.y % kFineCells == 0)
            for (std::uint32_t i = 0; i < t.count; ++i)
                for (std::uint32_t k = 0; k < 2; ++k, ++looks)
                    corner[k][t.position.x / kFineCells + 2 * (t.position.y / kFineCells)].add(
                        lightAt(owner, t.points[i], k, lamps[k]));
    SquareEstimate result;
    for (const LocalTexel& t : texels) {
        const glm::dvec2 f = glm::dvec2(t.position) / double(kFineCells);
        const std::array<double, 4> weight = {(1 - f.x) * (1 - f.y), f.x * (1 - f.y),
                                              (1 - f.x) * f.y, f.x * f.y};
        Pair read{}, weights{};
        for (std::size_t k = 0; k < 2; ++k)
            for (std::size_t c = 0; c < 4; ++c)
                if (corner[k][c].weight > 0) {
                    read[k] += weight[c] * corner[k][c].sum / corner[k][c].weight;
                    weights[k] += weight[c];
                }
        if (!(weights[0] > 0 && weights[1] > 0))
            continue;
        for (std::uint32_t i = 0; i < std::min(points, t.count); ++i, looks += 2) {
            const MeshPoint& point = t.points[i * (t.count - 1)];
            const LampIrradiance a = lightAt(owner, point, 0, lamps[0]),
                                 b = lightAt(owner, point, 1, lamps[1]);
            if (a.open > 0 && b.open > 0)
                result.add((a.value - read[0] / weights[0]) * (b.value - read[1] / weights[1]));
        }
    }
    m_rays += looks * raysOf(samples);
    return result;
}

/// Squared error, times its area [m^-2], that a block may remove by what few samples tell.
double LampTexels::promise(const AtlasTexel& owner, const std::vector<LocalTexel>& texels) {
    constexpr double kSure = 3; // standard deviations
    const SquareEstimate few = error(owner, texels, kFewSamples, 1);
    return (few.mean() + kSure * few.deviation()) * areaOf(owner);
}

/// Squared error that a block removes, times its area [m^-2].
double LampTexels::gain(const AtlasTexel& owner, const std::vector<LocalTexel>& texels,
                        bool nearLamp) {
    const std::uint32_t samples = (nearLamp ? 2 : 1) * kManySamples;
    return error(owner, texels, samples, 2).mean() * areaOf(owner);
}

/// A place where a block may be added, with the triangles in it.
struct Candidate {
    std::uint32_t place;
    std::span<const BlockTriangle> parts;
    bool nearLamp;
    double worth = 0; ///< squared error that a block may remove or removes, times its area [m^-2]
};

/// Keeps up to `maxCount` candidates worth more than `minWorth`, the best first.
void keepBest(std::vector<Candidate>& all, double minWorth, std::size_t maxCount) {
    std::erase_if(all, [&](const Candidate& c) { return !(c.worth > minWorth); });
    std::ranges::stable_sort(all, std::greater<>(), &Candidate::worth);
    all.resize(std::min(all.size(), maxCount));
}

/// The triangles in lookups that may need a block.
std::vector<BlockTriangle> varyingParts(const LampTexels& lamps, const TexelGrid& grid,
                                        const LightmapLayout& layout,
                                        const std::vector<PlacedTriangle>& triangles) {
    const auto isFine = [&](std::uint32_t place) {
        return !layout.snaps.empty() && (layout.snaps[place] & kFineLookup) != 0;
    };
    std::vector<std::uint32_t> shared; // by charts: a block holds one chart only
    std::vector<BlockTriangle> parts =
        partTriangles(triangles, layout.width, [&](std::uint32_t place, const PlacedTriangle& t) {
            if (!grid.holdsAll(place, t)) {
                shared.push_back(place);
                return false;
            }
            return !isFine(place) && lamps.mayVary(place, layout.width, grid[place]);
        });
    std::ranges::sort(shared);
    std::erase_if(parts, [&](const BlockTriangle& part) {
        return std::ranges::binary_search(shared, part.place);
    });
    return parts;
}

/// Reduces the candidates to the `maxBlocks` blocks that remove most. Candidates that can hardly be
/// among them are judged by few samples, which may see nothing of the rim of a lamp nearby.
void chooseBlocks(LampTexels& lamps, const TexelGrid& grid, std::size_t maxBlocks,
                  const Progress& progress, std::vector<Candidate>& all) {
    constexpr std::size_t kJudged = 4; // times as many as are chosen
    const auto judge = [&](const auto& worthOf) {
        parallelRanges(all.size(), 16, progress, "charts", [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                all[i].worth = worthOf(all[i], grid[all[i].place]);
        });
    };
    judge([&](const Candidate& c, const AtlasTexel& owner) {
        return c.nearLamp ? HUGE_VAL : lamps.promise(owner, coverBlock(c.parts));
    });
    keepBest(all, lamps.minGain(), kJudged * maxBlocks);
    judge([&](const Candidate& c, const AtlasTexel& owner) {
        return lamps.gain(owner, coverBlock(c.parts), c.nearLamp);
    });
    keepBest(all, lamps.minGain(), maxBlocks);
}

} // namespace

FineLookups findLampLookups(const TraceScene& trace, const Atlas& atlas,
                            std::vector<PlacedTriangle> triangles, std::uint32_t wanted,
                            std::uint32_t maxTexels, int levels, const Progress& progress) {
    FineLookups result;
    LampTexels lamps(trace, wanted);
    if (lamps.none())
        return result;
    Atlas grown = atlas;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    std::size_t looked = 0;
    for (int level = 0; level < levels && maxTexels >= kBlockTexels && !triangles.empty();
         ++level) {
        lamps.look(grown, looked, quiet);
        looked = grown.texels.size();
        const TexelGrid grid(trace.scene(), grown);
        const std::vector<BlockTriangle> parts = varyingParts(lamps, grid, grown.layout, triangles);
        std::vector<Candidate> chosen;
        forPlaces(parts, [&](std::uint32_t place, std::span<const BlockTriangle> placeParts) {
            chosen.push_back({place, placeParts, lamps.isNearLamp(place, grown.layout.width)});
        });
        const std::uint32_t share = level + 1 < levels ? maxTexels / 2 : maxTexels;
        chooseBlocks(lamps, grid, share / kBlockTexels, quiet, chosen);
        if (progress.cancelled())
            return {};
        maxTexels -= std::uint32_t(chosen.size()) * kBlockTexels;
        std::vector<std::uint32_t> places;
        for (const Candidate& c : chosen)
            places.push_back(c.place);
        triangles = addChosenLevel(trace.scene(), triangles, std::move(places), grown, result);
    }
    result.rays = lamps.rays();
    return result;
}

} // namespace limn
