// SPDX-License-Identifier: MIT
#include "engine/scene/light_parts.h"

#include "engine/scene/rectangle_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// Where a triangle cuts the light's plane, in the light's coordinates: [-1, 1]^2 within.
struct Cut {
    glm::vec2 a, b;
    glm::vec2 front; ///< times an offset in these coordinates: > 0 before the triangle
    bool twoSided;
};

/// The part of a segment within [-1, 1]^2. Liang, Barsky. A New Concept and Method for Line
/// Clipping. 1984
bool clipToSquare(glm::vec2& a, glm::vec2& b) {
    float enter = 0, leave = 1;
    const glm::vec2 way = b - a;
    for (int axis = 0; axis < 2; ++axis)
        for (const float side : {-1.f, 1.f}) {
            const float out = side * a[axis] - 1, along = -side * way[axis];
            if (along == 0 ? out > 0 : false)
                return false;
            if (along < 0)
                leave = std::min(leave, out / along);
            if (along > 0)
                enter = std::max(enter, out / along);
        }
    if (!(enter < leave))
        return false;
    const glm::vec2 start = a;
    a = start + way * enter;
    b = start + way * leave;
    return true;
}

/// The plane lies a little before the light: what the light is flush with does not cut it.
class Cutter {
public:
    explicit Cutter(const LightRectangle& r)
        : m_r(r), m_from(r.centre + r.normal * (1e-3f * std::min(glm::length(r.halfWidth),
                                                                 glm::length(r.halfHeight)))) {}

    void add(const Scene& scene, const Instance& instance, std::vector<Cut>& cuts) {
        const Mesh& mesh = scene.meshOf(instance);
        const glm::vec3 normal = glm::transpose(glm::mat3(instance.toWorld)) * m_r.normal;
        const float offset = glm::dot(m_r.normal, glm::vec3(instance.toWorld[3]) - m_from);
        m_height.resize(mesh.positions.size());
        for (std::size_t i = 0; i < m_height.size(); ++i)
            m_height[i] = glm::dot(normal, mesh.positions[i]) + offset;
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
            addTriangle(scene, instance, mesh.triangle(t), cuts);
    }

private:
    glm::vec2 coordinates(glm::vec3 p) const {
        const glm::vec3 way = p - m_r.centre;
        return {glm::dot(way, m_r.halfWidth) / glm::dot(m_r.halfWidth, m_r.halfWidth),
                glm::dot(way, m_r.halfHeight) / glm::dot(m_r.halfHeight, m_r.halfHeight)};
    }
    void addTriangle(const Scene& scene, const Instance& instance,
                     const std::array<std::uint32_t, 3>& corners, std::vector<Cut>& cuts) const {
        const std::vector<glm::vec3>& at = scene.meshOf(instance).positions;
        std::array<glm::vec3, 3> ends;
        std::size_t count = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = corners[k], j = corners[(k + 1) % 3];
            if ((m_height[i] < 0) != (m_height[j] < 0))
                ends[count++] =
                    at[i] + (at[j] - at[i]) * (m_height[i] / (m_height[i] - m_height[j]));
        }
        if (count != 2)
            return;
        const auto placed = [&](glm::vec3 p) {
            return coordinates(glm::vec3(instance.toWorld * glm::vec4(p, 1)));
        };
        Cut cut{placed(ends[0]), placed(ends[1]), {}, false};
        if (!clipToSquare(cut.a, cut.b))
            return;
        const glm::vec3 normal =
            instance.normalToWorld *
            glm::cross(at[corners[1]] - at[corners[0]], at[corners[2]] - at[corners[0]]);
        cut.front = {glm::dot(normal, m_r.halfWidth), glm::dot(normal, m_r.halfHeight)};
        cut.twoSided = scene.materialOf(instance).doubleSided;
        cuts.push_back(cut);
    }

    const LightRectangle& m_r;
    glm::vec3 m_from;
    std::vector<float> m_height; ///< of the mesh's vertices above the plane
};

/// The coordinates along one axis at which something may change, -1 and 1 among them.
std::vector<float> linesOf(const std::vector<Cut>& cuts, int axis) {
    constexpr std::size_t kMostLines = 128;
    std::vector<float> all = {-1, 1};
    for (const Cut& c : cuts) {
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
    if (all.size() > kMostLines) {
        for (std::size_t i = 0; i < kMostLines; ++i)
            lines.push_back(all[i * (all.size() - 1) / (kMostLines - 1)]);
        return lines;
    }
    // For walls that lie askew; of other numbers, so that these do not pass through cells' middles.
    const std::size_t steps = kMostLines / all.size() + std::size_t(axis);
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

/// The light in cells, of which those are joined whose middles see each other along the plane.
class PartGrid {
public:
    explicit PartGrid(const std::vector<Cut>& cuts)
        : m_lines{linesOf(cuts, 0), linesOf(cuts, 1)}, m_middles{middlesOf(m_lines[0]),
                                                                 middlesOf(m_lines[1])},
          m_parent(cells()), m_backs(cells(), true) {
        std::iota(m_parent.begin(), m_parent.end(), 0U);
        for (const int axis : {0, 1})
            m_blocked[std::size_t(axis)].assign(cells(), false);
        for (const Cut& c : cuts)
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

    /// What no wall parts.
    struct Part {
        glm::vec2 lower{2}, upper{-2};
        double area = 0;
        bool centre = false; ///< the light's own lies in it
        bool onlyBacks = true, atBorder = false;
    };
    /// Enclosed ones with the rectangles round them; those that reach the light's border in
    /// rectangles beside these.
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
    void block(const Cut& cut, int axis);

    std::array<std::vector<float>, 2> m_lines, m_middles;
    std::vector<std::uint32_t> m_parent;
    std::array<std::vector<bool>, 2> m_blocked; ///< per cell, towards the next one along each axis
    std::vector<bool> m_backs;                  ///< per cell: it touches nothing but backs
    std::vector<std::uint32_t> m_partOf;        ///< per cell
};

/// Blocks the steps along `axis` that the cut crosses.
void PartGrid::block(const Cut& cut, int axis) {
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

/// The cells of a part beside the rectangles of `enclosed`, in runs along rows; like runs of rows
/// after one another together.
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
    constexpr double kLeastShare = 0.005; // of all, for what sticks out of a wall
    constexpr std::size_t kMostRuns = 8;  // more follow a border that lies askew
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
        if (runs.size() > kMostRuns)
            runs = {parts[k]};
        for (const Part& run : runs)
            if (run.centre || run.area >= 4 * kLeastShare)
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
    Cutter cutter(r);
    std::vector<Cut> cuts;
    for (const Instance& instance : scene.instances)
        if (!isCutout(scene.materialOf(instance)))
            cutter.add(scene, instance, cuts);
    if (cuts.empty())
        return {light};
    std::vector<PartGrid::Part> parts = PartGrid(cuts).rectangles();
    if (parts.size() < 2)
        return {light};
    parts.resize(std::min(parts.size(), kMostLightParts));
    double area = 0;
    for (const PartGrid::Part& part : parts)
        area += double(part.upper.x - part.lower.x) * double(part.upper.y - part.lower.y);
    constexpr double kWhole = 4, kLeast = 0.98, kRounding = 1.0001; // askew parts' would overlap
    if (area < kLeast * kWhole || area > kRounding * kWhole)
        return {light};
    std::vector<Light> result;
    for (const PartGrid::Part& part : parts)
        result.push_back(partOf(light, r, part));
    return result;
}

} // namespace limn
