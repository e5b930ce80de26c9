// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/light_skin/view_samples.h"
#include "engine/techniques/light_skin/virtual_lights.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// Importance of each virtual light, >= 0: the mean over view samples of
/// Phi (n . d)+ (-n_v . d)+ / max(nearest^2, |l|^2), where Phi is the luminance of its flux, d the
/// unit direction to the sample and l the way. 0 without samples. `nearest` > 0 bounds the weight
/// of what lies beside a sample [m]. Bischoff, Schwandt, Broll. 2017, equations 10 and 11.
std::vector<float> importances(const VirtualLights& lights, const ViewSamples& samples,
                               float nearest);

/// Luminance of the flux of each light.
std::vector<float> fluxLuminances(const VirtualLights& lights);

/// Running sums of a value over the raster of virtual lights: down the columns, then along the
/// columns' sums.
class RasterSums {
public:
    RasterSums(const VirtualLights& lights, std::span<const float> values);

    double total() const { return m_columns.empty() ? 0 : m_columns.back(); }
    /// Sum over all columns up to and including `column`.
    double upToColumn(std::uint32_t column) const { return m_columns[column]; }
    /// Number of the light that a point of the unit square falls on, where each light has a part
    /// of the square in proportion to its value. Precondition: total() > 0.
    std::uint32_t find(glm::dvec2 u) const;
    std::uint64_t bytes() const;

private:
    std::vector<double> m_columns;              ///< sums over the columns before and at each
    std::vector<std::uint32_t> m_firstOfColumn; ///< number of the first light, one past the last
    std::vector<double> m_within; ///< of each light, with those above it in the column
};

/// Lights that were chosen to stand for all.
struct ChosenLights {
    std::vector<std::uint32_t> light; ///< numbers, ascending
    /// 1 / (N P), summed over the times that the light was drawn. The sum of weight times a value
    /// is, on average, the sum of the value over all lights.
    std::vector<float> weight;
};

struct ChoiceOptions {
    std::uint32_t count = 1; ///< N
    /// Share of the draws that is by flux alone and, as many, by area alone, [0, 1]. Without the
    /// former, light that no view sample faces never arrives. Without the latter, places of
    /// proxies, which are means over the lights' areas, are those of a few faint ones.
    float defence = 0.1f;
    glm::dvec2 shift{0}; ///< of the points, modulo 1
};

/// Cells of the raster that draws chose, by number of the draw. They stand for the lights that are
/// in them, whichever these are.
struct LightDraws {
    std::vector<std::uint32_t> cell;
    std::vector<double> weight; ///< 1 / (N P); 0: there was nothing to draw
};

/// Number `block` of `blocks` parts of the draws, which differ by one draw of each kind at most.
/// Each has consecutive points of the sequences, which spread evenly.
struct DrawBlock {
    std::uint32_t block = 0, blocks = 1;
};

/// Makes a part of the draws of chooseLights() again; the others stay as they are. Precondition:
/// there are options.count draws, or the part is all of them.
void drawLights(const VirtualLights& lights, std::span<const float> importance,
                const ChoiceOptions& options, DrawBlock part, LightDraws& draws);

/// The lights in the cells that were drawn.
ChosenLights drawnLights(const VirtualLights& lights, const LightDraws& draws);

/// Draws N lights, by importance, by flux and by area, each by points of the Halton sequence in
/// bases 2 and 3. All of them, with weight 1, where there are no more than N. Where nothing is
/// important all are drawn by flux and area; none where `defence` is 0.
ChosenLights chooseLights(const VirtualLights& lights, std::span<const float> importance,
                          const ChoiceOptions& options);

/// All lights with weight 1.
ChosenLights allLights(const VirtualLights& lights);

} // namespace limn
