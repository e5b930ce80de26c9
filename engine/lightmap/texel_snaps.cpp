// SPDX-License-Identifier: MIT
#include "engine/lightmap/texel_snaps.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

namespace {

constexpr int kCells = int(kSnapCells);

/// Corners of a quad, as bits, that each snap reads: all, left, right, upper, lower, one each.
constexpr std::array<std::uint32_t, kSnaps> kReads = {0xf, 0x5, 0xa, 0x3, 0xc, 1, 2, 4, 8};

/// Four neighbouring texels of the atlas, and the surface between them.
struct Quad {
    std::array<std::uint32_t, 4> texel; ///< into Atlas::texels; (x, y), (x+1, y), (x, y+1), …
    std::uint32_t place = 0;            ///< the first one's place, y * width + x
    std::array<MeshPoint, kCells * kCells> points{};
    std::uint64_t found = 0; ///< bit per point
};

/// Snap per cell of a quad; kSnaps if the cell's centre is on one side with none of the texels.
using CellSnaps = std::array<std::uint32_t, kCells * kCells>;

/// Offsets from a cell to all cells within one place of it, nearest first.
std::vector<glm::ivec2> nearestCells() {
    std::vector<glm::ivec2> result;
    for (int y = -kCells; y <= kCells; ++y)
        for (int x = -kCells; x <= kCells; ++x)
            result.emplace_back(x, y);
    std::ranges::stable_sort(result, {}, [](glm::ivec2 d) { return d.x * d.x + d.y * d.y; });
    return result;
}

class Snapper {
public:
    Snapper(const SideFinder& sides, const std::vector<AtlasTexel>& texels,
            const std::vector<TexelSide>& side, const std::vector<PlacedTriangle>& placed)
        : m_sides(sides), m_layout(sides.atlas.layout), m_texels(texels), m_side(side),
          m_placed(placed) {
        m_texelAt.assign(std::size_t(m_layout.width) * m_layout.height, kNone);
        for (std::uint32_t i = 0; i < texels.size(); ++i)
            m_texelAt[texels[i].texel] = i;
    }

    std::vector<std::uint32_t> run(const Progress& progress);

private:
    static constexpr std::uint32_t kNone = ~0U;

    std::uint32_t neighbour(std::uint32_t texel, std::uint32_t dx, std::uint32_t dy) const;
    bool alike(std::uint32_t a, std::uint32_t b) const;
    bool apart(std::uint32_t a, std::uint32_t b) const;
    void findQuads(const Progress& progress);
    void findPoints();
    void addTriangles(std::uint32_t instance, std::uint32_t back);
    void addTriangle(const PlacedTriangle& placed);
    std::uint32_t snapAt(const Quad& quad, int cell) const;
    CellSnaps snapsOf(const Quad& quad) const;
    std::uint32_t snapLike(const std::vector<CellSnaps>& known, const Quad& quad,
                           glm::ivec2 cell) const;
    float clearance(const Quad& quad, std::uint32_t snap) const;
    std::uint32_t outwards(const std::vector<CellSnaps>& known, const Quad& quad, glm::ivec2 cell,
                           std::uint32_t snap) const;
    std::array<std::uint32_t, kSnapCells> rowsOf(const std::vector<CellSnaps>& known,
                                                 const Quad& quad) const;

    const SideFinder& m_sides;
    const LightmapLayout& m_layout;
    const std::vector<AtlasTexel>& m_texels;
    const std::vector<TexelSide>& m_side;
    const std::vector<PlacedTriangle>& m_placed;
    std::vector<std::uint32_t> m_texelAt; ///< per place: into m_texels
    std::vector<std::uint32_t> m_quadAt;  ///< per place: into m_quads
    std::vector<Quad> m_quads;
    std::vector<glm::ivec2> m_nearest = nearestCells();
};

/// Whether two texels belong to the same chart and side.
bool Snapper::alike(std::uint32_t a, std::uint32_t b) const {
    const AtlasTexel &s = m_texels[a], &t = m_texels[b];
    return s.instance == t.instance && s.back == t.back && m_side[a].chart == m_side[b].chart;
}

/// Neighbour of a texel in the same chart and side; kNone if there is none.
std::uint32_t Snapper::neighbour(std::uint32_t texel, std::uint32_t dx, std::uint32_t dy) const {
    const AtlasTexel& t = m_texels[texel];
    const std::uint32_t x = t.texel % m_layout.width + dx, y = t.texel / m_layout.width + dy;
    if (x >= m_layout.width || y >= m_layout.height)
        return kNone;
    const std::uint32_t other = m_texelAt[std::size_t(y) * m_layout.width + x];
    return other != kNone && alike(texel, other) ? other : kNone;
}

/// Whether a point between two texels may be on one side with only one of them.
bool Snapper::apart(std::uint32_t a, std::uint32_t b) const {
    const TexelSide &s = m_side[a], &t = m_side[b];
    if (s.split || t.split || !s.open || !t.open)
        return s.open || t.open;
    ++m_sides.rays;
    return !m_sides.sees(s.points[s.count / 2], t.points[t.count / 2]);
}

void Snapper::findQuads(const Progress& progress) {
    std::vector<std::uint8_t> right(m_texels.size()), down(m_texels.size());
    const auto link = [&](std::uint32_t i, std::uint32_t dx, std::uint32_t dy) {
        const std::uint32_t other = neighbour(i, dx, dy);
        return std::uint8_t(other != kNone && apart(i, other));
    };
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    parallelRanges(m_texels.size(), 64, quiet, "charts", [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (m_side[i].chart != kMixedCharts) {
                right[i] = link(std::uint32_t(i), 1, 0);
                down[i] = link(std::uint32_t(i), 0, 1);
            }
    });
    m_quadAt.assign(m_texelAt.size(), kNone);
    for (std::uint32_t i = 0; i < m_texels.size(); ++i) {
        if (m_side[i].chart == kMixedCharts)
            continue;
        const Quad quad{{i, neighbour(i, 1, 0), neighbour(i, 0, 1), neighbour(i, 1, 1)},
                        m_texels[i].texel};
        const auto set = [](const std::vector<std::uint8_t>& flags, std::uint32_t t) {
            return t != kNone && flags[t] != 0;
        };
        if (set(right, i) || set(down, i) || set(right, quad.texel[2]) ||
            set(down, quad.texel[1])) {
            m_quadAt[quad.place] = std::uint32_t(m_quads.size());
            m_quads.push_back(quad);
        }
    }
}

/// Adds the centres of the quads' cells that lie on one triangle.
void Snapper::addTriangle(const PlacedTriangle& placed) {
    std::array<glm::vec2, 3> p; // in cells
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = placed.corner[k] * float(kCells);
    const glm::ivec2 first = placed.lower * kCells, end = placed.upper * kCells;
    const glm::vec2 lower = glm::min(p[0], glm::min(p[1], p[2])),
                    upper = glm::max(p[0], glm::max(p[1], p[2])), e1 = p[1] - p[0],
                    e2 = p[2] - p[0];
    const float area = e1.x * e2.y - e1.y * e2.x;
    if (!(std::abs(area) > 1e-12f))
        return;
    constexpr float kSlack = 1e-4f;
    for (int y = std::max(int(std::ceil(lower.y - 0.5f)), first.y);
         float(y) + 0.5f <= upper.y && y < end.y; ++y)
        for (int x = std::max(int(std::ceil(lower.x - 0.5f)), first.x);
             float(x) + 0.5f <= upper.x && x < end.x; ++x) {
            const glm::ivec2 position(x / kCells, y / kCells);
            const std::uint32_t quad =
                m_quadAt[std::size_t(position.y) * m_layout.width + std::size_t(position.x)];
            const std::uint32_t cell = std::uint32_t((y % kCells) * kCells + x % kCells);
            if (quad == kNone || (m_quads[quad].found >> cell & 1))
                continue;
            const glm::vec2 d = glm::vec2(float(x), float(y)) + 0.5f - p[0];
            const float u = (d.x * e2.y - d.y * e2.x) / area, v = (e1.x * d.y - e1.y * d.x) / area;
            if (u < -kSlack || v < -kSlack || u + v > 1 + kSlack)
                continue;
            m_quads[quad].found |= std::uint64_t(1) << cell;
            m_quads[quad].points[cell] = {placed.triangle, {u, v}};
        }
}

/// Adds the triangles of one side of an instance.
void Snapper::addTriangles(std::uint32_t instance, std::uint32_t back) {
    const std::uint32_t mesh = m_sides.trace.scene().instances[instance].mesh;
    for (std::uint32_t t = 0; t < m_layout.meshes[mesh].chartOfTriangle.size(); ++t)
        addTriangle(placeTriangle(m_layout, mesh, instance, back, t));
}

void Snapper::findPoints() {
    for (const PlacedTriangle& placed : m_placed)
        addTriangle(placed);
    for (std::uint32_t i = 0; i < m_layout.instances.size(); ++i) {
        if (m_layout.instances[i].uv.empty())
            continue;
        addTriangles(i, 0);
        if (m_layout.instances[i].backRows > 0)
            addTriangles(i, 1);
    }
}

} // namespace

std::uint32_t chooseSnap(const SideFinder& sides, const std::vector<TexelSide>& side,
                         const std::array<std::uint32_t, 4>& texel, const LiftedPoint& from,
                         glm::vec2 f) {
    const std::array<float, 4> weight = {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y,
                                         f.x * f.y};
    std::uint32_t usable = 0, seen = 0, rays = 0;
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (texel[k] == ~0U) { // lookups have no weight there
            usable |= 1U << k;
            continue;
        }
        const TexelSide& s = side[texel[k]];
        for (std::uint32_t i = 0; i < s.count && s.open && !(seen >> k & 1); ++i, ++rays)
            seen |= std::uint32_t(sides.sees(from, s.points[i])) << k;
    }
    sides.rays += rays;
    usable |= seen;
    std::uint32_t best = kSnaps;
    float maxSum = 0;
    for (std::uint32_t snap = 0; snap < kSnaps; ++snap) {
        if (kReads[snap] & ~usable)
            continue;
        float sum = 0;
        for (std::uint32_t k = 0; k < 4; ++k)
            sum += (kReads[snap] & seen) >> k & 1 ? weight[k] : 0;
        if (sum > maxSum) {
            maxSum = sum;
            best = snap;
        }
    }
    return best;
}

namespace {

/// Snap for the centre of a cell.
std::uint32_t Snapper::snapAt(const Quad& quad, int cell) const {
    if (!(quad.found >> cell & 1))
        return kSnaps;
    const AtlasTexel& owner = m_texels[quad.texel[0]];
    const LiftedPoint from =
        m_sides.lift(quad.points[std::size_t(cell)], owner, m_side[quad.texel[0]].chart);
    const glm::vec2 f =
        (glm::vec2(float(cell % kCells), float(cell / kCells)) + 0.5f) / float(kCells);
    return chooseSnap(m_sides, m_side, quad.texel, from, f);
}

/// Evaluates the cells of every other row and column, and of the last ones. Of the cells between,
/// only those whose neighbours differ are evaluated; all others have the snap of their neighbours.
CellSnaps Snapper::snapsOf(const Quad& quad) const {
    constexpr int kLast = kCells - 1;
    const auto evaluated = [](int i) { return i % 2 == 0 || i == kLast; };
    CellSnaps snap;
    const auto cellSnap = [&](int x, int y) -> std::uint32_t& {
        return snap[std::size_t(y * kCells + x)];
    };
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x)
            if (evaluated(x) && evaluated(y))
                cellSnap(x, y) = snapAt(quad, y * kCells + x);
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
            if (evaluated(x) && evaluated(y))
                continue;
            const int dx = evaluated(x) ? 0 : 1, dy = evaluated(y) ? 0 : 1;
            const std::uint32_t first = cellSnap(x - dx, y - dy);
            const bool alike = first < kSnaps && cellSnap(x + dx, y - dy) == first &&
                               cellSnap(x - dx, y + dy) == first &&
                               cellSnap(x + dx, y + dy) == first;
            cellSnap(x, y) = alike ? first : snapAt(quad, y * kCells + x);
        }
    return snap;
}

/// The snap of `quad` that reads the same texels as `cell`, whose coordinates are relative to this
/// quad and may lie in a neighbouring place; kSnaps if there is none.
std::uint32_t Snapper::snapLike(const std::vector<CellSnaps>& known, const Quad& quad,
                                glm::ivec2 cell) const {
    const glm::ivec2 beside = (cell + kCells) / kCells - 1,
                     position = glm::ivec2(int(quad.place % m_layout.width),
                                           int(quad.place / m_layout.width)) +
                                beside;
    if (position.x < 0 || position.y < 0 || position.x >= int(m_layout.width) ||
        position.y >= int(m_layout.height))
        return kSnaps;
    const std::size_t place = std::size_t(position.y) * m_layout.width + std::size_t(position.x);
    if (m_texelAt[place] == kNone || !alike(m_texelAt[place], quad.texel[0]))
        return kSnaps;
    std::uint32_t reads = kReads[0];
    if (const std::uint32_t there = m_quadAt[place]; there != kNone) {
        const glm::ivec2 c = cell - beside * kCells;
        const std::uint32_t snap = known[there][std::size_t(c.y * kCells + c.x)];
        if (snap == kSnaps || beside == glm::ivec2(0))
            return snap;
        reads = kReads[snap];
    }
    std::uint32_t shared = 0;
    for (int k = 0; k < 4; ++k) {
        const glm::ivec2 corner = beside + glm::ivec2(k % 2, k / 2);
        if (!(reads >> k & 1) || glm::clamp(corner, 0, 1) != corner)
            continue;
        const int index = corner.y * 2 + corner.x;
        const std::uint32_t texel = quad.texel[std::size_t(index)];
        if (texel != kNone && m_side[texel].open)
            shared |= 1U << index;
    }
    return std::uint32_t(std::ranges::find(kReads, shared) - kReads.begin());
}

/// Maximum clearance of the texels that a snap reads [m].
float Snapper::clearance(const Quad& quad, std::uint32_t snap) const {
    float maximum = 0;
    for (std::uint32_t k = 0; k < 4; ++k)
        if (kReads[snap] >> k & 1 && quad.texel[k] != kNone)
            maximum = std::max(maximum, m_side[quad.texel[k]].clearance);
    return maximum;
}

/// The snap of a cell whose centre lies in a pocket narrower than half a texel, such as that behind
/// a picture: the snap of the cell beside it that is in the open, if there is one. The cell's
/// border may be in the open as well, where everyone sees it, while hardly anyone sees into the
/// pocket.
std::uint32_t Snapper::outwards(const std::vector<CellSnaps>& known, const Quad& quad,
                                glm::ivec2 cell, std::uint32_t snap) const {
    constexpr float kNarrow = 0.5f; // [texels]
    constexpr float kOpener = 8;    // times
    const float current = clearance(quad, snap);
    if (current > kNarrow * m_texels[quad.texel[0]].width)
        return snap;
    float best = kOpener * current;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const std::uint32_t other = snapLike(known, quad, cell + glm::ivec2(x, y));
            if (other >= kSnaps || other == snap)
                continue;
            if (const float c = clearance(quad, other); c > best) {
                best = c;
                snap = other;
            }
        }
    return snap;
}

/// Cells without a snap of their own, such as those whose centre lies in a wall, copy the nearest
/// one, possibly of a neighbouring quad: a strip of such a cell may protrude from the wall there.
std::array<std::uint32_t, kSnapCells> Snapper::rowsOf(const std::vector<CellSnaps>& known,
                                                      const Quad& quad) const {
    std::array<std::uint32_t, kSnapCells> rows{};
    for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
            std::uint32_t snap = kSnaps;
            for (auto d = m_nearest.begin(); snap == kSnaps && d != m_nearest.end(); ++d)
                snap = snapLike(known, quad, glm::ivec2(x, y) + *d);
            if (snap < kSnaps)
                snap = outwards(known, quad, glm::ivec2(x, y), snap);
            rows[std::size_t(y)] |= (snap < kSnaps ? snap : 0) << 4 * x;
        }
    return rows;
}

std::vector<std::uint32_t> Snapper::run(const Progress& progress) {
    findQuads(progress);
    if (progress.cancelled())
        return {};
    findPoints();
    std::vector<CellSnaps> known(m_quads.size());
    std::vector<std::array<std::uint32_t, kSnapCells>> rows(m_quads.size());
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    const auto forQuads = [&](const auto& visit) {
        return parallelRanges(m_quads.size(), 16, quiet, "charts",
                              [&](std::size_t begin, std::size_t end) {
                                  for (std::size_t q = begin; q < end; ++q)
                                      visit(q);
                              });
    };
    if (!forQuads([&](std::size_t q) { known[q] = snapsOf(m_quads[q]); }) ||
        !forQuads([&](std::size_t q) { rows[q] = rowsOf(known, m_quads[q]); }))
        return {};
    std::vector<std::uint32_t> result(m_texelAt.size());
    for (std::size_t q = 0; q < m_quads.size(); ++q)
        if (rows[q] != std::array<std::uint32_t, kSnapCells>{}) {
            result[m_quads[q].place] = std::uint32_t(result.size());
            result.insert(result.end(), rows[q].begin(), rows[q].end());
        }
    return result.size() > m_texelAt.size() ? result : std::vector<std::uint32_t>();
}

} // namespace

std::vector<std::uint32_t> findSnaps(const SideFinder& sides, const std::vector<AtlasTexel>& texels,
                                     const std::vector<TexelSide>& side,
                                     const std::vector<PlacedTriangle>& placed,
                                     const Progress& progress) {
    return Snapper(sides, texels, side, placed).run(progress);
}

} // namespace limn
