// SPDX-License-Identifier: MIT
#include "engine/scene/surface/receiver_bands.h"

#include "engine/math/lobe.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/scene/surface/reflection_lobe.h"

#include <algorithm>
#include <array>

namespace limn {

namespace {

/// Number of bins per axis for the values of a metallic-roughness texture.
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

/// Counts 64 x 64 texels spread over the image, or all of them if there are fewer.
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

constexpr int kRoughnessSteps = 16;
constexpr int kViews = 4;      ///< equal shares of NoV^2, so that each counts by its cosine
constexpr int kLossBands = 64; ///< of the narrowest lobe, the bands from there on would add 0.01

float viewCosine(int k) {
    return std::sqrt((float(k) + 0.5f) / float(kViews));
}

/// lobeLosses() of the reflection at the angles of viewCosine(), by roughness.
using Losses =
    std::array<std::array<std::array<float, kMaxBands + 1>, kViews>, kRoughnessSteps + 1>;

Losses findLosses() {
    Losses losses{};
    for (int r = 0; r <= kRoughnessSteps; ++r)
        for (int k = 0; k < kViews; ++k)
            losses[std::size_t(r)][std::size_t(k)] =
                lobeLosses(integrateReflection(float(r) / float(kRoughnessSteps), viewCosine(k), 32,
                                               kLossBands)
                               .factors);
    return losses;
}

/// Rms over all directions of light and viewing angles of the missing light in the brightest
/// channel, relative to the incoming light.
float reflectionLoss(const Gloss& gloss, int bands) {
    static const Losses losses = findLosses();
    const float position = std::clamp(gloss.roughness, 0.f, 1.f) * float(kRoughnessSteps);
    const int base = std::min(int(position), kRoughnessSteps - 1);
    float square = 0;
    for (int k = 0; k < kViews; ++k) {
        const auto lossAt = [&](int row) {
            return losses[std::size_t(row)][std::size_t(k)][std::size_t(bands)];
        };
        const glm::vec3 share = specularAlbedo(gloss, viewCosine(k));
        const float lost = std::max({share.x, share.y, share.z}) *
                           glm::mix(lossAt(base), lossAt(base + 1), position - float(base));
        square += lost * lost / float(kViews);
    }
    return std::sqrt(square);
}

int bandsOf(const Gloss& gloss, int maxBands) {
    int bands = std::min(kIrradianceBands, maxBands);
    while (bands < maxBands && reflectionLoss(gloss, bands) > kReflectionLoss)
        ++bands;
    return bands;
}

} // namespace

int receiverBands(const Assets& assets, const Material& m, int maxBands) {
    const auto bandsAt = [&](float roughness, float metallic) {
        const float metal = m.metallic * metallic;
        const glm::vec3 F0 =
            glm::mix(glm::vec3(dielectricF0(m.ior)), glm::vec3(m.baseColor), metal);
        return bandsOf({F0, m.roughness * roughness}, maxBands);
    };
    const std::int32_t image = m.metallicRoughnessTexture.image;
    if (image < 0 || std::size_t(image) >= assets.images.size() ||
        assets.images[std::size_t(image)].rgba.empty())
        return bandsAt(1, 1);
    const TexelCounts counts = countTexels(assets.images[std::size_t(image)]);
    int bands = std::min(kIrradianceBands, maxBands);
    for (std::size_t k = 0; k < counts.count.size() && bands < maxBands; ++k)
        if (counts.count[k] * 100 >= counts.all)
            bands = std::max(
                bands, bandsAt(float(k / kSteps) / (kSteps - 1), float(k % kSteps) / (kSteps - 1)));
    return bands;
}

int receiverBands(const Scene& scene, int maxBands) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Instance& instance : scene.instances)
        used[instance.material] = true;
    int bands = std::min(kIrradianceBands, maxBands);
    for (std::size_t i = 0; i < used.size() && bands < maxBands; ++i)
        if (used[i])
            bands = std::max(bands, receiverBands(*scene.assets, scene.materials[i], maxBands));
    return bands;
}

} // namespace limn
