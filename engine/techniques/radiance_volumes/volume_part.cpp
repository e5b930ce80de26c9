// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/volume_part.h"

#include "engine/field/sample_field.h"
#include "engine/math/hemisphere_radiance.h"
#include "engine/math/sh.h"
#include "engine/scene/surface/specular.h"

#include <algorithm>

namespace limn {

std::size_t VolumePart::bytes() const {
    return caches->bytes() + (light.harmonics.size() + light.glossy.size()) * sizeof(glm::vec3);
}

CacheLookup VolumePart::lookUp(const FieldPoint& point) const {
    return lookUpCaches(caches->grids, caches->address, point.position, point.surfaceNormal());
}

void VolumePart::addHarmonics(const FieldPoint& point, std::span<const float> weights,
                              FieldTaps& taps) const {
    const CacheLookup found = lookUp(point);
    for (std::size_t i = 0; i < weights.size(); ++i)
        for (std::size_t k = 0; k < found.count; ++k)
            taps.push_back(
                {std::uint32_t(found.cache[k] * coefficients() + i), weights[i] * found.weight[k]});
}

/// Leaves out the colours of a cache whose sum is below 0.
void VolumePart::addClamped(const FieldPoint& point, std::span<const float> weights,
                            FieldTaps& taps) const {
    const CacheLookup found = lookUp(point);
    for (std::size_t k = 0; k < found.count; ++k) {
        const std::size_t first = found.cache[k] * coefficients();
        glm::vec3 value(0);
        for (std::size_t i = 0; i < weights.size(); ++i)
            value += weights[i] * light.harmonics[first + i];
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; value[int(c)] > 0 && i < weights.size(); ++i)
                taps.push_back({std::uint32_t(firstColour() + 3 * (first + i) + c),
                                weights[i] * found.weight[k]});
    }
}

void VolumePart::irradianceTaps(const FieldPoint& point, FieldTaps& taps) const {
    float weights[kIrradianceBands * kIrradianceBands];
    shBasis(int(bands), point.normal, weights);
    const auto factors = irradianceFactors();
    for (int l = 0, i = 0; l < int(bands); ++l)
        for (; i < (l + 1) * (l + 1); ++i)
            weights[i] *= factors[std::size_t(l)];
    if (clamped)
        addClamped(point, {weights, coefficients()}, taps);
    else
        addHarmonics(point, {weights, coefficients()}, taps);
}

void VolumePart::radianceTaps(const FieldPoint& point, glm::vec3 direction, FieldTaps& taps) const {
    float weights[kIrradianceBands * kIrradianceBands];
    hemisphereRadianceWeights(int(bands), point.normal, direction, weights);
    addHarmonics(point, {weights, coefficients()}, taps);
}

void VolumePart::lobeTaps(const FieldPoint& point, glm::vec3 direction, int lobeBands,
                          const std::array<float, kMaxBands>& factors, FieldTaps& taps) const {
    if (glossy) {
        const Instance& instance = point.scene.instances[point.instance];
        const float roughness =
            surfaceGloss(point.scene, instance, point.triangle, point.u, point.v).roughness;
        const GlossyLookup texels =
            lookUpGlossy(*glossy, glossyFrame(eye - point.position), point.normal, roughness);
        const CacheLookup found = lookUp(point);
        for (std::size_t k = 0; k < found.count; ++k)
            for (std::size_t t = 0; t < texels.count; ++t)
                taps.push_back({std::uint32_t(firstTexel() + found.cache[k] * glossy->texels() +
                                              texels.texel[t]),
                                found.weight[k] * texels.weight[t]});
        return;
    }
    const int used = std::min(lobeBands, int(bands));
    float weights[kIrradianceBands * kIrradianceBands];
    shBasis(used, direction, weights);
    for (int l = 0, i = 0; l < used; ++l)
        for (; i < (l + 1) * (l + 1); ++i)
            weights[i] *= factors[std::size_t(l)];
    addHarmonics(point, {weights, std::size_t(used * used)}, taps);
}

glm::vec3 VolumePart::sum(std::span<const FieldTap> taps) const {
    glm::vec3 sum(0);
    for (const FieldTap& tap : taps) {
        if (tap.index < firstTexel()) {
            sum += tap.weight * light.harmonics[tap.index];
        } else if (tap.index < firstColour()) {
            sum += tap.weight * light.glossy[tap.index - firstTexel()];
        } else {
            const std::size_t colour = tap.index - firstColour();
            const int c = int(colour % 3);
            sum[c] += tap.weight * light.harmonics[colour / 3][c];
        }
    }
    return sum;
}

bool VolumePart::equals(const FieldPart& other) const {
    const auto* o = dynamic_cast<const VolumePart*>(&other);
    return o && o->bands == bands && o->clamped == clamped && o->caches->grids == caches->grids &&
           o->caches->address == caches->address && o->light.harmonics == light.harmonics &&
           o->light.glossy == light.glossy && o->eye == eye;
}

} // namespace limn
