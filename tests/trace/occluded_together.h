// SPDX-License-Identifier: MIT
#pragma once

#include "engine/trace/ray_packet.h"

#include <span>

namespace limn {

/// TraceScene::occludedTogether() of rays in one packet.
inline std::uint32_t occludedTogether(const TraceScene& trace, std::span<const Ray> rays,
                                      TraceMask mask = TraceMask::All) {
    RayPacket packet;
    for (std::size_t k = 0; k < rays.size(); ++k)
        packet.set(k, rays[k]);
    return trace.occludedTogether(packet, rays.size(), mask);
}

} // namespace limn
