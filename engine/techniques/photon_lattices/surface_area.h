// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lattice/lattice.h"
#include "engine/scene/scene.h"
#include "engine/techniques/photon_lattices/photon_injection.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>

namespace limn {

/// facingHarmonics() of the surface in a cell, times its area [m^2].
struct CellArea {
    std::uint32_t cell;
    std::array<float, 4> harmonics{};
    bool operator==(const CellArea&) const = default;
};

/// Whether photons are stored on surfaces of the material: whether it reflects any diffusely.
bool storesPhotons(const Material& material);

/// Sums over those surfaces of the instances that store photons, in the order of the cells; cells
/// without any are left out. Triangles are clipped to the cells. Each side that reflects counts;
/// the holes of a cutout do not, by the middle of each clipped piece.
std::vector<CellArea> surfaceAreas(const Scene& scene, std::span<const std::uint32_t> instances,
                                   const Lattice& lattice);

/// The areas of a scene in its three lattices, kept from one update to the next. A dynamic object
/// that moves is taken out of the sums and added again.
class PhotonAreas {
public:
    /// Brings the areas up to date. Returns whether anything changed.
    bool follow(const Scene& scene, const PhotonLattices& lattices);

    /// In the order of the cells.
    const std::vector<CellArea>& of(std::size_t lattice) const {
        return m_parts.size() == 1 ? m_parts[0].areas[lattice] : m_sums[lattice];
    }

    std::uint64_t bytes() const;
    /// Number of parts that the last follow() clipped: dynamic objects, and all others together.
    std::uint32_t clipped() const { return m_clipped; }

private:
    /// What the area of an instance depends on.
    struct Placed {
        std::uint32_t mesh;
        bool stores, twoSided;
        /// Of a cutout's holes.
        float alpha, cutoff;
        TextureRef texture;
        glm::mat4 toWorld;
        bool operator==(const Placed&) const = default;
    };
    /// A dynamic instance, or all others.
    struct Part {
        std::vector<std::uint32_t> instances; ///< indices into Scene::instances
        std::vector<Placed> placed;
        std::array<std::vector<CellArea>, kPhotonLattices> areas;
    };

    static Placed placedOf(const Scene& scene, std::uint32_t instance);

    std::shared_ptr<const Assets> m_assets;
    PhotonLattices m_lattices;
    std::vector<Part> m_parts{1};
    std::array<std::vector<CellArea>, kPhotonLattices> m_sums; ///< of several parts
    std::uint32_t m_clipped = 0;
};

} // namespace limn
