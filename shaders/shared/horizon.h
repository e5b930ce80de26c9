// SPDX-License-Identifier: MIT
// Read by C++ and GLSL: the numbers that engine/math/horizon.h explains.
#ifndef SHADERS_SHARED_HORIZON_H
#define SHADERS_SHARED_HORIZON_H

#define HORIZON_C0 1.41047396   // 5 / (2 sqrt(pi))
#define HORIZON_C1 -0.977205024 // -sqrt(3 / pi)
#define BELOW_C0 1.77245385     // sqrt(pi)
#define BELOW_C1 1.53499006     // sqrt(3 pi) / 2
#define HORIZON_GAIN 5.0

#endif
