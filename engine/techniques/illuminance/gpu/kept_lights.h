// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/render/shadowed_lights.h"

#include <cstdint>
#include <vector>

namespace limn {

/// What each light brings the surfels for each unit of its colour and strength, shadow included,
/// kept on the GPU: a light that changes nothing else, or stays as it is, is not worked out again.
class KeptLights {
public:
    /// Of this array, all lights together; those behind are worked out each time [bytes].
    static constexpr VkDeviceSize kMaxBytes = 64 << 20;

    /// The device outlives this.
    KeptLights(gpu::Device& device, std::size_t surfels) : m_device(device), m_surfels(surfels) {}

    /// Finds a place for each of `lights`. Nothing submitted reads the buffers.
    void assign(const ShadowedLights& lights);

    std::uint32_t kept = 0;  ///< lights with a place: the first of the list
    std::uint32_t fresh = 0; ///< of those, lights that are to be worked out
    gpu::Buffer unit;        ///< a float for each place and surfel
    gpu::Buffer places;      ///< mapped: of each kept light its place; then which lights are fresh

private:
    struct Place {
        std::uint64_t shape = 0; ///< as ShadowedLights::shapes
        bool taken = false;
    };
    void makeRoom(std::uint32_t lights);

    gpu::Device& m_device;
    std::size_t m_surfels;
    std::uint64_t m_casters = 0; ///< as ShadowedLights::casters
    std::vector<Place> m_places;
};

} // namespace limn
