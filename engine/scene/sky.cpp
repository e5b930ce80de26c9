// SPDX-License-Identifier: MIT
#include "engine/scene/sky.h"

#include <tuple>

namespace limn {

std::shared_ptr<const SkyImage> makeSkyImage(ImageF pixels) {
    auto image = std::make_shared<SkyImage>();
    image->pixels = std::move(pixels);
    image->bands = skyBands(image->pixels, kSkyBands);
    return image;
}

bool Sky::operator==(const Sky& o) const {
    return std::tie(radiance, image, strength, rotation) ==
           std::tie(o.radiance, o.image, o.strength, o.rotation);
}

glm::vec3 skyRadiance(const Sky& sky, glm::vec3 d) {
    return sky.panorama ? sky.strength * skyRadiance(sky.panorama->pixels, sky.rotation, d)
                        : sky.radiance;
}

std::vector<glm::vec3> skyCellRadiance(const Sky& sky) {
    if (!sky.panorama)
        return std::vector<glm::vec3>(kSkyBands * kSkySectors, sky.radiance);
    std::vector<glm::vec3> cells = skyCellRadiance(sky.panorama->bands, kSkySectors, sky.rotation);
    for (glm::vec3& cell : cells)
        cell *= sky.strength;
    return cells;
}

glm::vec3 meanRadiance(const Sky& sky) {
    if (!sky.panorama)
        return sky.radiance;
    glm::vec3 sum(0);
    for (const glm::vec3 cell : skyCellRadiance(sky))
        sum += cell;
    return sum / float(kSkyBands * kSkySectors);
}

} // namespace limn
