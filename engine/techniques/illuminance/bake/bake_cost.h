// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <string_view>

namespace limn {

/// Quantities on which the duration and the memory of a bake and the time of relighting depend.
struct BakeWork {
    double triangles = 0; ///< of the scene
    double surfels = 0;
    double texels = 0;     ///< caches of the lightmap
    double lampTexels = 0; ///< texels of bakes that refine them near lamps, else 0
    double grid = 0;       ///< caches of the grid
    double rays = 0;       ///< of a cache
    double leaves = 0;     ///< senders that a cache sees, as its rays find them
    double links = 0;      ///< of all caches
    double bands = 0;      ///< of the bake that surfaces of the scene need
    double chroma = 0;     ///< of those, with colour
    double bytes = 0;      ///< BakeBytes::total()

    double caches() const { return texels + grid; }
    // Quantity by quantity; the quotient is 1 where the divisor is 0.
    BakeWork operator*(const BakeWork& factor) const;
    BakeWork operator/(const BakeWork& divisor) const;
};

/// Work of a bake of the scene, as predictBake() expects it.
BakeWork expectedWork(const Scene& scene);

/// The same with the counts of the bake that was made of it.
BakeWork workOf(const Bake& bake, BakeWork expected);

/// Duration of a stage of bake(), up to a factor that depends on scene and machine. Stages without
/// a model of their own count as work in proportion to the surfels.
double stageWork(std::string_view stage, const BakeWork& work);

/// The same for a step of an update of one bounce on the CPU, by LightingStep::id.
double updateWork(std::string_view step, const BakeWork& work);

} // namespace limn
