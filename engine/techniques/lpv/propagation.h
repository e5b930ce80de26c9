// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lattice/cell_lobes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Places of cells in arrays of floats: a border of one cell on each side holds the surroundings,
/// and rows are long enough for whole vectors.
struct PaddedCells {
    glm::uvec3 size{0}; ///< cells without the border

    static constexpr std::size_t kLanes = 4;
    std::size_t row() const { return (size.x + kLanes - 1) / kLanes * kLanes + 2; }
    std::size_t slice() const { return row() * (size.y + 2); }
    std::size_t count() const { return slice() * (size.z + 2); }
    std::size_t stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? row() : slice(); }
    /// Of a cell; also of the border, where a coordinate is -1 or the size.
    std::size_t at(glm::ivec3 c) const {
        return std::size_t(c.z + 1) * slice() + std::size_t(c.y + 1) * row() + std::size_t(c.x + 1);
    }
};

/// Intensity [W sr^-1] that leaves each cell: harmonic i of colour c is plane[3 i + c].
struct CellLight {
    PaddedCells cells;
    std::array<std::vector<float>, 12> plane;

    explicit CellLight(glm::uvec3 size);
    Lobe lobe(glm::ivec3 c) const;
    void add(glm::ivec3 c, const Lobe& lobe);
};

/// Share of the light that surfaces block between two cells, as a function of where the light
/// comes from: harmonic i at the face between cell c and the one before it along axis a is
/// axis[a][i][cells.at(c)].
struct FaceBlockers {
    PaddedCells cells;
    std::array<std::array<std::vector<float>, 4>, 3> axis;

    explicit FaceBlockers(glm::uvec3 size);
};

/// Solid angles in which the middle of a cubic cell sees the face opposite to it of the next cell,
/// and a face of that cell at its side [sr]. Six times the first and 24 times the second are 4 pi.
inline constexpr float kFrontSolidAngle = 0.40066968f, kSideSolidAngle = 0.42343136f;

/// Propagates once: each cell of `to` is set to what its six neighbours send to its five far faces,
/// and leaves them again as lobes about the faces' normals. Light that comes from `from`'s border
/// enters; none leaves into the border. `blockers`: null in the open. Intensity is clamped to 0
/// where two bands make it negative. Kaplanyan, Dachsbacher. Cascaded Light Propagation Volumes for
/// Real-Time Indirect Illumination. 2010
void propagateOnce(const CellLight& from, const FaceBlockers* blockers, CellLight& to);

/// Sum of what was injected and of the light of `rounds` rounds. The first one ignores blockers,
/// since the light starts half a cell from its surface. Incomplete when cancelled.
CellLight propagate(const CellLight& injected, const FaceBlockers* blockers, std::uint32_t rounds,
                    const Progress& progress = {});

} // namespace limn
