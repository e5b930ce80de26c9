// SPDX-License-Identifier: MIT
// Which grids of caches light a point: engine/techniques/radiance_volumes/cache_grids.cpp. Needs the block `volume`
// of a GpuCacheGrids.

/// aboveSurface().
vec3 aboveSurface(vec3 p, vec3 normal) {
    return p + normal * (0.01 * volume.grid[0].cell);
}

/// limn::GridShares: the finest grid and its share; the next one has the rest.
struct GridShares {
    uint grid;
    float weight;
};

GridShares gridShares(vec3 p) {
    GridShares shares = GridShares(0u, 1.0);
    while (shares.grid + 1u < volume.count && (any(lessThan(p, volume.grid[shares.grid].decisionLower)) ||
                                               any(greaterThan(p, volume.grid[shares.grid].decisionUpper))))
        ++shares.grid;
    if (shares.grid + 1u < volume.count && volume.transition > 0.0) {
        const vec3 inside = min(p - volume.grid[shares.grid].decisionLower, volume.grid[shares.grid].decisionUpper - p);
        const float nearest = min(inside.x, min(inside.y, inside.z));
        shares.weight = clamp(nearest / (volume.transition * volume.grid[shares.grid].cell), 0.0, 1.0);
    }
    return shares;
}

/// The first node of the cell that holds p.
uvec3 cellAt(uint g, vec3 p) {
    return uvec3(clamp((p - volume.grid[g].lower) / volume.grid[g].cell, vec3(0), vec3(volume.grid[g].nodes - 2u)));
}

uvec3 cellCorner(uvec3 cell, uint corner) {
    return cell + uvec3(corner & 1u, corner >> 1 & 1u, corner >> 2);
}

/// Number of a node among those of all grids.
uint nodeIndex(uint g, uvec3 node) {
    const uvec3 nodes = volume.grid[g].nodes;
    return volume.grid[g].first + (node.z * nodes.y + node.y) * nodes.x + node.x;
}

vec3 nodePlace(uint g, uvec3 node) {
    return volume.grid[g].lower + vec3(node) * volume.grid[g].cell;
}
