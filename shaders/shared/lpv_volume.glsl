// SPDX-License-Identifier: MIT
// Where a cell of a lattice of `size` cells lies in a volume, which has a border of one cell on each side.

/// Distances between neighbours along x, y and z.
uvec3 volumeStrides(uvec3 size) {
    return uvec3(1u, size.x + 2u, (size.x + 2u) * (size.y + 2u));
}

/// Number of cells, border included.
uint volumeCells(uvec3 size) {
    return volumeStrides(size).z * (size.z + 2u);
}

uint volumeIndex(uvec3 size, uvec3 cell) {
    const uvec3 at = (cell + 1u) * volumeStrides(size);
    return at.x + at.y + at.z;
}
