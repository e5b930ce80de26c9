// SPDX-License-Identifier: MIT
// Read by C++ and GLSL: constants of reflections that are marched through the maps of probes, so
// that the CPU and shaders give the same light. engine/techniques/probes/marched_maps.h and
// march_ray.h explain them.
#ifndef SHADERS_SHARED_MARCH_LOOKUP_H
#define SHADERS_SHARED_MARCH_LOOKUP_H

// Texels along the side of a block, whose nearest surface is known.
#define MARCH_BLOCK 8
// w of planes: the sky, a surface, the back of a solid.
#define MARCH_SKY 0.0
#define MARCH_SURFACE 1.0
#define MARCH_SOLID 2.0
// The coarsest level of radiance has at most this many texels along its side.
#define MARCH_COARSEST 4
// Rays end at this many times the size of the grid and the distance of their origins from the
// probe: the direction from the probe then differs from that of the ray by less than a texel.
#define MARCH_FAR 4096.0
// Surfaces are this thick, in texels as wide as where the ray is. The paper gives metres.
#define MARCH_THICKNESS 2.0
// The widest spread of a lookup [rad].
#define MARCH_WIDEST 3.0
// Distance from the surface at which rays of the device begin, as a share of the 1-norm of the
// grid's size. It exceeds the rounding errors of positions that are reconstructed from depths.
#define MARCH_OFFSET 1.5e-5
// Half of a bilinear lookup of texels of side 1 lies within this.
#define MARCH_HALF 0.59

#endif
