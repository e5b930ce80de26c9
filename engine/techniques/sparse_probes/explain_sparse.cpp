// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/relight_rays.h"
#include "engine/techniques/sparse_probes/sparse_lighting.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace limn {

namespace {

/// Weights per receiver, or per coefficient of each probe, of the value that is explained.
using Weights = std::vector<glm::vec3>;

double absoluteSum(glm::dvec3 v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

glm::dvec3 valueOf(const Weights& weights, const Weights& values) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < weights.size(); ++i)
        sum += glm::dvec3(weights[i] * values[i]);
    return sum;
}

/// Weights of the radiance that receivers send where those of probes are known.
Weights radianceWeights(const SparseBake& bake, const std::vector<float>& basis,
                        const Weights& probes) {
    const std::size_t count = bake.coefficients(), rays = bake.sparse.rays;
    const float share = 4 * std::numbers::pi_v<float> / float(rays);
    Weights weights(bake.receivers.size(), glm::vec3(0));
    for (std::size_t p = 0; p < bake.probes.size(); ++p) {
        const glm::vec3* probe = &probes[p * count];
        if (std::all_of(probe, probe + count, [](glm::vec3 w) { return w == glm::vec3(0); }))
            continue;
        for (std::size_t q = 0; q < rays; ++q) {
            const std::uint32_t hit = bake.hits[p * rays + q];
            if (hit >= kDarkHit)
                continue;
            glm::vec3 sum(0);
            for (std::size_t i = 0; i < count; ++i)
                sum += probe[i] * basis[q * count + i];
            weights[hit] += sum * share;
        }
    }
    return weights;
}

/// What probes with these weights get from the sky.
glm::dvec3 skyValue(const SparseBake& bake, const ProbeRadiance& sky, const Weights& probes) {
    const std::size_t count = bake.coefficients();
    glm::dvec3 sum(0);
    for (std::size_t p = 0; p < bake.probes.size(); ++p)
        for (std::size_t i = 0; i < count; ++i) {
            const float* radiance = &sky[p * 3 * count + i];
            sum += glm::dvec3(probes[p * count + i] *
                              glm::vec3(radiance[0], radiance[count], radiance[2 * count]));
        }
    return sum;
}

/// Weights of a reading of the field: on the irradiance of receivers, and on probes, by the grid.
struct ReadingWeights {
    Weights receivers, probes;
};

ReadingWeights weigh(const SparseBake& bake, const IndirectField& field,
                     const FieldReading& reading) {
    const std::size_t count = bake.coefficients(),
                      common = std::min<std::size_t>(count, field.coefficients());
    ReadingWeights w{Weights(bake.receivers.size(), glm::vec3(0)),
                     Weights(bake.probes.size() * count, glm::vec3(0))};
    const std::vector<std::uint32_t>& texels = bake.receivers.texel;
    for (const FieldReading::Entry& entry : reading.entries) {
        if (!entry.grid) {
            const auto found = std::ranges::lower_bound(texels, entry.index);
            if (found != texels.end() && *found == entry.index)
                w.receivers[std::size_t(found - texels.begin())] +=
                    entry.weight[0] * kRadiancePerIrradiance;
            continue;
        }
        const NearProbes near = nearestProbes(bake.probes, cellCentre(field, entry.index));
        float sum = 0;
        for (const float weight : near.weight)
            sum += weight;
        for (std::uint32_t k = 0; k < kProbesPerReceiver && near.probe[k] != kNoProbe; ++k)
            for (std::size_t i = 0; i < common; ++i)
                w.probes[near.probe[k] * count + i] += entry.weight[i] * (near.weight[k] / sum);
    }
    return w;
}

} // namespace

Explanation SparseLighting::explain(const Scene& scene, const FieldReading& reading,
                                    const ExplainOptions& options) const {
    const SparseBake& bake = *m_bake;
    const std::vector<std::uint32_t>& instanceOf = bake.receivers.instance;
    const auto isBlack = [&](std::uint32_t instance) {
        return std::ranges::find(options.black, instance) != options.black.end();
    };
    if (m_clampParts || m_materials.albedo.empty())
        return {}; // clamped parts are not linear
    ReadingWeights next = weigh(bake, m_field, reading);
    Weights all(bake.receivers.size(), glm::vec3(0)); // on what receivers send, over all bounces
    Explanation result;
    glm::dvec3 sky(0), whole(0), remainder(0);
    for (std::uint32_t bounce = 0;; ++bounce) {
        for (std::size_t r = 0; r < next.receivers.size(); ++r)
            for (int c = 0; c < 3; ++c)
                if (!(m_irradiance[r][c] > 0)) // clamped
                    next.receivers[r][c] = 0;
        remainder = valueOf(next.receivers, m_irradiance);
        if (bounce > 0 && (absoluteSum(remainder) <= options.tolerance * absoluteSum(whole) ||
                           bounce >= scene.relight.maxBounces))
            break;
        addTransposed(bake, next.receivers, next.probes);
        const Weights sent = radianceWeights(bake, m_basis, next.probes);
        const glm::dvec3 direct = skyValue(bake, m_skyAtProbes, next.probes);
        sky += direct;
        if (bounce == 0) {
            whole = direct + valueOf(sent, m_radiance);
            std::map<std::uint32_t, glm::dvec3> senders;
            for (std::size_t r = 0; r < sent.size(); ++r)
                senders[instanceOf[r]] += glm::dvec3(sent[r] * m_radiance[r]);
            std::vector<LightRow> rows;
            for (const auto& [instance, value] : senders)
                rows.push_back({.kind = LightRowKind::Surface,
                                .label = objectLabel(scene, instance),
                                .index = instance,
                                .value = glm::vec3(value)});
            rows.push_back({.kind = LightRowKind::Sky, .label = "Sky", .value = glm::vec3(sky)});
            if (options.black.empty())
                result.bySender = strongest(std::move(rows), options.rows);
        }
        for (std::size_t r = 0; r < sent.size(); ++r) {
            all[r] += sent[r];
            next.receivers[r] = isBlack(instanceOf[r])
                                    ? glm::vec3(0)
                                    : sent[r] * m_materials.albedo[r] / std::numbers::pi_v<float>;
        }
        std::ranges::fill(next.probes, glm::vec3(0));
        result.bounces = bounce + 1;
    }
    addRow(result.byOrigin, {.kind = LightRowKind::Sky, .label = "Sky", .value = glm::vec3(sky)});
    std::size_t traced = 0; // m_direct holds the lights that shine and reach receivers
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
        const Light& light = scene.lights[l];
        if (!shines(light) || !reaches(light, m_direct.bounds))
            continue;
        const std::vector<float>& share = m_direct.lights[traced++].share;
        const glm::vec3 strength = light.color * light.strength;
        glm::dvec3 sum(0);
        for (std::size_t r = 0; r < all.size(); ++r)
            if (share[r] > 0 && !isBlack(instanceOf[r]))
                sum += glm::dvec3(all[r] * m_materials.albedo[r] / std::numbers::pi_v<float> *
                                  glm::min(strength * share[r], kMaxIrradiance));
        addRow(result.byOrigin, {.kind = LightRowKind::Light,
                                 .label = light.name,
                                 .index = l,
                                 .value = glm::vec3(sum)});
    }
    std::map<std::uint32_t, glm::dvec3> emitters;
    for (std::size_t r = 0; r < all.size(); ++r)
        if (m_materials.emission[r] != glm::vec3(0))
            emitters[instanceOf[r]] += glm::dvec3(all[r] * m_materials.emission[r]);
    for (const auto& [instance, value] : emitters)
        addRow(result.byOrigin, {.kind = LightRowKind::Surface,
                                 .label = objectLabel(scene, instance),
                                 .index = instance,
                                 .value = glm::vec3(value)});
    if (absoluteSum(remainder) > 0)
        addRow(result.byOrigin, {.kind = LightRowKind::Remainder,
                                 .label = fmt::format("After more than {} bounces", result.bounces),
                                 .value = glm::vec3(remainder)});
    return result;
}

} // namespace limn
