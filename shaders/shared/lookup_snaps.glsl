// SPDX-License-Identifier: MIT
// Where lightmap lookups read. Needs `frame`.

layout(set = 0, binding = FRAME_LOOKUP_SNAPS, std430) readonly buffer LookupSnaps { uint lookupSnaps[]; };

// kFineLookup, kFineCells, kFineLevels of engine/lightmap/layout/lightmap_layout.h.
const uint kFineLookup = 1u << 31;
const float kFineCells = 4.0;
const int kFineLevels = 5;

/// snapLookup() of engine/lightmap/atlas.h. `width` is AtlasLookup::width of the texels read.
vec2 snapLookup(vec2 uv, out float width) {
    width = 1.0;
    vec2 p = uv * frame.lookupSize - 0.5, base = floor(p);
    if (any(lessThan(base, vec2(0))) || any(greaterThanEqual(base, frame.lookupSize)))
        return uv; // without snaps lookupSize is 0
    const uint row = uint(frame.lookupSize.x);
    uint rows = lookupSnaps[uint(base.y) * row + uint(base.x)];
    for (int level = 0; level < kFineLevels && (rows & kFineLookup) != 0u; ++level) {
        const uint block = rows & ~kFineLookup;
        p = vec2(block % row, block / row) + (p - base) * kFineCells;
        base = floor(p);
        rows = lookupSnaps[uint(base.y) * row + uint(base.x)];
        width /= kFineCells;
    }
    vec2 f = p - base;
    const uvec2 cell = min(uvec2(f * 8.0), uvec2(7));
    const uint snap = rows == 0u || (rows & kFineLookup) != 0u
                          ? 0u : lookupSnaps[rows + cell.y] >> (4u * cell.x) & 15u;
    if (snap == 1u || snap == 2u)
        f.x = float(snap - 1u);
    else if (snap == 3u || snap == 4u)
        f.y = float(snap - 3u);
    else if (snap > 4u)
        f = vec2((snap - 5u) & 1u, (snap - 5u) >> 1);
    return (base + f + 0.5) / frame.lookupSize;
}
