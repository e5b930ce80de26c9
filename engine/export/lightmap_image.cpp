// SPDX-License-Identifier: MIT
#include "engine/export/lightmap_image.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/atlas.h"
#include "engine/math/sh.h"
#include "engine/reference/direct_light.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

glm::vec2 cornerOf(const LightmapLayout& layout, const PlainTexel& t, std::uint32_t mesh, float u,
                   float v) {
    return unsnappedUv(layout, t.instance, mesh, t.triangle, u, v, t.back);
}

/// Barycentrics of points spread over a texel, as far as they lie in its triangle; others are moved
/// to the triangle's border.
struct TexelPoints {
    static constexpr std::size_t kCount = 4;
    std::array<glm::vec2, kCount> uv;

    TexelPoints(const LightmapLayout& layout, const PlainTexel& t, std::uint32_t mesh,
                glm::vec2 size) {
        const glm::vec2 origin = cornerOf(layout, t, mesh, 0, 0);
        const glm::mat2 toTexels((cornerOf(layout, t, mesh, 1, 0) - origin) * size,
                                 (cornerOf(layout, t, mesh, 0, 1) - origin) * size);
        const bool flat = glm::determinant(toTexels) == 0; // a chart of a single texel
        const glm::mat2 toUv = flat ? glm::mat2(0) : glm::inverse(toTexels);
        for (std::size_t k = 0; k < kCount; ++k) {
            const glm::vec2 offset(k & 1 ? 0.25f : -0.25f, k & 2 ? 0.25f : -0.25f);
            glm::vec2 p = glm::max(glm::vec2(t.u, t.v) + toUv * offset, glm::vec2(0));
            if (const float sum = p.x + p.y; sum > 1)
                p /= sum;
            uv[k] = p;
        }
    }
};

Hit hitAt(const Scene& scene, const PlainTexel& t, glm::vec2 uv) {
    const Instance& instance = scene.instances[t.instance];
    const Mesh& mesh = scene.meshOf(instance);
    Hit hit;
    hit.instance = t.instance;
    hit.triangle = t.triangle;
    hit.u = uv.x;
    hit.v = uv.y;
    hit.position = glm::vec3(instance.toWorld * glm::vec4(trianglePoint(mesh, t.triangle, uv), 1));
    hit.geometricNormal = glm::normalize(instance.normalToWorld * triangleNormal(mesh, t.triangle));
    hit.frontFace = !t.back;
    return hit;
}

struct Evaluation {
    const ExportScene& in;
    const ExportSettings& settings;
    const PlainLightmap& plain;
    int bands; ///< read from the field

    glm::vec3 coefficient(const PlainTexel& t, std::size_t i) const {
        const std::size_t texels = std::size_t(in.field.lightmapWidth) * in.field.lightmapHeight;
        glm::vec3 sum(0);
        for (int k = 0; k < 4; ++k)
            sum += glm::vec3(in.field.lightmap[i * texels + t.texel[k]]) * t.weight[k];
        return sum;
    }

    glm::vec3 irradiance(const PlainTexel& t, const SurfacePoint& p) const {
        std::array<glm::vec3, kIrradianceBands * kIrradianceBands> c;
        for (std::size_t i = 0; i < std::size_t(bands * bands); ++i)
            c[i] = coefficient(t, i);
        return glm::max(shIrradiance(bands, c.data(), p.normal), glm::vec3(0));
    }

    glm::vec3 directLight(const PlainTexel& t) const {
        const glm::vec2 size(plain.width, plain.height);
        const TexelPoints points(in.layout, t, in.scene.instances[t.instance].mesh, size);
        glm::vec3 sum(0);
        std::uint64_t rays = 0;
        for (const glm::vec2 uv : points.uv)
            if (const auto p = surfacePoint(in.trace, hitAt(in.scene, t, uv)))
                sum += directIrradiance(in.trace, *p, rays);
        return sum / float(TexelPoints::kCount);
    }

    glm::vec3 color(const PlainTexel& t) const {
        const auto p = surfacePoint(in.trace, hitAt(in.scene, t, {t.u, t.v}));
        if (!p)
            return glm::vec3(0);
        const glm::vec3 e = irradiance(t, *p) + (settings.direct ? directLight(t) : glm::vec3(0));
        switch (settings.quantity) {
        case LightmapQuantity::Irradiance:
            return e;
        case LightmapQuantity::IrradianceOverPi:
            return e / std::numbers::pi_v<float>;
        case LightmapQuantity::Radiance:
            return e * p->albedo / std::numbers::pi_v<float>;
        }
        return e;
    }
};

Result<void> checkSettings(const ExportScene& scene, const ExportSettings& settings) {
    if (scene.field.lightmapWidth == 0)
        return fail("no object of the scene has a lightmap");
    if (settings.bands > scene.field.bands)
        return fail(fmt::format("lightmap bands: the light has {}, not {}", scene.field.bands,
                                settings.bands));
    if (settings.bands > 1 && settings.direct)
        return fail("direct: harmonics hold bounced light only; use one band");
    if (settings.bands > 1 && settings.quantity != LightmapQuantity::Irradiance)
        return fail("quantity: harmonics hold incident radiance; leave it at irradiance");
    return {};
}

} // namespace

Result<std::uint32_t> lightmapDetail(const LightmapLayout& layout, const ExportSettings& settings) {
    if (const std::string defect = settingsDefect(settings); !defect.empty())
        return fail(defect);
    const std::uint32_t side = std::max({layout.width, layout.height, 1U});
    std::uint32_t detail = settings.detail;
    while (detail > 1 && std::uint64_t(side) * detail > settings.maxSize)
        detail -= 2;
    if (side > settings.maxSize)
        return fail(fmt::format("max size: the lightmap is {} x {} texels, more than {} a side; "
                                "bake fewer texels",
                                layout.width, layout.height, settings.maxSize));
    return detail;
}

Result<LightmapImage> lightmapImage(const ExportScene& scene, const ExportSettings& settings,
                                    const Progress& progress) {
    if (const Result<void> ok = checkSettings(scene, settings); !ok)
        return tl::make_unexpected(ok.error());
    const Result<std::uint32_t> detail = lightmapDetail(scene.layout, settings);
    if (!detail)
        return tl::make_unexpected(detail.error());
    progress.at("lightmap", 0);
    const PlainLightmap plain = plainLightmap(scene.scene, scene.layout, *detail);
    const Evaluation evaluation{scene, settings, plain,
                                std::min(int(scene.field.bands), kIrradianceBands)};
    const bool harmonics = settings.bands > 1;
    const std::uint32_t layers = harmonics ? settings.bands * settings.bands : 1;
    const std::size_t count = plain.texels.size();
    std::vector<glm::vec3> values(count * layers);
    constexpr std::size_t kStep = 16384; // texels between two reports of progress
    for (std::size_t first = 0; first < count && !progress.cancelled(); first += kStep) {
        progress.at("lightmap", float(first) / float(count));
        parallelRanges(std::min(kStep, count - first), 256,
                       [&](std::size_t begin, std::size_t end) {
                           for (std::size_t i = first + begin; i < first + end; ++i)
                               for (std::uint32_t l = 0; l < layers; ++l)
                                   values[l * count + i] =
                                       harmonics ? evaluation.coefficient(plain.texels[i], l)
                                                 : evaluation.color(plain.texels[i]);
                       });
    }
    if (progress.cancelled())
        return fail("cancelled");
    LightmapImage image{.width = plain.width, .height = plain.height, .layers = layers};
    image.rgb.resize(plain.texelAt.size() * layers);
    for (std::uint32_t l = 0; l < layers; ++l)
        for (std::size_t t = 0; t < plain.texelAt.size(); ++t)
            image.rgb[l * plain.texelAt.size() + t] = values[l * count + plain.texelAt[t]];
    return image;
}

ExportForecast forecastLightmap(const LightmapLayout& layout, const ExportSettings& settings) {
    const Result<std::uint32_t> detail = lightmapDetail(layout, settings);
    if (!detail)
        return {};
    constexpr std::array<std::uint64_t, 3> kBytes = {12, 8, 4}; // per texel, by TextureEncoding
    const std::uint64_t layers = settings.bands > 1 ? settings.bands * settings.bands : 1;
    ExportForecast f{
        .width = layout.width * *detail, .height = layout.height * *detail, .detail = *detail};
    f.bytes = kBytes[std::size_t(settings.encoding)] * layers * f.width * f.height;
    return f;
}

} // namespace limn
