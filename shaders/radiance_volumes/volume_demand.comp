// SPDX-License-Identifier: MIT
// Asks for caches at the nodes about what each pixel of a camera's picture shows, and sums the surfaces there. As
// allocateForView() of engine/techniques/radiance_volumes/allocation.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/volume_picture.glsl"

layout(local_size_x = VOLUME_MAP_LANES, local_size_y = VOLUME_MAP_LANES) in;

layout(std430, binding = VOLUME_DEMAND_SUMS) buffer Sums { GpuPlaceSums sums[]; };

/// The cells of a pixel in up to two grids.
struct PixelCells {
    uint count;
    uint grid[2];
    uvec3 cell[2];
};

PixelCells cellsOf(vec3 p) {
    const GridShares shares = gridShares(p);
    PixelCells cells;
    cells.count = 0u;
    for (uint k = 0u; k < 2u; ++k)
        if ((k == 0u ? shares.weight : 1.0 - shares.weight) > 0.0) {
            cells.grid[cells.count] = shares.grid + k;
            cells.cell[cells.count++] = cellAt(shares.grid + k, p);
        }
    return cells;
}

void add(uint g, uvec3 node, vec3 p, vec3 normal) {
    const uint i = nodeIndex(g, node);
    const ivec3 n = ivec3(round(normal * VOLUME_PLACE_UNIT));
    const float height = dot(nodePlace(g, node) - p, normal) / volume.grid[g].cell;
    atomicAdd(sums[i].surfaces, 1);
    atomicAdd(sums[i].x, n.x);
    atomicAdd(sums[i].y, n.y);
    atomicAdd(sums[i].z, n.z);
    const ivec3 shift = ivec3(round((p - nodePlace(g, node)) / volume.grid[g].cell * VOLUME_PLACE_UNIT));
    atomicAdd(sums[i].shiftX, shift.x);
    atomicAdd(sums[i].shiftY, shift.y);
    atomicAdd(sums[i].shiftZ, shift.z);
    atomicAdd(sums[i].height, int(round(height * VOLUME_PLACE_UNIT)));
}

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    vec3 p, normal, leftPlace, leftNormal;
    if (any(greaterThanEqual(pixel, uvec2(picture.width, picture.height))) || !surfaceAt(pixel, p, normal))
        return;
    const PixelCells cells = cellsOf(aboveSurface(p, normal));
    PixelCells before;
    before.count = 0u;
    if (pixel.x > 0u && surfaceAt(pixel - uvec2(1, 0), leftPlace, leftNormal))
        before = cellsOf(aboveSurface(leftPlace, leftNormal));
    for (uint k = 0u; k < cells.count; ++k) {
        bool counted = false; // by the pixel to the left
        for (uint j = 0u; j < before.count; ++j)
            counted = counted || (before.grid[j] == cells.grid[k] && before.cell[j] == cells.cell[k]);
        for (uint corner = 0u; corner < 8u && !counted; ++corner)
            add(cells.grid[k], cellCorner(cells.cell[k], corner), p, normal);
    }
}
