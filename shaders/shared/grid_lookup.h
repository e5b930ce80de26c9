// SPDX-License-Identifier: MIT
// Read by C++ and GLSL: constants of lookups in the grid of harmonics, so that the CPU and shaders
// give the same light. engine/field/grid_depth.h explains the cells' maps of depths.
#ifndef SHADERS_SHARED_GRID_LOOKUP_H
#define SHADERS_SHARED_GRID_LOOKUP_H

// Texels of a cell's map of depths, per axis.
#define GRID_DEPTH_SIDE 16
// The smallest depth that a map can hold is the grid's reach over this.
#define GRID_DEPTH_SCALE 64.0
// Visibility at x times the depth is (GRID_HIDDEN - x) * GRID_FALLOFF, within [0, 1]: 1 up to 1.05
// times the depth, 0 from 1.15 times on.
#define GRID_HIDDEN 1.15
#define GRID_FALLOFF 10.0
// Added to each cell's visibility. If none of the eight cells sees the point, all count as if they
// did.
#define GRID_UNSEEN 1e-5
// Offset of a point along its normal, relative to a cell's shortest side, so that a surface does
// not occlude itself.
#define GRID_DEPTH_BIAS 0.01

#endif
