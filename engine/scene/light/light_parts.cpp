// SPDX-License-Identifier: MIT
#include "engine/scene/light/light_parts.h"

#include "engine/scene/light/light_cuts.h"
#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Coordinates along one axis at which the partition may change, including -1 and 1.
std::vector<float> linesOf(const std::vector<LightCut>& cuts, int axis) {
    constexpr std::size_t kMaxLines = 128;
    std::vector<float> all = {-1, 1};
    for (const LightCut& c : cuts) {
        all.push_back(c.a[axis]);
        all.push_back(c.b[axis]);
    }
    std::ranges::sort(all);
    constexpr float kSame = 1e-5f;
    const auto end = std::unique(all.begin(), all.end(),
                                 [](float a, float b) { return std::abs(a - b) < kSame; });
    all.erase(end, all.end());
    all.front() = -1, all.back() = 1;
    std::vector<float> lines;
    if (all.size() > kMaxLines) {
        for (std::size_t i = 0; i < kMaxLines; ++i)
            lines.push_back(all[i * (all.size() - 1) / (kMaxLines - 1)]);
        return lines;
    }
    // Extra lines for walls at an angle, in different numbers per axis so that such walls do not
    // pass through the centres of cells.
    const std::size_t steps = kMaxLines / all.size() + std::size_t(axis);
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
        for (std::size_t k = 0; k < steps; ++k)
            lines.push_back(all[i] + (all[i + 1] - all[i]) * float(k) / float(steps));
    lines.push_back(1);
    return lines;
}

std::vector<float> middlesOf(const std::vector<float>& lines) {
    std::vector<float> result;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i)
        result.push_back((lines[i] + lines[i + 1]) / 2);
    return result;
}

/// Grid of cells over the light. Cells are joined if their centres see each other along the plane.
class PartGrid {
public:
    explicit PartGrid(const std::vector<LightCut>& cuts)
        : m_lines{linesOf(cuts, 0), linesOf(cuts, 1)}, m_middles{middlesOf(m_lines[0]),
                                                                 middlesOf(m_lines[1])},
          m_parent(cells()), m_backs(cells(), true) {
        std::iota(m_parent.begin(), m_parent.end(), 0U);
        for (const int axis : {0, 1})
            m_blocked[std::size_t(axis)].assign(cells(), false);
        for (const LightCut& c : cuts)
            for (const int axis : {0, 1})
                block(c, axis);
        for (std::uint32_t y = 0; y < rows(); ++y)
            for (std::uint32_t x = 0; x < columns(); ++x) {
                if (x + 1 < columns() && !m_blocked[0][at(x, y)])
                    join(at(x, y), at(x + 1, y));
                if (y + 1 < rows() && !m_blocked[1][at(x, y)])
                    join(at(x, y), at(x, y + 1));
            }
    }

    /// A region that no wall divides.
    struct Part {
        glm::vec2 lower{2}, upper{-2};
        double area = 0;
        bool centre = false; ///< the light's own lies in it
        bool onlyBacks = true, atBorder = false;
    };
    /// Bounding rectangles of the enclosed parts; parts that reach the light's border are divided
    /// into rectangles beside these.
    std::vector<Part> rectangles();

private:
    std::uint32_t columns() const { return std::uint32_t(m_middles[0].size()); }
    std::uint32_t rows() const { return std::uint32_t(m_middles[1].size()); }
    std::uint32_t cells() const { return columns() * rows(); }
    std::uint32_t at(std::uint32_t x, std::uint32_t y) const { return y * columns() + x; }
    std::uint32_t root(std::uint32_t cell) {
        while (m_parent[cell] != cell)
            cell = m_parent[cell] = m_parent[m_parent[cell]];
        return cell;
    }
    std::vector<Part> findParts();
    std::vector<Part> runsOf(std::uint32_t part, const std::vector<Part>& enclosed) const;
    glm::vec2 lower(std::uint32_t x, std::uint32_t y) const {
        return {m_lines[0][x], m_lines[1][y]};
    }
    void join(std::uint32_t a, std::uint32_t b) { m_parent[root(b)] = root(a); }
    void block(const LightCut& cut, int axis);

    std::array<std::vector<float>, 2> m_lines, m_middles;
    std::vector<std::uint32_t> m_parent;
    std::array<std::vector<bool>, 2> m_blocked; ///< per cell, towards the next one along each axis
    std::vector<bool> m_backs;                  ///< per cell: it touches nothing but backs
    std::vector<std::uint32_t> m_partOf;        ///< per cell
};

/// Blocks the steps along `axis` that the cut crosses.
void PartGrid::block(const LightCut& cut, int axis) {
    const int across = 1 - axis;
    const std::vector<float>&steps = m_middles[std::size_t(axis)],
          &rows = m_middles[std::size_t(across)];
    const auto [low, high] = std::minmax(cut.a[across], cut.b[across]);
    const auto first = std::ranges::lower_bound(rows, low) - rows.begin();
    for (auto row = std::size_t(first); row < rows.size() && rows[row] < high; ++row) {
        const float share = (rows[row] - cut.a[across]) / (cut.b[across] - cut.a[across]);
        const float crossed = cut.a[axis] + share * (cut.b[axis] - cut.a[axis]);
        const auto next = std::size_t(std::ranges::lower_bound(steps, crossed) - steps.begin());
        const auto cellAt = [&](std::size_t step) {
            return axis == 0 ? at(std::uint32_t(step), std::uint32_t(row))
                             : at(std::uint32_t(row), std::uint32_t(step));
        };
        for (const std::size_t step : {next - 1, next}) // next - 1 wraps beyond the end
            if (step < steps.size()) {
                glm::vec2 middle;
                middle[axis] = steps[step];
                middle[across] = rows[row];
                if (cut.twoSided || glm::dot(cut.front, middle - cut.a) > 0)
                    m_backs[cellAt(step)] = false;
            }
        if (next > 0 && next < steps.size())
            m_blocked[std::size_t(axis)][cellAt(next - 1)] = true;
    }
}

void add(PartGrid::Part& part, glm::vec2 lower, glm::vec2 upper) {
    part.lower = glm::min(part.lower, lower);
    part.upper = glm::max(part.upper, upper);
    part.area += double(upper.x - lower.x) * double(upper.y - lower.y);
    part.centre = part.centre || (lower.x <= 0 && lower.y <= 0 && upper.x > 0 && upper.y > 0);
}

std::vector<PartGrid::Part> PartGrid::findParts() {
    std::vector<Part> result;
    std::vector<std::uint32_t> ofRoot(cells(), ~0U);
    m_partOf.resize(cells());
    for (std::uint32_t y = 0; y < rows(); ++y)
        for (std::uint32_t x = 0; x < columns(); ++x) {
            const std::uint32_t cell = at(x, y), r = root(cell);
            if (ofRoot[r] == ~0U) {
                ofRoot[r] = std::uint32_t(result.size());
                result.emplace_back();
            }
            m_partOf[cell] = ofRoot[r];
            Part& part = result[ofRoot[r]];
            add(part, lower(x, y), lower(x + 1, y + 1));
            part.onlyBacks = part.onlyBacks && m_backs[cell];
            part.atBorder =
                part.atBorder || x == 0 || y == 0 || x + 1 == columns() || y + 1 == rows();
        }
    return result;
}

/// Cells of a part outside the rectangles of `enclosed`, in runs along rows; equal runs of
/// consecutive rows are merged.
std::vector<PartGrid::Part> PartGrid::runsOf(std::uint32_t part,
                                             const std::vector<Part>& enclosed) const {
    const auto belongs = [&](std::uint32_t x, std::uint32_t y) {
        const glm::vec2 middle(m_middles[0][x], m_middles[1][y]);
        return m_partOf[at(x, y)] == part && std::ranges::none_of(enclosed, [&](const Part& e) {
                   return middle.x > e.lower.x && middle.y > e.lower.y && middle.x < e.upper.x &&
                          middle.y < e.upper.y;
               });
    };
    std::vector<Part> result;
    for (std::uint32_t y = 0; y < rows(); ++y)
        for (std::uint32_t x = 0, end = 0; x < columns(); x = end + 1) {
            for (end = x; end < columns() && belongs(end, y);)
                ++end;
            if (end == x)
                continue;
            const glm::vec2 from = lower(x, y), to = lower(end, y + 1);
            const auto below = std::ranges::find_if(result, [&](const Part& p) {
                return p.lower.x == from.x && p.upper.x == to.x && p.upper.y == from.y;
            });
            add(below != result.end() ? *below : result.emplace_back(), from, to);
        }
    return result;
}

std::vector<PartGrid::Part> PartGrid::rectangles() {
    constexpr double kMinShare = 0.005; // of all, for what sticks out of a wall
    constexpr std::size_t kMaxRuns = 8; // more follow a border that lies askew
    const std::vector<Part> parts = findParts();
    if (parts.size() < 2)
        return parts;
    std::vector<Part> result;
    for (const Part& p : parts)
        if (!p.atBorder && !p.onlyBacks)
            result.push_back(p);
    const std::vector<Part> enclosed = result;
    const auto atBorder = std::ranges::count_if(parts, &Part::atBorder);
    if (enclosed.size() + std::size_t(atBorder) < 2) // nothing but solids stand in it
        return {};
    for (std::uint32_t k = 0; k < parts.size(); ++k) {
        if (!parts[k].atBorder)
            continue;
        std::vector<Part> runs = runsOf(k, enclosed);
        if (runs.size() > kMaxRuns)
            runs = {parts[k]};
        for (const Part& run : runs)
            if (run.centre || run.area >= 4 * kMinShare)
                result.push_back(run);
    }
    std::ranges::stable_sort(result, [](const Part& a, const Part& b) {
        return std::pair(a.centre, a.area) > std::pair(b.centre, b.area);
    });
    return result;
}

Light partOf(const Light& light, const LightRectangle& r, const PartGrid::Part& part) {
    const glm::vec2 middle = (part.lower + part.upper) / 2.f;
    Light result = light;
    result.position = r.centre + middle.x * r.halfWidth + middle.y * r.halfHeight;
    result.size = light.size * (part.upper - part.lower) / 2.f;
    return result;
}

} // namespace

std::vector<Light> partsBetweenWalls(const Light& light, const Scene& scene) {
    const LightRectangle r = lightRectangle(light);
    const std::vector<LightCut> cuts = lightCuts(r, scene);
    if (cuts.empty())
        return {light};
    std::vector<PartGrid::Part> parts = PartGrid(cuts).rectangles();
    if (parts.size() < 2)
        return {light};
    parts.resize(std::min(parts.size(), kMaxLightParts));
    double area = 0;
    for (const PartGrid::Part& part : parts)
        area += double(part.upper.x - part.lower.x) * double(part.upper.y - part.lower.y);
    constexpr double kWhole = 4, kMinimum = 0.98, kRounding = 1.0001; // askew parts' would overlap
    if (area < kMinimum * kWhole || area > kRounding * kWhole)
        return {light};
    std::vector<Light> result;
    for (const PartGrid::Part& part : parts)
        result.push_back(partOf(light, r, part));
    return result;
}

} // namespace limn
