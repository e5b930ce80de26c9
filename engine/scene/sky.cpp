// SPDX-License-Identifier: MIT
#include "engine/scene/sky.h"

#include <cmath>
#include <tuple>

#include <glm/common.hpp>

namespace limn {

std::shared_ptr<const SkyImage> makeSkyImage(ImageF pixels) {
    auto image = std::make_shared<SkyImage>();
    image->pixels = std::move(pixels);
    image->bands = skyBands(image->pixels, kSkyBands);
    return image;
}

bool Sky::operator==(const Sky& o) const {
    return std::tie(kind, radiance, horizon, ground, image, strength, rotation) ==
               std::tie(o.kind, o.radiance, o.horizon, o.ground, o.image, o.strength, o.rotation) &&
           !panorama == !o.panorama;
}

static glm::vec3 gradient(const Sky& sky, float height) {
    return glm::mix(sky.horizon, height > 0 ? sky.radiance : sky.ground, std::abs(height));
}

glm::vec3 skyRadiance(const Sky& sky, glm::vec3 d) {
    if (sky.kind == SkyKind::Gradient)
        return gradient(sky, d.y);
    if (sky.showsImage())
        return sky.strength * skyRadiance(sky.panorama->pixels, sky.rotation, d);
    return sky.radiance;
}

std::vector<glm::vec3> skyCellRadiance(const Sky& sky) {
    std::vector<glm::vec3> cells(kSkyBands * kSkySectors, sky.radiance);
    if (sky.kind == SkyKind::Gradient) {
        // Linear within a band, since none reaches across the horizon: the mean is the middle's.
        static_assert(kSkyBands % 2 == 0);
        for (std::uint32_t c = 0; c < cells.size(); ++c)
            cells[c] = gradient(sky, (float(c / kSkySectors) + 0.5f) * 2 / kSkyBands - 1);
    }
    if (sky.showsImage()) {
        cells = skyCellRadiance(sky.panorama->bands, kSkySectors, sky.rotation);
        for (glm::vec3& cell : cells)
            cell *= sky.strength;
    }
    return cells;
}

} // namespace limn
