// SPDX-License-Identifier: MIT
#pragma once

#include "engine/trace/trace_scene.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace limn {

/// Rays that are traced together, in the layout of Embree's packets: an array for each number.
struct RayPacket {
    static constexpr std::size_t kSize = 8;
    template <class T>
    using Lanes = std::array<T, kSize>;

    alignas(32) Lanes<float> originX{}, originY{}, originZ{}, tNear{}, directionX{}, directionY{},
        directionZ{};
    Lanes<float> time{};
    Lanes<float> tFar{}; ///< overwritten for rays that meet something
    Lanes<std::uint32_t> mask{}, id{}, flags{};

    RayPacket() { mask.fill(~0U); }

    void set(std::size_t lane, const Ray& ray) {
        originX[lane] = ray.origin.x;
        originY[lane] = ray.origin.y;
        originZ[lane] = ray.origin.z;
        tNear[lane] = ray.tNear;
        directionX[lane] = ray.direction.x;
        directionY[lane] = ray.direction.y;
        directionZ[lane] = ray.direction.z;
        tFar[lane] = ray.tFar;
    }
    Ray ray(std::size_t lane) const {
        return {{originX[lane], originY[lane], originZ[lane]},
                {directionX[lane], directionY[lane], directionZ[lane]},
                tNear[lane],
                tFar[lane]};
    }
};

} // namespace limn
