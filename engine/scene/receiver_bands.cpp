// SPDX-License-Identifier: MIT
#include "engine/scene/receiver_bands.h"

#include "engine/math/lobe.h"
#include "engine/scene/specular.h"

#include <algorithm>
#include <array>

namespace limn {

namespace {

/// Texels of a metallic-roughness texture by their values, of which each axis has so many steps.
constexpr int kSteps = 16;
struct TexelCounts {
    std::array<std::uint32_t, kSteps * kSteps> count{}; ///< roughness * kSteps + metallic
    std::uint32_t all = 0;

    void add(float roughness, float metallic) {
        const auto step = [](float v) {
            return std::size_t(std::clamp(int(v * float(kSteps)), 0, kSteps - 1));
        };
        ++count[step(roughness) * kSteps + step(metallic)];
        ++all;
    }
};

/// Of 64 x 64 texels spread over the image, or all where there are fewer.
TexelCounts countTexels(const Image& image) {
    TexelCounts counts;
    const std::uint32_t stepX = std::max(image.width / 64, 1U),
                        stepY = std::max(image.height / 64, 1U);
    for (std::uint32_t y = stepY / 2; y < image.height; y += stepY)
        for (std::uint32_t x = stepX / 2; x < image.width; x += stepX) {
            const std::uint8_t* texel = &image.rgba[(std::size_t(y) * image.width + x) * 4];
            counts.add(float(texel[1]) / 255, float(texel[2]) / 255);
        }
    return counts;
}

/// Mean of specularAlbedo's brightest channel over all directions of a hemisphere, by the cosine.
float meanShare(const Gloss& gloss) {
    constexpr int kDirections = 8; // equal shares of NoV^2
    float sum = 0;
    for (int i = 0; i < kDirections; ++i) {
        const glm::vec3 a =
            specularAlbedo(gloss, std::sqrt((float(i) + 0.5f) / float(kDirections)));
        sum += std::max({a.x, a.y, a.z});
    }
    return sum / float(kDirections);
}

int bandsOf(const Gloss& gloss, int most) {
    const auto loss = lobeLosses(lobeExponent(gloss.roughness));
    const float share = meanShare(gloss);
    int bands = std::min(kIrradianceBands, most);
    while (bands < most && loss[std::size_t(bands)] * share > kReflectionLoss)
        ++bands;
    return bands;
}

} // namespace

int receiverBands(const Assets& assets, const Material& m, int most) {
    const auto bandsAt = [&](float roughness, float metallic) {
        const float metal = m.metallic * metallic;
        return bandsOf(
            {glm::mix(glm::vec3(0.04f), glm::vec3(m.baseColor), metal), m.roughness * roughness},
            most);
    };
    const std::int32_t image = m.metallicRoughnessTexture.image;
    if (image < 0 || std::size_t(image) >= assets.images.size() ||
        assets.images[std::size_t(image)].rgba.empty())
        return bandsAt(1, 1);
    const TexelCounts counts = countTexels(assets.images[std::size_t(image)]);
    int bands = std::min(kIrradianceBands, most);
    for (std::size_t k = 0; k < counts.count.size() && bands < most; ++k)
        if (counts.count[k] * 100 >= counts.all)
            bands = std::max(
                bands, bandsAt(float(k / kSteps) / (kSteps - 1), float(k % kSteps) / (kSteps - 1)));
    return bands;
}

int receiverBands(const Scene& scene, int most) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Instance& instance : scene.instances)
        used[instance.material] = true;
    int bands = std::min(kIrradianceBands, most);
    for (std::size_t i = 0; i < used.size() && bands < most; ++i)
        if (used[i])
            bands = std::max(bands, receiverBands(*scene.assets, scene.materials[i], most));
    return bands;
}

} // namespace limn
