// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/render/shadowed_lights.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Stores on the GPU the irradiance that each light brings to some points per unit of its colour
/// and strength, shadow included. A light is not recomputed unless something else about it changes.
class KeptLights {
public:
    /// Maximum size of this array for all lights together [bytes]. Lights beyond it are recomputed
    /// each time.
    static constexpr VkDeviceSize kMaxBytes = 64 << 20;

    /// The device must outlive the object.
    KeptLights(gpu::Device& device, std::size_t points) : m_device(device), m_points(points) {}

    /// Finds a place for each of `lights`. No submitted work may be reading the buffers.
    void assign(const ShadowedLights& lights);

    /// Frees all places: what is kept is of points that have moved.
    void forget();

    std::uint32_t kept = 0;  ///< number of lights with a place: the first of the list
    std::uint32_t fresh = 0; ///< number of those that are to be computed
    gpu::Buffer unit;        ///< one float for each place and point
    gpu::Buffer places; ///< mapped: the place of each kept light, then the list of fresh lights

private:
    struct Place {
        std::uint64_t shape = 0; ///< as ShadowedLights::shapes
        bool taken = false;
    };
    void makeRoom(std::uint32_t lights);

    gpu::Device& m_device;
    std::size_t m_points;
    std::uint64_t m_casters = 0; ///< as ShadowedLights::casters
    std::vector<Place> m_places;
};

} // namespace limn
