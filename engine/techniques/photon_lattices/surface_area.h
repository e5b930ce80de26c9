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

/// Sums over an instance's surface, if it stores photons, in the order of the cells; cells without
/// any are left out. Triangles are clipped to the cells. Each side that reflects counts; the holes
/// of a cutout do not, by the middle of each clipped piece.
std::vector<CellArea> surfaceAreas(const Scene& scene, std::uint32_t instance,
                                   const Lattice& lattice);

/// The areas of a scene in its three lattices, kept from one update to the next. Instances that
/// move are taken out of the sums and added again; the sum of all static ones is kept apart, so
/// that a dynamic object costs little.
class PhotonAreas {
public:
    /// Brings the areas up to date. Returns whether anything changed.
    bool follow(const Scene& scene, const PhotonLattices& lattices);

    /// In the order of the cells.
    const std::vector<CellArea>& of(std::size_t lattice) const {
        return m_dynamic ? m_sums[lattice] : m_static[lattice];
    }

    std::uint64_t bytes() const;
    /// Number of instances that the last follow() clipped.
    std::uint32_t clipped() const { return m_clipped; }

private:
    using Areas = std::array<std::vector<CellArea>, kPhotonLattices>;
    /// What the area of an instance depends on.
    struct Placed {
        std::uint32_t mesh;
        bool dynamic, stores, twoSided;
        /// Of a cutout's holes.
        float alpha, cutoff;
        TextureRef texture;
        glm::mat4 toWorld;
        bool operator==(const Placed&) const = default;
    };
    struct Kept {
        Placed placed;
        std::shared_ptr<const Areas> areas;
    };

    static Placed placedOf(const Scene& scene, std::uint32_t instance);
    std::vector<std::uint32_t> keep(const Scene& scene, bool& staticChanged);
    void sum(bool staticChanged);

    std::shared_ptr<const Assets> m_assets;
    PhotonLattices m_lattices;
    std::vector<Kept> m_instances; ///< as Scene::instances
    Areas m_static, m_sums;        ///< of static instances; of all, where some are dynamic
    bool m_dynamic = false;
    std::uint32_t m_clipped = 0;
};

} // namespace limn
