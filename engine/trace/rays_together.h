// SPDX-License-Identifier: MIT
#pragma once

#include "engine/trace/ray_packet.h"

namespace limn {

/// Collects rays and traces them as many at once as a packet holds, in their order. Each carries a
/// `What`, which tells what it is for. Rays that follow each other should run alike.
template <class What>
class RaysTogether {
public:
    /// Keeps a reference to `trace`.
    RaysTogether(const TraceScene& trace, TraceMask mask) : m_trace(trace), m_mask(mask) {}

    /// Adds a ray. Calls open(what) for those that turn out not to be occluded, here or in flush().
    template <class Open>
    void add(const Ray& ray, const What& what, const Open& open) {
        m_rays.set(m_count, ray);
        m_what[m_count] = what;
        if (++m_count == RayPacket::kSize)
            flush(open);
    }

    /// Traces the rays that wait.
    template <class Open>
    void flush(const Open& open) {
        const std::uint32_t hidden = m_trace.occludedTogether(m_rays, m_count, m_mask);
        for (std::size_t k = 0; k < m_count; ++k)
            if ((hidden >> k & 1) == 0)
                open(m_what[k]);
        m_traced += m_count;
        m_count = 0;
    }

    std::uint64_t traced() const { return m_traced; } ///< number of rays so far

private:
    const TraceScene& m_trace;
    TraceMask m_mask;
    std::size_t m_count = 0; ///< rays that wait
    std::uint64_t m_traced = 0;
    RayPacket m_rays;
    std::array<What, RayPacket::kSize> m_what;
};

} // namespace limn
