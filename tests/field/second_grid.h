// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/field/sample_field.h"
#include "engine/math/hemisphere_radiance.h"
#include "engine/math/sh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace limn {

/// A grid as a part of a field: the same light as that of the field's own grid, if it held it.
class SecondGrid : public FieldPart {
public:
    explicit SecondGrid(IndirectField grid) : m_grid(std::move(grid)) {}

    const char* name() const override { return "second grid"; }

    void irradianceTaps(const FieldPoint& point, FieldTaps& taps) const override {
        lobeTaps(point, point.normal, kIrradianceBands, irradianceFactors(), taps);
    }
    void radianceTaps(const FieldPoint& point, glm::vec3 direction,
                      FieldTaps& taps) const override {
        const int bands = std::min(int(m_grid.bands), kIrradianceBands);
        float weights[kIrradianceBands * kIrradianceBands];
        hemisphereRadianceWeights(bands, point.normal, direction, weights);
        addTaps(point, {weights, std::size_t(bands * bands)}, taps);
    }
    void lobeTaps(const FieldPoint& point, glm::vec3 direction, int bands,
                  const std::array<float, kMaxBands>& factors, FieldTaps& taps) const override {
        bands = std::min(bands, int(m_grid.bands));
        float weights[kMaxCoefficients];
        shBasis(bands, direction, weights);
        for (int l = 0, i = 0; l < bands; ++l)
            for (; i < (l + 1) * (l + 1); ++i)
                weights[i] *= factors[std::size_t(l)];
        addTaps(point, {weights, std::size_t(bands * bands)}, taps);
    }
    glm::vec3 sum(std::span<const FieldTap> taps) const override {
        glm::vec3 sum(0);
        for (const FieldTap& tap : taps)
            sum += tap.weight * glm::vec3(m_grid.grid[tap.index]);
        return sum;
    }
    bool equals(const FieldPart& other) const override {
        const auto* grid = dynamic_cast<const SecondGrid*>(&other);
        return grid && grid->m_grid == m_grid;
    }

private:
    /// `weights`: of the coefficients of each cell that is looked up.
    void addTaps(const FieldPoint& point, std::span<const float> weights, FieldTaps& taps) const {
        const FieldLookup lookup = gridLookup(m_grid, point.position, point.normal);
        for (std::size_t i = 0; i < weights.size(); ++i)
            for (std::size_t k = 0; k < lookup.count; ++k)
                taps.push_back({std::uint32_t(i * m_grid.cells() + lookup.index[k]),
                                weights[i] * lookup.weight[k]});
    }

    IndirectField m_grid;
};

} // namespace limn
