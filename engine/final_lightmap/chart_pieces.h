// SPDX-License-Identifier: MIT
#pragma once

#include "engine/final_lightmap/cut_mesh.h"

#include <functional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// What a trial lightmap leaves at a point of a chart.
struct ResidualSample {
    glm::vec2 uv;    ///< in the chart's plane [object units]
    float width = 0; ///< of its texel [object units]
    float area = 0;  ///< that it stands for, relative
    float light = 0; ///< grey
    /// Grey squared error times the squared factor of its texels' density: what is left with a
    /// factor of 1, where squared errors fall in proportion to the number of texels.
    float squared = 0;
    float floor = 0; ///< the same for a relative error below which none counts
};

/// Sums over samples.
struct ResidualSums {
    double area = 0, light = 0, squared = 0, floor = 0;
    double rectangle = 0; ///< area of the rectangle around them, in the unit of `area`
    /// Number of the part of the chart that crossings enclose. Light differs between parts.
    std::uint32_t part = 0;

    /// Mean squared error with a factor of 1, relative to the light of the samples, or to `dim`
    /// where that is more.
    double relative(double dim) const;
    /// The same as a mean over the whole rectangle, whose empty part has no error.
    double relativeInRectangle(double dim) const;
};

ResidualSums sumOf(std::span<const ResidualSample> samples);

/// The density of texels in a chart.
struct PieceDensity {
    double perUnit = 1;                   ///< with a factor of 1 [texels / object unit]
    std::function<double(double)> factor; ///< of a piece, by its relativeInRectangle()
};

/// Cuts a chart where its parts need different densities. To have the least squared error with a
/// number of texels, a piece with an area A, a rectangle of area R and a squared error e per texel
/// gets texels in proportion to sqrt(A R e), as if it cost that much. Halves cost less where they
/// differ, or where less of their rectangles is empty, but for the texels that both have along the
/// cut. The pieces are those of least cost among all that halving a chart again and again makes.
/// Before, a chart is cut along the lines in which other surfaces cross it, on which `crossings`
/// lie [object units]: light differs on both sides, however many texels there are. Reorders
/// `samples`. Returns what each piece sums up to, by its number.
std::vector<ResidualSums> cutIntoPieces(std::vector<ResidualSample>& samples,
                                        const std::vector<glm::vec2>& crossings, double dim,
                                        const PieceDensity& density, ChartCuts& cuts);

} // namespace limn
