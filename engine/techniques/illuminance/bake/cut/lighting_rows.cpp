// SPDX-License-Identifier: MIT
// Compiled once for each kind of vector unit; the best one is chosen when the program runs. All of
// them add in the same order, without fused multiply-add, so that a bake does not depend on the
// machine.
#include "engine/techniques/illuminance/bake/cut/lighting_rows.h"

#include "engine/core/vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/techniques/illuminance/bake/cut/lighting_rows.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limn {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 8>;
using V = hn::Vec<Floats>;
constexpr std::size_t kLanes = hn::MaxLanes(Floats());
constexpr std::size_t kSums = 8; ///< that errors are summed in
constexpr std::size_t kLightings = TrainingLight::kCount;
static_assert(kLightings % kSums == 0 && kSums % kLanes == 0);

void sumReceived(const float* radiosity, const std::uint32_t* node, const FormFactor* formFactor,
                 std::size_t count, float* out) {
    constexpr std::size_t kAhead = 4, kPerLine = 64 / sizeof(float);
    const Floats d;
    V sums[kLightings / kLanes];
    for (V& s : sums)
        s = hn::Zero(d);
    for (std::size_t i = 0; i < count; ++i) {
        if (i + kAhead < count) // the rows lie far apart in memory
            for (std::size_t t = 0; t < kLightings; t += kPerLine)
                hwy::Prefetch(radiosity + node[i + kAhead] * kLightings + t);
        const float* row = radiosity + node[i] * kLightings;
        const V factor = hn::Set(d, formFactor[i].irradiance);
        for (std::size_t k = 0; k < kLightings / kLanes; ++k)
            sums[k] = hn::Add(sums[k], hn::Mul(factor, hn::LoadU(d, row + k * kLanes)));
    }
    for (std::size_t k = 0; k < kLightings / kLanes; ++k)
        hn::StoreU(sums[k], d, out + k * kLanes);
}

std::array<float, kLinkCandidates>
compareLinks(const Received& left, const Received& right, float formFactor,
             const std::array<const float*, kLinkCandidates>& candidates, const float* weight,
             float* contribution) {
    constexpr std::size_t kVectors = kSums / kLanes;
    const Floats d;
    const V leftFactor = hn::Set(d, left.formFactor), rightFactor = hn::Set(d, right.formFactor),
            all = hn::Set(d, formFactor);
    V sums[kLinkCandidates][kVectors];
    for (auto& s : sums)
        for (V& v : s)
            v = hn::Zero(d);
    for (std::size_t t = 0; t < kLightings; t += kSums)
        for (std::size_t k = 0; k < kVectors; ++k) {
            const std::size_t first = t + k * kLanes;
            const V b = hn::Add(hn::Mul(leftFactor, hn::LoadU(d, left.radiosity + first)),
                                hn::Mul(rightFactor, hn::LoadU(d, right.radiosity + first)));
            const V w = hn::LoadU(d, weight + first);
            hn::StoreU(b, d, contribution + first);
            for (std::size_t c = 0; c < kLinkCandidates; ++c) {
                const V off = hn::Sub(b, hn::Mul(all, hn::LoadU(d, candidates[c] + first)));
                sums[c][k] = hn::Add(sums[c][k], hn::Mul(hn::Mul(off, off), w));
            }
        }
    std::array<float, kLinkCandidates> errors{};
    for (std::size_t c = 0; c < kLinkCandidates; ++c) {
        float parts[kSums];
        for (std::size_t k = 0; k < kVectors; ++k)
            hn::StoreU(sums[c][k], d, parts + k * kLanes);
        for (const float part : parts)
            errors[c] += part;
        errors[c] /= kLightings;
    }
    return errors;
}

} // namespace HWY_NAMESPACE
} // namespace limn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(sumReceived);
HWY_EXPORT(compareLinks);

LightingRow receivedFrom(const TrainingLight& training, std::span<const std::uint32_t> node,
                         std::span<const FormFactor> formFactor) {
    LightingRow sum;
    HWY_DYNAMIC_DISPATCH(sumReceived)
    (training.radiosity.data(), node.data(), formFactor.data(), node.size(), sum.data());
    return sum;
}

std::array<float, kLinkCandidates>
linkErrors(const Received& left, const Received& right, float formFactor,
           const std::array<const float*, kLinkCandidates>& candidates, const float* weight,
           float* contribution) {
    return HWY_DYNAMIC_DISPATCH(compareLinks)(left, right, formFactor, candidates, weight,
                                              contribution);
}

} // namespace limn
#endif
