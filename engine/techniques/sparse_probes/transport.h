// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/atlas.h"
#include "engine/trace/trace_scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

inline constexpr std::uint32_t kProbesPerReceiver = 8;
inline constexpr std::uint16_t kNoProbe = 0xffff;

/// The probes nearest to a point and their weights.
struct NearProbes {
    std::array<std::uint16_t, kProbesPerReceiver> probe; ///< nearest first; kNoProbe: no more
    std::array<float, kProbesPerReceiver> weight;        ///< probeFalloff(), >= 0
};
/// The radius of the weights is the distance to the next probe after these, or 1.25 times that to
/// the last where there is none. The sum of the weights is > 0 if there is any probe.
NearProbes nearestProbes(std::span<const glm::vec3> probes, glm::vec3 p);

/// How the light of probes becomes irradiance at some receivers.
struct Transport {
    std::vector<std::uint16_t> probe; ///< kProbesPerReceiver per receiver
    /// T as halfs: bands^2 per receiver and probe. E = sum of T_lm P_lm over probes and l, m.
    std::vector<std::uint16_t> coefficients;
    /// Per receiver: cosine-weighted share of its view that none of its probes sees.
    std::vector<float> unseen;

    bool operator==(const Transport&) const = default;
};

struct TransportOptions {
    int bands = 4;
    std::uint32_t rays = 256; ///< N, from each receiver
    /// What none of a receiver's probes sees is taken from all of them, as if they did.
    bool unchecked = false;
    /// Whether probes count by what they see of a receiver's view. Without it light leaks through
    /// walls: for comparison only.
    bool visibility = true;
};

/// Transport to the receivers of `texels`. For N cosine-distributed rays from the texel's points,
/// which meet surfaces, or the sky, at h,
///   T_{i,lm} = (pi / N) sum over rays of V_i w_i / (sum_k V_k w_k) Y_lm(direction from p_i to h),
/// V_i: whether probe i sees the front of h. Incomplete when cancelled. Silvennoinen, Lehtinen.
/// Real-time Global Illumination by Precomputed Local Reconstruction from Sparse Radiance Probes.
/// 2017
Transport traceTransport(const TraceScene& trace, std::span<const AtlasTexel> texels,
                         std::span<const glm::vec3> probes, const TransportOptions& options,
                         const Progress& progress = {});

} // namespace limn
