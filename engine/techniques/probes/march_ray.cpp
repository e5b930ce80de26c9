// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/march_ray.h"

#include "engine/field/grid_cells.h"
#include "engine/math/octahedral.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr auto kFar = float(MARCH_FAR), kThickness = float(MARCH_THICKNESS);

/// Place in the map of a point of the octahedron, in the octant of these signs. Unlike
/// octahedralSquare(), it agrees on both sides of an octant's border with where a ray came from.
glm::vec2 squareIn(glm::vec3 signs, glm::vec3 p) {
    const glm::vec2 upper(p);
    return signs.z < 0 ? glm::vec2(signs) * (1.f - glm::abs(glm::vec2(p.y, p.x))) : upper;
}

/// The end of a piece at a point `x` of the ray in the octant of `signs`; `limit` is the direction
/// of the piece's other points where x is the probe itself.
void endAt(glm::vec3 x, glm::vec3 limit, float scale, glm::vec3 signs, glm::vec2& square,
           float& inverse) {
    const auto inOctant = [&](glm::vec3 v) { return signs * glm::max(signs * v, 0.f); };
    constexpr float kAtProbe = 1e-6f, kLargest = 1e20f;
    const glm::vec3 inside = inOctant(x);
    const float length = norm1(inside);
    inverse = length * kLargest > 1 ? 1 / length : kLargest;
    if (length > kAtProbe * scale) {
        square = squareIn(signs, inside / length);
        return;
    }
    const glm::vec3 to = inOctant(limit);
    square = squareIn(signs, to / std::max(norm1(to), 1e-30f));
}

/// Visits the square cells, `size` texels wide, that the part [s0, s1] of the line from `a` to `b`
/// [texels] crosses, in order, each with its own part. Ends where `visit` returns false, and
/// returns that.
template <class Visit>
bool walkCells(glm::vec2 a, glm::vec2 b, float s0, float s1, int size, int cells, Visit visit) {
    const glm::vec2 along = b - a;
    const auto cellAt = [&](float s) {
        return glm::clamp(glm::ivec2(glm::floor((a + s * along) / float(size))), 0, cells - 1);
    };
    glm::ivec2 cell = cellAt(s0);
    const glm::ivec2 last = cellAt(s1);
    for (float s = s0;;) {
        int axis = -1;
        float next = s1;
        for (int k = 0; k < 2; ++k) {
            if (cell[k] == last[k])
                continue;
            const int edge = (cell[k] + (last[k] > cell[k] ? 1 : 0)) * size;
            const float crossing = (float(edge) - a[k]) / along[k];
            if (axis < 0 || crossing < next) {
                next = crossing;
                axis = k;
            }
        }
        next = std::clamp(next, s, s1);
        if (next > s && !visit(cell, s, next))
            return false;
        if (axis < 0)
            return true;
        cell[axis] += last[axis] > cell[axis] ? 1 : -1;
        s = next;
    }
}

/// A ray on its way through the map of a probe.
struct March {
    const MarchedMaps& maps;
    std::uint32_t probe;
    glm::vec3 origin, direction; ///< from the probe
    bool inFront = false;        ///< of what the probe saw so far along the ray
    MarchedRay result;

    float f(glm::vec3 G, float t) const { return 1 - glm::dot(G, origin + t * direction); }

    bool end(MarchEnd how, float t) {
        result = {how, probe, t};
        return false;
    }

    /// Goes on through a texel, in which the ray is from `in` to `out` [m]. Returns false where the
    /// ray ends.
    bool pass(glm::vec4 plane, float in, float out) {
        const glm::vec3 G(plane);
        const float fIn = f(G, in), fOut = f(G, out);
        if (fIn > 0 && fOut > 0) {
            inFront = true;
            return true;
        }
        // Height behind the plane, in units of the thickness.
        const float unit = kThickness * 2 / float(maps.side) * norm1(origin + in * direction);
        const auto behind = [&](float value) { return -value / (glm::length(G) * unit); };
        const bool crosses = fIn > 0 || (inFront && behind(fIn) <= 1);
        if (fOut <= 0 && fOut < fIn && crosses) {
            const float t = (1 - glm::dot(G, origin)) / glm::dot(G, direction);
            const bool solid = plane.w == MarchedMaps::kSolid;
            return end(solid ? MarchEnd::Unknown : MarchEnd::Hit, std::clamp(t, in, out));
        }
        if (behind(std::max(fIn, fOut)) > 1)
            return end(MarchEnd::Unknown, in);
        inFront = fOut > 0;
        return true;
    }

    /// Goes on along a straight piece. Returns false where the ray ends.
    bool pass(const RayPiece& piece) {
        const auto side = int(maps.side), blocks = int(maps.nearestSide());
        const glm::vec4* planes = maps.planes.data() + probe * maps.texels();
        const float* nearest =
            maps.nearest.data() + std::size_t(probe) * std::size_t(blocks * blocks);
        const glm::vec2 a = (piece.start * 0.5f + 0.5f) * float(side),
                        b = (piece.end * 0.5f + 0.5f) * float(side);
        const auto inverse = [&](float s) {
            return (1 - s) * piece.startInverse + s * piece.endInverse;
        };
        return walkCells(
            a, b, 0, 1, int(MarchedMaps::kBlock), blocks,
            [&](glm::ivec2 block, float s0, float s1) {
                if (std::min(inverse(s0), inverse(s1)) > nearest[block.y * blocks + block.x]) {
                    inFront = true;
                    return true;
                }
                return walkCells(a, b, s0, s1, 1, side, [&](glm::ivec2 texel, float in, float out) {
                    return pass(planes[texel.y * side + texel.x], piece.along(in),
                                piece.along(out));
                });
            });
    }
};

glm::vec3 positionOf(const MarchedMaps& maps, std::uint32_t probe) {
    const glm::uvec3 n = maps.gridSize, cell(probe % n.x, probe / n.x % n.y, probe / n.x / n.y);
    return maps.gridBounds.lower + (glm::vec3(cell) + 0.5f) / glm::vec3(n) * maps.gridBounds.size();
}

} // namespace

RayPieces cutRay(glm::vec3 origin, glm::vec3 direction, float from, float to) {
    RayPieces pieces;
    if (!(to > from) || direction == glm::vec3(0))
        return pieces;
    std::array<float, 5> cuts = {from, to, to, to, to}; // in order; some are the same
    for (int a = 0; a < 3; ++a) {
        const float t = -origin[a] / direction[a];
        if (direction[a] != 0 && t > from && t < to)
            cuts[std::size_t(a) + 1] = t;
    }
    for (const std::size_t k : {1U, 2U, 1U})
        if (cuts[k] > cuts[k + 1])
            std::swap(cuts[k], cuts[k + 1]);
    const float scale = norm1(origin);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        if (!(cuts[k + 1] > cuts[k]))
            continue;
        RayPiece& piece = pieces.piece[pieces.count++];
        piece.from = cuts[k];
        piece.to = cuts[k + 1];
        const glm::vec3 middle = origin + 0.5f * (piece.from + piece.to) * direction;
        const glm::vec3 signs(middle.x < 0 ? -1 : 1, middle.y < 0 ? -1 : 1, middle.z < 0 ? -1 : 1);
        endAt(origin + piece.from * direction, direction, scale, signs, piece.start,
              piece.startInverse);
        endAt(origin + piece.to * direction, -direction, scale, signs, piece.end, piece.endInverse);
    }
    return pieces;
}

MarchedRay marchProbe(const MarchedMaps& maps, std::uint32_t probe, glm::vec3 origin,
                      glm::vec3 direction, float from) {
    const glm::vec3 start = origin - positionOf(maps, probe);
    March march{.maps = maps, .probe = probe, .origin = start, .direction = direction};
    if (direction == glm::vec3(0) || maps.inSolid[probe] != 0)
        return {MarchEnd::Unknown, probe, from};
    const float far = kFar * (norm1(start) + norm1(maps.gridBounds.size()) + from);
    const RayPieces pieces = cutRay(start, direction, from, far);
    for (std::size_t k = 0; k < pieces.count; ++k)
        if (!march.pass(pieces.piece[k]))
            return march.result;
    return {MarchEnd::Miss, probe, far};
}

MarchedRay marchRay(const MarchedMaps& maps, glm::vec3 origin, glm::vec3 direction) {
    const std::array<std::uint32_t, 8> probes =
        cellsAbout(maps.gridBounds, maps.gridSize, origin).index;
    std::uint32_t nearest = 8;
    float minDistance = 0;
    for (std::uint32_t k = 0; k < 8; ++k) {
        const float distance = glm::distance(positionOf(maps, probes[k]), origin);
        if (maps.inSolid[probes[k]] == 0 && (nearest == 8 || distance < minDistance)) {
            nearest = k;
            minDistance = distance;
        }
    }
    if (nearest == 8)
        return {};
    MarchedRay ray{.probe = probes[nearest]};
    for (std::uint32_t k = 0, i = nearest; k < 8; ++k, i = (i + 3) % 8) {
        const MarchedRay next = marchProbe(maps, probes[i], origin, direction, ray.t);
        if (next.end != MarchEnd::Unknown)
            return next;
        ray.t = std::max(ray.t, next.t);
    }
    return ray;
}

MarchedLookup lookUp(const MarchedMaps& maps, const MarchedRay& ray, glm::vec3 origin,
                     glm::vec3 direction, float spread) {
    if (ray.probe == MarchedRay::kNoProbe)
        return {};
    const glm::vec3 seen = origin + ray.t * direction - positionOf(maps, ray.probe);
    const float distance = glm::length(seen);
    if (ray.end != MarchEnd::Hit || !(distance > 0))
        return {ray.probe, direction, spread};
    // As much of the surface as the lobe covers there.
    return {ray.probe, seen, std::min(spread * ray.t / distance, float(MARCH_WIDEST))};
}

glm::vec3 marchedRadiance(const MarchedMaps& maps, const MarchedLookup& lookup) {
    if (lookup.probe == MarchedRay::kNoProbe || lookup.direction == glm::vec3(0))
        return glm::vec3(0);
    return probeRadiance(maps, lookup.probe, lookup.direction, lookup.spread);
}

} // namespace limn
