// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/rsm/reflective_shadow_map.h"
#include "engine/trace/trace_scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A texel of some level of a reflective shadow map: the sums of its texels of level 0.
struct RsmLevelTexel {
    glm::vec3 flux{0};   ///< reflected, of a light of colour 1 and strength 1, in RsmTexel's unit
    glm::vec3 normal{0}; ///< sum of unit normals
    float area = 0;      ///< across the beam [m^2]
    float distance = 0, squares = 0; ///< sums of distances [m] and of their squares
    float count = 0;                 ///< texels that reflect anything
};

/// One level of a view, row by row.
struct RsmLevel {
    std::uint32_t side = 1;
    std::vector<RsmLevelTexel> texels;
};

/// The levels of one view, the full one first, each with half the side of the one before, down to
/// one texel. Distances are measured from the view's origin, for parallel rays along them. `texels`
/// are those of that view. Precondition: view.size is a power of two.
std::vector<RsmLevel> rsmLevels(const RsmView& view, std::span<const RsmTexel> texels);

/// Virtual area lights that share the shadow of one cone.
struct AreaLightBlock {
    std::uint32_t begin = 0, end = 0; ///< in AreaLights
    glm::vec3 place{0};               ///< mean of their places
    glm::vec3 normal{0};              ///< mean of their normals, unit
    /// Width at a distance of 1 from the light, or, if larger, two standard deviations of the
    /// distances over their mean; where the light's rays are `parallel`, in [m] instead.
    float width = 0;
    bool parallel = false;
};

/// What a light lights, as small surfaces that reflect it. The light has colour 1 and strength 1.
struct AreaLights {
    Light shape;                        ///< unitLight()
    std::vector<float> x, y, z;         ///< places
    std::vector<float> nx, ny, nz;      ///< unit normals
    std::vector<float> disc;            ///< area across the light's beam over pi [m^2]
    std::vector<glm::vec3> flux;        ///< reflected, in RsmTexel's unit
    std::vector<AreaLightBlock> blocks; ///< in order, none empty

    /// The flux of an area light that comes from one instance.
    struct Share {
        std::uint32_t light, instance;
        glm::vec3 flux;
    };
    std::vector<Share> shares; ///< by light, then by instance
    std::uint64_t rays = 0;    ///< traced for the map

    std::size_t count() const { return x.size(); }
    std::size_t bytes() const;
};

struct AreaLightOptions {
    std::uint32_t map = 128; ///< texels along a side of a view, a power of two
    std::uint32_t read = 32; ///< area lights along a side, if there were one view
    std::uint32_t level = 2; ///< a block has 2^level along a side
};

/// Side of the level that is read of each of `views` views of `side` texels: the power of two
/// nearest to read / sqrt(views), so that all of them have about read^2 texels.
std::uint32_t sideRead(std::uint32_t read, std::size_t views, std::uint32_t side);

/// Casts the light's map and reads its area lights. Incomplete when cancelled.
AreaLights areaLightsOf(const TraceScene& trace, const Scene& scene, const Light& light,
                        const AreaLightOptions& options, const Progress& progress = {});

} // namespace limn
