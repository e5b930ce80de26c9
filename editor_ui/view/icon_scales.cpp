// SPDX-License-Identifier: MIT
#include "editor_ui/view/icon_scales.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

std::vector<float> iconScales(const std::vector<glm::vec2>& places, float size) {
    using Cell = std::pair<long, long>; // as wide as an icon: neighbours lie at most one further
    const auto cellOf = [&](glm::vec2 p) {
        return Cell(std::lround(p.x / size), std::lround(p.y / size));
    };
    std::map<Cell, std::vector<std::size_t>> cells;
    for (std::size_t i = 0; i < places.size(); ++i)
        cells[cellOf(places[i])].push_back(i);
    std::vector<float> scales;
    for (const glm::vec2 place : places) {
        float nearest = size;
        const Cell centre = cellOf(place);
        for (long dx = -1; dx <= 1; ++dx)
            for (long dy = -1; dy <= 1; ++dy) {
                const auto cell = cells.find({centre.first + dx, centre.second + dy});
                if (cell == cells.end())
                    continue;
                for (const std::size_t other : cell->second)
                    if (const float d = glm::length(places[other] - place); d > 0.5f)
                        nearest = std::min(nearest, d);
            }
        scales.push_back(std::max(nearest / size, kMinIconScale));
    }
    return scales;
}

} // namespace limn
