// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/lightmap/mesh_density.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A chart whose parts need very different densities.
struct VariedChart {
    std::uint32_t instance, chart;
    /// Points where rays from nearby hit it; they find parts too small to be sampled otherwise.
    std::vector<MeshPoint> points;
    std::vector<std::uint32_t> back; ///< per point, 1: on the back
    /// Per point: the exponent of 4 by which its texels per metre should be multiplied.
    std::vector<std::int32_t> fours;
};

/// Densities of texels and surfels over a scene.
struct BakeDensity {
    /// Multiplies the texels per metre, per instance and chart: powers of four. Empty, as a whole
    /// or for an instance, means 1.
    std::vector<std::vector<float>> texels;
    std::vector<MeshDensity> surfels; ///< per mesh; empty: uniform
    /// Charts that are given the density that most of their area needs; findFineLookups() adds
    /// texels to the parts that need more.
    std::vector<VariedChart> varied;
    double baseShare = 1;   ///< share of all texels that remains after those parts get theirs
    double centre = 1;      ///< centre of densityClass(), for detailOf()
    double size = 1;        ///< length that distances are relative to [m]
    float nearest = 0;      ///< smaller distances are clamped to this [m]
    std::uint64_t rays = 0; ///< number of rays traced to compute the densities
};

/// Relative number of texels per area that a place needs, where R is size / nearness.
double detailOf(double nearness);

/// Its inverse.
double nearnessOf(double detail);

/// Computes densities by tracing rays from points all over the static surfaces.
///
/// Irradiance varies over distances like R, the harmonic mean of the distances to what is seen
/// (Ward, Heckbert. Irradiance Gradients. 1992; the sky is infinitely far), so linear interpolation
/// between n texels per area has an error of about E / (R^2 n). The sum of the squared errors over
/// all surfaces is smallest where each chart has n in proportion to the cubic root of its mean 1 /
/// R^4. A ground that reaches to the horizon thus leaves its texels to the house on it.
///
/// Surfels are distributed by the hits of rays from the texels: each surfel represents the same
/// share of all incoming light, so surfaces that no cache sees, or that lie far away, get few.
///
/// Both densities are powers of sixteen relative to what most texels or hits have, so a room whose
/// walls are all near each other has a uniform density, and small moves of objects rarely change
/// it. A chart is varied if some of its parts need 256 times the texels that most of its area does,
/// and either these parts need a hundredth of all texels or a single density would waste a tenth of
/// them; it is given the density of most of its area. Surfels are distributed as if no chart were
/// varied. `texels` is the expected number of texels. The result must not be used when cancelled.
BakeDensity findDensity(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                        std::uint32_t texels, const Progress& progress = {});

} // namespace limn
