// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/transport.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/texel_points.h"
#include "engine/math/packing.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"
#include "engine/techniques/sparse_probes/probe_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Direction i of a set in which directions are dense in proportion to their cosine with z.
glm::vec3 cosineDirection(const DirectionSet& set, std::uint32_t i) {
    const glm::vec3 d = set[i]; // z is uniform, so its root has the cosine's distribution
    const float r = std::sqrt((1 - d.z) / std::max(1 - d.z * d.z, 1e-12f));
    return {d.x * r, d.y * r, std::sqrt(d.z)};
}

/// What a receiver sees along a ray: a point of a surface's front, or the sky.
struct Seen {
    bool sky = false;
    glm::vec3 position{0}; ///< clear of the surface
    glm::vec3 normal{0};
    glm::vec3 direction{0}; ///< of the ray
};

/// Whether a probe sees it.
bool sees(const TraceScene& trace, glm::vec3 probe, const Seen& seen) {
    if (seen.sky)
        return !trace.occluded({probe, seen.direction}, TraceMask::Static);
    return glm::dot(probe - seen.position, seen.normal) > 0 &&
           !trace.blocked(seen.position, probe, TraceMask::Static);
}

/// The rows of T of one receiver.
class ReceiverTransport {
public:
    ReceiverTransport(const TraceScene& trace, std::span<const glm::vec3> probes,
                      const TransportOptions& options)
        : m_trace(trace), m_probes(probes), m_options(options),
          m_rows(std::size_t(kProbesPerReceiver * options.bands * options.bands)) {}

    void gather(const AtlasTexel& texel) {
        const Scene& scene = m_trace.scene();
        glm::vec3 middle(0);
        for (std::uint32_t k = 0; k < texel.count; ++k)
            middle += texelPoint(scene, texel, k).position / float(texel.count);
        near = nearestProbes(m_probes, middle);
        std::ranges::fill(m_rows, 0.f);
        m_unseen = 0;
        const DirectionSet set(m_options.rays, false, seedOf(scene, texel));
        for (std::uint32_t ray = 0; ray < m_options.rays; ++ray) {
            const WorldPoint from = texelPoint(scene, texel, ray % texel.count);
            const glm::vec3 d = basisAround(from.normal) * cosineDirection(set, ray);
            const Hit hit = m_trace.closestHit({m_trace.clearOf(from.position, from.normal), d},
                                               TraceMask::Static);
            Seen seen{.sky = !hit, .direction = d};
            if (hit) {
                if (!hit.frontFace && !isTwoSided(scene.materialOf(scene.instances[hit.instance])))
                    continue; // black
                seen.normal = hit.frontFace ? hit.geometricNormal : -hit.geometricNormal;
                seen.position = m_trace.clearOf(hit.position, seen.normal);
            }
            add(seen);
        }
    }
    float unseen() const { return float(m_unseen) / float(m_options.rays); }
    /// T, before its factor of pi / N.
    std::span<const float> rows() const { return m_rows; }

    NearProbes near{};

private:
    /// Credits what is seen to the probes that see it, too.
    void add(const Seen& seen) {
        std::array<float, kProbesPerReceiver> weight = near.weight;
        float sum = 0;
        for (std::uint32_t i = 0; i < kProbesPerReceiver; ++i) {
            if (near.probe[i] == kNoProbe || !(weight[i] > 0))
                weight[i] = 0;
            else if (m_options.visibility && !sees(m_trace, m_probes[near.probe[i]], seen))
                weight[i] = 0;
            sum += weight[i];
        }
        if (!(sum > 0)) {
            ++m_unseen;
            if (!m_options.unchecked)
                return;
            weight = near.weight;
            sum = 0;
            for (const float w : weight)
                sum += w;
            if (!(sum > 0))
                return;
        }
        const auto coefficients = std::size_t(m_options.bands * m_options.bands);
        for (std::uint32_t i = 0; i < kProbesPerReceiver; ++i) {
            if (!(weight[i] > 0))
                continue;
            const glm::vec3 way = seen.position - m_probes[near.probe[i]];
            float y[kMaxCoefficients];
            shBasis(m_options.bands, seen.sky ? seen.direction : glm::normalize(way), y);
            float* row = &m_rows[i * coefficients];
            for (std::size_t c = 0; c < coefficients; ++c)
                row[c] += weight[i] / sum * y[c];
        }
    }

    const TraceScene& m_trace;
    std::span<const glm::vec3> m_probes;
    const TransportOptions& m_options;
    std::vector<float> m_rows;
    std::uint32_t m_unseen = 0;
};

} // namespace

NearProbes nearestProbes(std::span<const glm::vec3> probes, glm::vec3 p) {
    struct Near {
        float distance;
        std::uint32_t probe;
        bool operator<(const Near& o) const {
            return distance != o.distance ? distance < o.distance : probe < o.probe;
        }
    };
    constexpr std::size_t kMost = kProbesPerReceiver + 1;
    std::array<Near, kMost> near{};
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < probes.size(); ++i) {
        const Near next{glm::distance(probes[i], p), i};
        if (count == kMost && !(next < near[count - 1]))
            continue;
        std::size_t slot = count < kMost ? count++ : kMost - 1;
        for (; slot > 0 && next < near[slot - 1]; --slot)
            near[slot] = near[slot - 1];
        near[slot] = next;
    }
    NearProbes result;
    result.probe.fill(kNoProbe);
    result.weight.fill(0);
    if (count == 0)
        return result;
    // Without a further probe the last one must keep some weight.
    const float last = near[count - 1].distance;
    float radius = count == kMost ? last : 1.25f * last;
    if (!(radius > near[0].distance)) // all are as far as the nearest
        radius = 2 * near[0].distance;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, kProbesPerReceiver); ++i) {
        result.probe[i] = std::uint16_t(near[i].probe);
        result.weight[i] = radius > 0 ? probeFalloff(near[i].distance / radius) : 1;
    }
    return result;
}

Transport traceTransport(const TraceScene& trace, std::span<const AtlasTexel> texels,
                         std::span<const glm::vec3> probes, const TransportOptions& options,
                         const Progress& progress) {
    const auto row = std::size_t(kProbesPerReceiver) * std::size_t(options.bands * options.bands);
    Transport transport;
    transport.probe.assign(texels.size() * kProbesPerReceiver, kNoProbe);
    transport.coefficients.assign(texels.size() * row, 0);
    transport.unseen.assign(texels.size(), 0);
    parallelRanges(
        texels.size(), 8, progress, "transport", [&](std::size_t begin, std::size_t end) {
            ReceiverTransport one(trace, probes, options);
            for (std::size_t r = begin; r < end; ++r) {
                one.gather(texels[r]);
                std::ranges::copy(one.near.probe, &transport.probe[r * kProbesPerReceiver]);
                for (std::size_t c = 0; c < row; ++c)
                    transport.coefficients[r * row + c] = floatToHalf(
                        one.rows()[c] * std::numbers::pi_v<float> / float(options.rays));
                transport.unseen[r] = one.unseen();
            }
        });
    return transport;
}

} // namespace limn
