// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/bake_defect.h"

#include "engine/math/packing.h"
#include "engine/stages/chunk_file.h"
#include "engine/techniques/illuminance/format/bake_fields.h"

#include <cmath>

namespace limn {

bool linksAreBounded(const Caches& c, std::uint32_t bands) {
    constexpr float kMaxTransport = 1024;
    constexpr int kLargest = 0x7bff; // half; beyond it are infinity and NaN
    const auto magnitude = [](std::uint16_t half) { return half & 0x7fff; };
    const std::size_t coefficients = std::size_t(bands) * bands;
    for (std::size_t cache = 0; cache < c.size(); ++cache) {
        const float scaled = std::ldexp(kMaxTransport, c.linkExponent[cache]);
        const int maxTransport = scaled < 65504 ? floatToHalf(scaled) : kLargest;
        for (std::size_t k = c.linkBegin[cache]; k < c.linkBegin[cache + 1]; ++k) {
            if (c.shNode.empty()) {
                if (magnitude(c.links[k].u) > kLargest ||
                    magnitude(c.links[k].transport) > maxTransport)
                    return false;
                continue;
            }
            for (std::size_t i = k * coefficients; i < (k + 1) * coefficients; ++i)
                if (magnitude(c.shCoefficients[i]) > maxTransport)
                    return false;
        }
    }
    return true;
}

bool placesAreCaches(const Caches& c, std::uint64_t texels, std::uint64_t cells) {
    if (c.size() - c.lightmapCount != cells)
        return false;
    std::vector<bool> taken(texels);
    for (std::size_t i = 0; i < c.lightmapCount; ++i) {
        if (c.texel[i] >= texels || taken[c.texel[i]])
            return false;
        taken[c.texel[i]] = true;
    }
    for (std::size_t i = 0; i < cells; ++i)
        if (c.texel[c.lightmapCount + i] != i)
            return false;
    return true;
}

std::string bakeDefect(const Bake& bake, const Scene* scene) {
    return chunksDefect(bake, [scene](const auto& visit) { forBakeChunks(scene, visit); });
}

} // namespace limn
