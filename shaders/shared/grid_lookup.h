// SPDX-License-Identifier: MIT
// Read by C++ and GLSL: constants of lookups in the grid of harmonics, so that the CPU and shaders
// give the same light. engine/field/grid_depth.h and grid_moments.h explain the cells' maps.
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

// How cells are weighted besides trilinearly: not at all, by depths (grid_depth.h), or by moments
// of distances (grid_moments.h), with either kind of weights.
#define GRID_PLAIN 0u
#define GRID_DEPTHS 1u
#define GRID_MOMENTS 2u
#define GRID_SMOOTH_MOMENTS 3u
// Moments: the smallest factor of the angle to the cell, and the smallest product of it and the
// visibility.
#define MOMENTS_LEAST_FACING 0.05
#define MOMENTS_LEAST_WEIGHT 0.0002
// Smooth moments: the factor's offset, the smallest product, and the product below which it falls
// with its third power.
#define MOMENTS_WRAP 0.2
#define MOMENTS_SMOOTH_LEAST 1e-6
#define MOMENTS_CRUSHED 0.2

#endif
