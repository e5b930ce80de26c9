// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/lightmap_layout.h"
#include "engine/lightmap/mesh_density.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A chart whose parts deserve densities far apart.
struct VariedChart {
    std::uint32_t instance, chart;
    /// Where rays from near by met it: parts that may be too small to be found otherwise.
    std::vector<MeshPoint> at;
    std::vector<std::uint32_t> back; ///< of each: 1: on the back
    /// Of each: texels per metre are to be multiplied by 4 to this, as those of charts are.
    std::vector<std::int32_t> fours;
};

/// Where a scene deserves texels and surfels.
struct BakeDensity {
    /// Times the texels per metre, per instance and chart: a power of four. Empty, also for an
    /// instance: 1.
    std::vector<std::vector<float>> texels;
    std::vector<MeshDensity> surfels; ///< per mesh; empty: one density
    /// Charts that have the density which most of their area deserves: findFineLookups() adds
    /// texels where a part deserves more.
    std::vector<VariedChart> varied;
    double baseShare = 1;   ///< of all texels, that are left if those parts have theirs
    double centre = 1;      ///< of densityClass(), for detailOf()
    double size = 1;        ///< [m] that nearness is relative to
    float nearest = 0;      ///< no distance counts as less [m]
    std::uint64_t rays = 0; ///< traced to find it
};

/// Texels per area, relative, that a place deserves where R is size / nearness.
double detailOf(double nearness);

/// Looks round from points all over the static surfaces.
///
/// Irradiance varies over distances like R, the harmonic mean of those to what is seen (Ward,
/// Heckbert. Irradiance Gradients. 1992; the sky is infinitely far), and so is off by about
/// E / (R^2 n) where it is interpolated linearly between n texels per area. Summed over all
/// surfaces, the squares of that are least where each chart has n in proportion to the cubic root
/// of its mean 1 / R^4. So a ground that reaches to the horizon leaves its texels to the house on
/// it.
///
/// Surfels follow what rays from the texels meet: each stands for the same share of all that light
/// comes from, so surfaces that no cache sees, or that lie far off, get few.
///
/// Both densities come in powers of sixteen about what most texels or hits have, so in a room whose
/// walls are all near each other there is one density, and small moves of objects rarely change
/// any. A chart some of whose parts deserve 256 times the texels that most of its area does varies,
/// where these parts need a hundredth of all texels or one density for all of it would waste a
/// tenth: it has that of most of its area. Surfels are as if none varied. `texels`: how many there
/// will be. Of no use when cancelled.
BakeDensity findDensity(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                        std::uint32_t texels, const Progress& progress = {});

} // namespace limn
