// SPDX-License-Identifier: MIT
#include "engine/runtime/limn_kept_light.h"
#include "engine/runtime/scene.h"

#include <algorithm>

using namespace limn::runtime;

namespace {

constexpr float kLargest = 32767;

void keepCache(const F4* sh, std::size_t count, float& scale, std::int16_t* values) {
    constexpr float kBlack = 1e-30f;
    float largest = 0;
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k)
            largest = std::max(largest, std::fabs(sh[i][k]));
    const float factor = largest > kBlack ? kLargest / largest : 0;
    scale = factor > 0 ? largest / kLargest : 0;
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k)
            values[3 * i + std::size_t(k)] = std::int16_t(std::nearbyint(sh[i][k] * factor));
}

/// Adds what a slot keeps of a cache, times `colour` in the first `coloured` coefficients and
/// times `grey` in the others.
void addCache(const KeptLight& kept, std::size_t cache, F4 colour, F4 grey, std::size_t coloured,
              std::size_t count, F4* sh) {
    const std::int16_t* v = kept.values + 3 * cache * count;
    const F4 scale = splat(kept.scale[cache]);
    colour *= scale, grey *= scale;
    for (std::size_t i = 0; i < count; ++i, v += 3)
        sh[i] += F4{float(v[0]), float(v[1]), float(v[2]), 0} * (i < coloured ? colour : grey);
}

bool isDark(const float* rgb) {
    return rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0;
}

} // namespace

int limnrt_keep(limnrt_scene* s, uint32_t slot) {
    if (slot >= s->options.max_kept)
        return 0;
    lightResults(*s, false);
    lightResults(*s, true);
    KeptLight& kept = s->kept[slot];
    const std::size_t count = s->coefficients();
    for (std::size_t c = 0; c < s->view.dims.caches; ++c)
        keepCache(s->sh + c * count, count, kept.scale[c], kept.values + 3 * c * count);
    kept.used = true;
    return 1;
}

int limnrt_mix(limnrt_scene* s, const float* rgb, uint32_t count) {
    if (count > s->options.max_kept ||
        (count > 0 && !finiteWithin(rgb, 3 * std::size_t(count), 0, kMaxLight)))
        return 0;
    for (std::size_t k = 0; k < count; ++k)
        if (!s->kept[k].used && !isDark(rgb + 3 * k))
            return 0;
    s->bounceLit = false;
    s->lightmapLit = s->gridLit = count > 0;
    if (count == 0)
        return 1;
    const std::size_t coefficients = s->coefficients(),
                      coloured = std::size_t(s->results.chroma) * s->results.chroma;
    for (std::size_t c = 0; c < s->view.dims.caches; ++c) {
        F4* sh = s->sh + c * coefficients;
        std::fill(sh, sh + coefficients, F4{});
        for (std::size_t k = 0; k < count; ++k) {
            const F4 colour = load3(rgb + 3 * k);
            if (!isDark(rgb + 3 * k))
                addCache(s->kept[k], c, colour, splat(lumaOf(colour)), coloured, coefficients, sh);
        }
    }
    return 1;
}
