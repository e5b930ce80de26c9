// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/texel_points.h"
#include "engine/scene/mesh/bounds.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// An estimate of the irradiance by lamps.
struct LampIrradiance {
    double value = 0; ///< [m^-2], for lamps that each send a flux of 1 per side
    /// Share of the directions in which there is no surface within reach and no back of a one-sided
    /// surface at any distance.
    double open = 0;
};

/// Maximum number of rays of an estimate.
constexpr std::uint32_t raysOf(std::uint32_t samples) {
    return 3 * samples;
}

/// Points on lamps that an estimate looks at, twice as many as directions.
struct LampPoints {
    struct OnLamp {
        std::uint32_t emitter; ///< LampLight's own number
        WorldPoint point;
    };
    std::uint32_t samples; ///< number of directions
    std::vector<OnLamp> all;
};

/// Light that arrives directly from static emissive surfaces, where every instance that emits sends
/// the same flux, whatever its area and emission: how much a material emits must not change what is
/// precomputed.
///
/// A third of the samples are cosine-weighted directions, the others points on lamps; both are
/// weighted by the balance heuristic (Veach, Guibas. Optimally Combining Sampling Techniques for
/// Monte Carlo Rendering. 1995, equation 9), so that light within millimetres of a lamp and from a
/// small lamp far off are found with equal certainty. A triangle of a lamp gets points in
/// proportion to the root of its area: the rim of a flat lamp, which lights what is beside it, gets
/// a tenth of them instead of a hundredth.
class LampLight {
public:
    /// Keeps a reference to `trace`.
    explicit LampLight(const TraceScene& trace);

    /// Whether nothing emits.
    bool none() const { return m_triangles.empty(); }

    /// Points on lamps, which `seed` chooses, for estimates with `samples` directions.
    LampPoints pointsOnLamps(std::uint32_t samples, std::uint32_t seed) const;

    /// Irradiance of the side that the point's normal shows, from directions, which `turn` rotates,
    /// and from points on lamps. Traces up to raysOf(lamps.samples) rays. Thread-safe.
    LampIrradiance at(const WorldPoint& point, float reach, std::uint32_t turn,
                      const LampPoints& lamps) const;

    /// Whether the bounding box of some triangle of a lamp other than `instance` is within `reach`
    /// [m] of a point. Traces no ray. Lamps of more than 256 triangles, and all where there are
    /// more than 1000 lamps, do not count: the samples of at() find what is fine or many.
    bool isNear(glm::vec3 point, float reach, std::uint32_t instance) const;

private:
    struct Emitter {
        std::uint32_t instance, triangle;
        double below;   ///< share of all samples that fall on triangles up to this one
        double perArea; ///< samples per area, of one sample in all [m^-2]
    };

    struct Lamp {
        std::uint32_t instance;
        std::size_t begin, end; ///< of its triangles
        Bounds bounds;
    };

    double fromLamps(const WorldPoint& point, const LampPoints& lamps) const;
    double weighted(const Emitter& emitter, glm::vec3 normal, glm::vec3 direction, float t,
                    double cosine, std::uint32_t samples) const;

    const TraceScene& m_trace;
    std::vector<Emitter> m_triangles;
    std::vector<std::uint32_t> m_first; ///< per instance: its first triangle; ~0: it emits nothing
    std::vector<double> m_radiance;     ///< per instance [m^-2 sr^-1]
    std::vector<Lamp> m_lamps;
    std::vector<Bounds> m_bounds; ///< per triangle
};

} // namespace limn
