// SPDX-License-Identifier: MIT
// Marches rays through octahedral maps of probes, as engine/techniques/probes/march_ray.h does. Needs `frame`,
// kMapSide, and the buffers marchedPlanes[], marchedNearest[] and marchedRadiance[] of
// engine/techniques/probes/gpu/gpu_marched_maps.h.
#include "shaders/shared/march_lookup.h"
#include "shaders/shared/octahedron.glsl"

const uint kNoProbe = 0xffffffffu;
const uint kMarchHit = 0u, kMarchMiss = 1u, kMarchUnknown = 2u;

/// MarchedRay of engine/techniques/probes/march_ray.h.
struct MarchedRay {
    uint end, probe;
    float t;
};

uint marchedBlocks() {
    return (kMapSide + MARCH_BLOCK - 1u) / MARCH_BLOCK;
}

bool marchedInSolid(uint probe) {
    return marchedNearest[probe * (marchedBlocks() * marchedBlocks() + 1u)] > 0.0;
}

vec3 probePosition(uint probe) {
    const uvec3 n = frame.gridSize, at = uvec3(probe % n.x, probe / n.x % n.y, probe / n.x / n.y);
    return frame.gridLower + (vec3(at) + 0.5) / frame.gridScale;
}

/// squareIn() of march_ray.cpp.
vec2 squareIn(vec3 signs, vec3 p) {
    return signs.z < 0.0 ? signs.xy * (1.0 - abs(p.yx)) : p.xy;
}

/// endAt() of march_ray.cpp: the place in the map in xy, the inverse 1-norm in z.
vec3 endAt(vec3 x, vec3 limit, float scale, vec3 signs) {
    const float kAtProbe = 1e-6, kLargest = 1e20;
    const vec3 inside = signs * max(signs * x, 0.0), to = signs * max(signs * limit, 0.0);
    const float length1 = norm1(inside);
    const float inverse = length1 * kLargest > 1.0 ? 1.0 / length1 : kLargest;
    const vec2 square = length1 > kAtProbe * scale ? squareIn(signs, inside / length1)
                                                   : squareIn(signs, to / max(norm1(to), 1e-30));
    return vec3(square, inverse);
}

/// A walk through the square cells that a part of a line crosses: walkCells() of march_ray.cpp.
struct CellWalk {
    vec2 from, along; // the line [texels]
    float s, last;    // shares of the line: where the walk is and where it ends
    ivec2 at, end;    // cells
    int size;         // texels along the side of a cell
    bool done;
};

CellWalk beginWalk(vec2 a, vec2 b, float s0, float s1, int size, int cells) {
    const vec2 along = b - a;
    return CellWalk(a, along, s0, s1, clamp(ivec2(floor((a + s0 * along) / float(size))), ivec2(0), ivec2(cells - 1)),
                    clamp(ivec2(floor((a + s1 * along) / float(size))), ivec2(0), ivec2(cells - 1)), size, false);
}

/// Leaves the cell `w.at`. Returns the share of the line at which it ends.
float leaveCell(inout CellWalk w) {
    int axis = -1;
    float next = w.last;
    for (int k = 0; k < 2; ++k) {
        if (w.at[k] == w.end[k])
            continue;
        const int edge = (w.at[k] + (w.end[k] > w.at[k] ? 1 : 0)) * w.size;
        const float crossing = (float(edge) - w.from[k]) / w.along[k];
        if (axis < 0 || crossing < next) {
            next = crossing;
            axis = k;
        }
    }
    next = clamp(next, w.s, w.last);
    w.done = axis < 0;
    if (axis >= 0)
        w.at[axis] += w.end[axis] > w.at[axis] ? 1 : -1;
    w.s = next;
    return next;
}

/// Goes on through a texel, in which the ray is from `tIn` to `tOut` [m]: March::pass() of march_ray.cpp. `origin`: from
/// the probe. Returns false where the ray ends.
bool passTexel(vec4 plane, vec3 origin, vec3 direction, float tIn, float tOut, inout bool inFront, inout MarchedRay ray) {
    const vec3 G = plane.xyz;
    const float fIn = 1.0 - dot(G, origin + tIn * direction), fOut = 1.0 - dot(G, origin + tOut * direction);
    if (fIn > 0.0 && fOut > 0.0) {
        inFront = true;
        return true;
    }
    const float unit = length(G) * MARCH_THICKNESS * 2.0 / float(kMapSide) * norm1(origin + tIn * direction);
    const bool crosses = fIn > 0.0 || (inFront && -fIn <= unit);
    if (fOut <= 0.0 && fOut < fIn && crosses) {
        ray.t = clamp((1.0 - dot(G, origin)) / dot(G, direction), tIn, tOut);
        ray.end = plane.w == MARCH_SOLID ? kMarchUnknown : kMarchHit;
        return false;
    }
    if (-max(fIn, fOut) > unit) {
        ray.t = tIn;
        ray.end = kMarchUnknown;
        return false;
    }
    inFront = fOut > 0.0;
    return true;
}

/// Goes on along the piece from t = `from` to `to` [m], whose ends are those of endAt().
bool passPiece(uint probe, vec3 origin, vec3 direction, vec2 t, vec3 start, vec3 end, inout bool inFront,
               inout MarchedRay ray) {
    const int side = int(kMapSide), blocks = int(marchedBlocks());
    const vec2 a = (start.xy * 0.5 + 0.5) * float(side), b = (end.xy * 0.5 + 0.5) * float(side);
    const uint firstPlane = probe * uint(side * side), firstBlock = probe * uint(blocks * blocks + 1) + 1u;
    CellWalk coarse = beginWalk(a, b, 0.0, 1.0, MARCH_BLOCK, blocks);
    while (!coarse.done) {
        const ivec2 block = coarse.at;
        const float s0 = coarse.s, s1 = leaveCell(coarse);
        if (!(s1 > s0))
            continue;
        if (min(mix(start.z, end.z, s0), mix(start.z, end.z, s1)) >
            marchedNearest[firstBlock + uint(block.y * blocks + block.x)]) {
            inFront = true;
            continue;
        }
        CellWalk fine = beginWalk(a, b, s0, s1, 1, side);
        while (!fine.done) {
            const ivec2 texel = fine.at;
            const float sIn = fine.s, sOut = leaveCell(fine);
            if (!(sOut > sIn))
                continue;
            const vec2 wIn = vec2((1.0 - sIn) * start.z, sIn * end.z), wOut = vec2((1.0 - sOut) * start.z, sOut * end.z);
            const float tIn = dot(wIn, t) / (wIn.x + wIn.y), tOut = dot(wOut, t) / (wOut.x + wOut.y);
            if (!passTexel(marchedPlanes[firstPlane + uint(texel.y * side + texel.x)], origin, direction, tIn, tOut, inFront, ray))
                return false;
        }
    }
    return true;
}

MarchedRay marchProbe(uint probe, vec3 origin, vec3 direction, float from) {
    const vec3 start = origin - probePosition(probe);
    MarchedRay ray = MarchedRay(kMarchUnknown, probe, from);
    if (direction == vec3(0) || marchedInSolid(probe))
        return ray;
    const float far = MARCH_FAR * (norm1(start) + norm1(vec3(frame.gridSize) / frame.gridScale) + from);
    const float scale = norm1(start);
    vec3 cuts; // where the ray crosses the probe's axis planes, in order
    for (int k = 0; k < 3; ++k) {
        const float t = direction[k] != 0.0 ? -start[k] / direction[k] : far;
        cuts[k] = t > from && t < far ? t : far;
    }
    cuts.xy = vec2(min(cuts.x, cuts.y), max(cuts.x, cuts.y));
    cuts.yz = vec2(min(cuts.y, cuts.z), max(cuts.y, cuts.z));
    cuts.xy = vec2(min(cuts.x, cuts.y), max(cuts.x, cuts.y));
    bool inFront = false;
    float before = from;
    for (int k = 0; k < 4; ++k) {
        const float after = k < 3 ? cuts[k] : far;
        if (!(after > before))
            continue;
        const vec3 middle = start + 0.5 * (before + after) * direction;
        const vec3 signs = vec3(unfolded(1.0, middle.x), unfolded(1.0, middle.y), unfolded(1.0, middle.z));
        if (!passPiece(probe, start, direction, vec2(before, after),
                       endAt(start + before * direction, direction, scale, signs),
                       endAt(start + after * direction, -direction, scale, signs), inFront, ray))
            return ray;
        before = after;
    }
    return MarchedRay(kMarchMiss, probe, far);
}

/// marchRay() of engine/techniques/probes/march_ray.h.
MarchedRay marchRay(vec3 origin, vec3 direction) {
    const ivec3 last = ivec3(frame.gridSize) - 1;
    const vec3 x = clamp((origin - frame.gridLower) * frame.gridScale - 0.5, vec3(0), vec3(last));
    const ivec3 lower = min(ivec3(x), max(last - 1, 0));
    uint probes[8];
    int nearest = 8;
    float least = 0.0;
    for (int k = 0; k < 8; ++k) {
        const uvec3 cell = uvec3(min(lower + ivec3(k & 1, (k >> 1) & 1, k >> 2), last));
        probes[k] = (cell.z * frame.gridSize.y + cell.y) * frame.gridSize.x + cell.x;
        const float away = distance(probePosition(probes[k]), origin);
        if (!marchedInSolid(probes[k]) && (nearest == 8 || away < least)) {
            nearest = k;
            least = away;
        }
    }
    if (nearest == 8)
        return MarchedRay(kMarchUnknown, kNoProbe, 0.0);
    MarchedRay ray = MarchedRay(kMarchUnknown, probes[nearest], 0.0);
    for (int k = 0, i = nearest; k < 8; ++k, i = (i + 3) % 8) {
        const MarchedRay next = marchProbe(probes[i], origin, direction, ray.t);
        if (next.end != kMarchUnknown)
            return next;
        ray.t = max(ray.t, next.t);
    }
    return ray;
}

/// Bilinear lookup in a level of radiance with `side` texels along its side, which begins at texel `first`.
vec3 levelRadiance(uint first, int side, vec2 square) {
    const vec2 at = (square * 0.5 + 0.5) * float(side) - 0.5, lower = floor(at), f = at - lower;
    vec3 sum = vec3(0);
    for (int k = 0; k < 4; ++k) {
        const ivec2 high = ivec2(k & 1, k >> 1);
        ivec2 texel = ivec2(lower) + high;
        for (int axis = 0; axis < 2; ++axis)
            if (texel[axis] < 0 || texel[axis] >= side) { // sides of the square are folded about their middles
                texel[axis] = clamp(texel[axis], 0, side - 1);
                texel[1 - axis] = side - 1 - texel[1 - axis];
            }
        const vec2 w = mix(1.0 - f, f, vec2(high));
        const uint i = 3u * (first + uint(texel.y * side + texel.x));
        sum += w.x * w.y * vec3(marchedRadiance[i], marchedRadiance[i + 1u], marchedRadiance[i + 2u]);
    }
    return sum;
}

/// probeRadiance() of engine/techniques/probes/marched_maps.h [W m^-2 sr^-1].
vec3 probeRadiance(uint probe, vec3 direction, float spread) {
    const float texel = MARCH_HALF * 2.0 * sqrt(kPi) / float(kMapSide);
    const vec2 p = direction.xy / norm1(direction);
    const vec2 square = direction.z < 0.0 ? vec2(unfolded(1.0 - abs(p.y), direction.x), unfolded(1.0 - abs(p.x), direction.y)) : p;
    float level = log2(max(spread / texel, 1.0));
    int side = int(kMapSide);
    uint first = 0u; // of the level's texels
    while (level >= 1.0 && side > MARCH_COARSEST) {
        first += frame.gridCells * uint(side * side);
        side = (side + 1) / 2;
        level -= 1.0;
    }
    const vec3 finer = levelRadiance(first + probe * uint(side * side), side, square);
    if (!(level > 0.0) || side <= MARCH_COARSEST)
        return finer;
    const uint next = first + frame.gridCells * uint(side * side);
    const int coarse = (side + 1) / 2;
    return mix(finer, levelRadiance(next + probe * uint(coarse * coarse), coarse, square), level);
}

/// Radiance that arrives in a lobe about unit `direction` of which half lies within `spread` [rad]: lookUp() and
/// marchedRadiance() of engine/techniques/probes/march_ray.h.
vec3 marchedReflection(vec3 origin, vec3 direction, float spread) {
    const MarchedRay ray = marchRay(origin, direction);
    if (ray.probe == kNoProbe)
        return vec3(0);
    const vec3 seen = origin + ray.t * direction - probePosition(ray.probe);
    const float away = length(seen);
    if (ray.end != kMarchHit || !(away > 0.0))
        return probeRadiance(ray.probe, direction, spread);
    return probeRadiance(ray.probe, seen, min(spread * ray.t / away, MARCH_WIDEST));
}
