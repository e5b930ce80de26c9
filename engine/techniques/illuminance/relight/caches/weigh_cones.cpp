// SPDX-License-Identifier: MIT
// Compiled once for each kind of vector unit; the best one is chosen when the program runs.
#include "engine/techniques/illuminance/relight/caches/weigh_links.h"

#include "engine/core/vector_targets.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/techniques/illuminance/relight/caches/weigh_cones.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/techniques/illuminance/relight/caches/cone_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace limn {
namespace HWY_NAMESPACE {

/// `weights`: three colours of each coefficient, with the constants that basisOf() omits.
template <int Bands>
HWY_INLINE void weighLanes(const Link* links, std::size_t count, const float* weights,
                           glm::vec3* nodes) {
    const Floats d;
    Cones<Bands> cones;
    readCones(d, links, cones);
    V sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    basisOf<Bands>(d, cones.x, cones.y, cones.z, cones.factor, [&](auto i, V basis) LIMN_UNROLLED {
        unrolled<0, 3>([&](auto k) LIMN_UNROLLED {
            sum[k] = hn::MulAdd(basis, hn::Set(d, weights[3 * i + k]), sum[k]);
        });
    });
    alignas(HWY_MAX_BYTES) float out[3][hn::MaxLanes(Floats())];
    for (int k = 0; k < 3; ++k)
        hn::Store(sum[k], d, out[k]);
    for (std::size_t n = 0; n < count; ++n)
        nodes[links[n].node] += glm::vec3(out[0][n], out[1][n], out[2][n]);
}

template <int Bands>
void weighBands(const Link* links, std::size_t count, const float* weights, glm::vec3* nodes) {
    constexpr std::size_t kLanes = hn::MaxLanes(Floats());
    std::size_t k = 0;
    for (; k + kLanes <= count; k += kLanes)
        weighLanes<Bands>(links + k, kLanes, weights, nodes);
    if (k == count)
        return;
    Link last[kLanes] = {};
    std::copy(links + k, links + count, last);
    weighLanes<Bands>(last, count - k, weights, nodes);
}

void weighCones(const Link* links, std::size_t count, const glm::vec3* weights, int bands,
                float scale, glm::vec3* nodes) {
    float scaled[3 * kIrradianceBands * kIrradianceBands];
    for (int i = 0; i < bands * bands; ++i)
        for (int k = 0; k < 3; ++k)
            scaled[3 * i + k] = weights[i][k] * (kMonicScale[std::size_t(i)] * scale);
    if (bands == 2)
        weighBands<2>(links, count, scaled, nodes);
    else
        weighBands<kIrradianceBands>(links, count, scaled, nodes);
}

} // namespace HWY_NAMESPACE
} // namespace limn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(weighCones);

void weighCones(const Caches& caches, LinkEnds ends, std::uint32_t cache,
                std::span<const glm::vec3> weights, std::span<glm::vec3> nodes) {
    const std::uint32_t begin = caches.linkBegin[cache];
    HWY_DYNAMIC_DISPATCH(weighCones)
    (caches.links.data() + begin, ends[cache] - begin, weights.data(), weights.size() == 4 ? 2 : 3,
     linkScale(caches, cache), nodes.data());
}

} // namespace limn
#endif
