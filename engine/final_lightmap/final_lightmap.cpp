// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/final_lightmap.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/fit_input.h"
#include "engine/final_lightmap/gather_texels.h"
#include "engine/final_lightmap/residual_density.h"
#include "engine/lightmap/density.h"
#include "engine/lightmap/plain_lightmap.h"
#include "engine/math/sh.h"
#include "engine/scene/dark_backs.h"
#include "engine/shading/direct_light.h"
#include "engine/shading/sampler.h"

#include <array>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr std::size_t kMaxLayers = kIrradianceBands * kIrradianceBands;

/// Direct irradiance. Shadows of rectangles are sampled by points that differ from receiver to
/// receiver.
glm::vec3 softDirect(const TraceScene& trace, const SurfacePoint& p, std::uint32_t seed) {
    constexpr std::uint32_t kRectangleSamples = 16;
    glm::vec3 sum(0);
    std::uint64_t rays = 0;
    for (const Light& light : trace.scene().lights) {
        const std::uint32_t count = light.kind == LightKind::Rectangle ? kRectangleSamples : 1;
        for (std::uint32_t s = 0; s < count; ++s)
            sum += sampleDirectLightFrom(trace, p, light, Sampler{seed, s}.pair(kOnLightDimension),
                                         rays)
                       .irradiance /
                   float(count);
    }
    return sum;
}

struct FinalMaker {
    const FinalLightmapInput& in;
    const FinalLightmapOptions& options;
    const CutScene& cut;
    const LitTexels& lit;
    const GatheredTexels& gathered;
    std::vector<FittedPoint> points;

    Hit hitAt(const FittedPoint& p) const { return hitOf(in.trace.scene(), cut, lit, p); }
    glm::vec3 irradianceOf(const FittedPoint& p, std::uint32_t seed) const;
    std::vector<glm::vec3> coefficients(std::size_t i) const;
    void finishHarmonics(const std::vector<glm::vec3>& irradiance, FinalLightmap& map) const;
};

/// Irradiance at a point, without and with direct light.
glm::vec3 FinalMaker::irradianceOf(const FittedPoint& p, std::uint32_t seed) const {
    const Hit hit = hitAt(p);
    const std::optional<SurfacePoint> surface = surfacePoint(in.trace, hit, NormalDetail::Mesh);
    if (!surface)
        return glm::vec3(0);
    const glm::vec3 e =
        sampleIrradiance(fieldPoint(in.field, in.layout, in.trace.scene(), hit, *surface)) +
        gathered.irradiance[p.texel] +
        (options.direct ? softDirect(in.trace, *surface, seed) : glm::vec3(0));
    switch (options.quantity) {
    case LightmapQuantity::Irradiance:
        break;
    case LightmapQuantity::IrradianceOverPi:
        return e / glm::pi<float>();
    case LightmapQuantity::Radiance:
        return e * surface->albedo / glm::pi<float>();
    }
    return e;
}

/// Coefficient `i` of the radiance above each point, without direct light.
std::vector<glm::vec3> FinalMaker::coefficients(std::size_t i) const {
    std::vector<glm::vec3> light(points.size());
    parallelRanges(light.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const Hit hit = hitAt(points[p]);
            const std::optional<SurfacePoint> surface =
                surfacePoint(in.trace, hit, NormalDetail::Mesh);
            if (!surface)
                continue;
            const FieldPoint here =
                fieldPoint(in.field, in.layout, in.trace.scene(), hit, *surface);
            light[p] = fieldCoefficients(here)[i] +
                       gathered.harmonics[i * lit.atlas.texels.size() + points[p].texel];
        }
    });
    return light;
}

/// Adds the mean direct light of the texel's points, makes the irradiance of all bands at the
/// surface's normal the one that was fitted.
void FinalMaker::finishHarmonics(const std::vector<glm::vec3>& irradiance,
                                 FinalLightmap& map) const {
    const std::size_t texels = lit.atlas.texels.size(), layers = map.layers;
    parallelRanges(texels, 256, [&](std::size_t begin, std::size_t end) {
        std::uint64_t rays = 0;
        for (std::size_t t = begin; t < end; ++t) {
            const AtlasTexel& texel = lit.atlas.texels[t];
            std::array<glm::vec3, kMaxLayers> c{};
            glm::vec3 normal(0);
            for (std::uint32_t k = 0; k < texel.count; ++k) {
                const std::optional<SurfacePoint> p =
                    surfacePoint(in.trace, hitAt({std::uint32_t(t), k}), NormalDetail::Mesh);
                if (!p)
                    continue;
                normal += p->normal;
                if (options.direct)
                    addDirectHarmonics(in.trace, *p, int(options.bands), c.data(), rays);
            }
            for (std::size_t l = 0; l < layers; ++l)
                c[l] = c[l] / float(texel.count) + map.values[l * texels + t];
            const float length = glm::length(normal);
            if (length > 0) {
                const float constant = std::sqrt(glm::pi<float>()) / 2; // pi Y_0
                const glm::vec3 shown = shIrradiance(int(options.bands), c.data(), normal / length);
                c[0] += (glm::max(irradiance[t], glm::vec3(0)) - shown) / constant;
            }
            for (std::size_t l = 0; l < layers; ++l)
                map.values[l * texels + t] = c[l];
        }
    });
}

/// Irradiance as far as the field knows it, for the density of texels.
glm::vec3 lightOfField(const FinalLightmapInput& in, const FinalLightmapOptions& options,
                       const Hit& hit) {
    const std::optional<SurfacePoint> p = surfacePoint(in.trace, hit, NormalDetail::Mesh);
    if (!p)
        return glm::vec3(0);
    std::uint64_t rays = 0;
    return sampleIrradiance(fieldPoint(in.field, in.layout, in.trace.scene(), hit, *p)) +
           (options.direct ? directIrradiance(in.trace, *p, rays) : glm::vec3(0));
}

} // namespace

static std::optional<FinalLightmap> makeMarked(const FinalLightmapInput& in,
                                               const FinalLightmapOptions& options,
                                               const Progress& progress) {
    const LitTexelCount count{options.texels, options.maxSide, options.onePage};
    const BakeDensity density = findDensity(in.trace, in.layout.meshes, options.texels, progress);
    CutDensity laid = densityByResidual(
        in.trace, in.layout.meshes, density.texels, count, options.cutCharts,
        [&](const Hit& hit) { return lightOfField(in, options, hit); }, progress);
    const CutScene& cut = laid.cut;
    LitTexels lit = layLitTexels(cut, laid.factors, count, progress);
    findOpenTexels(in.trace, in.layout.meshes, cut, lit, progress);
    if (progress.cancelled())
        return std::nullopt;
    const GatherScene scene =
        gatherScene(in.trace, in.field, in.emitted, in.layout, options.raysPerSample);
    const std::optional<GatheredTexels> gathered =
        gatherTexels(scene, cut, lit, {.bands = options.bands, .seed = options.seed}, progress);
    if (!gathered)
        return std::nullopt;
    const FinalMaker maker{in, options, cut, lit, *gathered, fittedPoints(lit)};
    progress.at("fit", 0);
    std::vector<glm::vec3> light(maker.points.size());
    parallelRanges(light.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            light[p] = maker.irradianceOf(maker.points[p], mixBits(options.seed, std::uint32_t(p)));
    });
    const TexelFit fit(fitInput(cut.scene, lit, maker.points));
    std::vector<glm::vec3> irradiance = fit.solve(light, meanOfTexels(lit, maker.points, light));
    FinalLightmap map{.cut = laid.cut,
                      .layout = lit.atlas.layout,
                      .texelAt = lit.texelAt,
                      .layers = options.bands > 1 ? options.bands * options.bands : 1,
                      .values = {},
                      .samples = gathered->samples};
    if (options.bands == 1) {
        for (glm::vec3& value : irradiance)
            value = glm::max(value, glm::vec3(0));
        map.values = std::move(irradiance);
        return map;
    }
    for (std::uint32_t l = 0; l < map.layers && !progress.cancelled(); ++l) {
        progress.at("fit", float(l + 1) / float(map.layers + 1));
        light = maker.coefficients(l);
        const std::vector<glm::vec3> fitted =
            fit.solve(light, meanOfTexels(lit, maker.points, light));
        map.values.insert(map.values.end(), fitted.begin(), fitted.end());
    }
    if (progress.cancelled())
        return std::nullopt;
    maker.finishHarmonics(irradiance, map);
    return map;
}

std::optional<FinalLightmap> makeFinalLightmap(const FinalLightmapInput& in,
                                               const FinalLightmapOptions& options,
                                               const Progress& progress) {
    progress.at("texels", 0);
    Scene marked = in.trace.scene();
    leaveOutDarkBacks(marked);
    const TraceScene trace(marked, in.trace); // shares its structure of static surfaces
    return makeMarked({trace, in.layout, in.field, in.emitted}, options, progress);
}

} // namespace limn
