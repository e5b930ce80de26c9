// SPDX-License-Identifier: MIT
#include "engine/scene/exposure.h"

#include "engine/math/luminance.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace limn {

constexpr float kWhiteNits = 1.2f; ///< luminance of white at EV100 0

float ev100Of(float exposureEv) {
    return -exposureEv - std::log2(kWhiteNits);
}

float exposureOfEv100(float ev100) {
    return ev100Of(ev100);
}

float shutterOf(const CameraExposure& camera, float exposureEv) {
    return camera.aperture * camera.aperture * 100 / camera.iso * std::exp2(-ev100Of(exposureEv));
}

float exposureOfShutter(const CameraExposure& camera, float seconds) {
    return exposureOfEv100(
        std::log2(camera.aperture * camera.aperture / seconds * 100 / camera.iso));
}

std::optional<float> meteredExposure(const ImageF& linear) {
    std::vector<float> lit; // log2 of luminances
    for (const glm::vec3 pixel : linear.rgb)
        if (const float l = luminance(pixel); l > 0 && std::isfinite(l))
            lit.push_back(std::log2(l));
    if (lit.empty())
        return {};
    std::ranges::sort(lit);
    const auto tenth = std::ptrdiff_t(lit.size() / 10);
    const double sum = std::accumulate(lit.begin() + tenth, lit.end() - tenth, 0.);
    const auto mean = float(sum / double(std::ptrdiff_t(lit.size()) - 2 * tenth));
    return std::clamp(std::log2(kMiddleGrey) - mean, -kMaxExposureEv, kMaxExposureEv);
}

} // namespace limn
