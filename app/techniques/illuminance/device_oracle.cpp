// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/device_oracle.h"

#include "engine/core/log.h"
#include "engine/field/grid_placement.h"
#include "engine/gpu/device.h"
#include "engine/techniques/illuminance/gpu/gpu_relight.h"
#include "engine/techniques/illuminance/relight/surfel_light.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace limn {

namespace {

double largest(glm::vec3 v) {
    return std::max({std::abs(double(v.x)), std::abs(double(v.y)), std::abs(double(v.z))});
}

/// The largest difference of two arrays over what 32-bit sums of n links in another order may
/// differ by: sqrt(n) / 4 + 1/2 units of 2^-24 of the largest value, times 4 for higher bands and
/// 6 for six standard deviations.
double ofRounding(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b,
                  double roundings) {
    if (a.size() != b.size())
        return std::numeric_limits<double>::infinity();
    double maximum = 0, scale = 1e-30;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            raise(maximum, std::abs(double(a[i][c]) - double(b[i][c])));
        scale = std::max(scale, largest(a[i]));
    }
    return maximum / (6 * 4 * roundings * std::ldexp(scale, -24));
}

/// Number of bounces. Each adds rounding errors, and with more bounces CPU and device occasionally
/// end at different ones.
constexpr std::uint32_t kBounces = 5;

Judgement judgeDevice(gpu::Device& device, const Subject& subject) {
    const LitScene& s = subject.base;
    const Bake& bake = *s.bake;
    const auto gpu = GpuRelighter::create(device, s.bake);
    if (!gpu)
        return broken();
    DirectIrradiance light;
    std::vector<glm::vec3> albedo, emitted;
    updateDirectIrradiance(bake.surfels, s.scene, *s.trace, light);
    surfelMaterials(bake.surfels, s.scene, albedo, emitted);
    const std::vector<glm::vec3> sky = skyRadiosity(bake.tree, s.scene.sky);
    const std::uint32_t bounces = std::min(s.scene.relight.maxBounces, kBounces);
    Relighter cpu(s.bake);
    cpu.relight(s.scene, *s.trace, bounces, subject.progress);
    const IndirectField& field = cpu.field();
    (*gpu)->relight({.direct = light.irradiance,
                     .albedo = albedo,
                     .emitted = emitted,
                     .sky = sky,
                     .bands = field.bands,
                     .settings = s.scene.relight,
                     .grid = needsGrid(s.scene, bake.lightmap),
                     .occluders = &s.scene},
                    bounces, subject.progress);
    std::uint32_t links = 0;
    for (std::size_t c = 0; c < bake.caches.size(); ++c)
        links = std::max(links, bake.caches.linkBegin[c + 1] - bake.caches.linkBegin[c]);
    const double roundings = 0.25 * std::sqrt(double(links)) + 0.5;
    const std::vector<glm::vec3> sent(cpu.radiosity().begin(), cpu.radiosity().end());
    return judged(std::max(ofRounding(sent, (*gpu)->readRadiosity(), roundings),
                           ofRounding(cpu.cacheSh(), (*gpu)->readCacheSh(), roundings)),
                  1);
}

} // namespace

Oracle deviceOracle(const std::string& device, std::uint32_t share) {
    std::shared_ptr<gpu::Device> made;
    if (share > 0) {
        auto created = gpu::createDevice({.name = device, .validation = true});
        if (created)
            made = std::move(*created);
        else
            logWarning("no device is asked: " + created.error().message);
    }
    return {"device", "The device relights as the CPU does.",
            [made, share](const Subject& subject) {
                if (!made || subject.seed % share != 0)
                    return notJudged();
                const Judgement judgement = judgeDevice(*made, subject);
                const auto messages = made->validationMessages();
                for (const std::string& message : messages)
                    logWarning(message);
                return messages.empty() ? judgement : broken();
            }};
}

} // namespace limn
