// SPDX-License-Identifier: MIT
#include "engine/export/lightmap_image.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/texel_lookups.h"
#include "engine/lightmap/atlas.h"
#include "engine/math/sh.h"
#include "engine/shading/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// Coefficients of three bands.
constexpr std::size_t kMaxLayers = 9;

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
    return hitOfPoint(scene, t.instance, {t.triangle, uv}, t.back);
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

    std::array<glm::vec3, kMaxLayers> coefficients(const PlainTexel& t) const {
        std::array<glm::vec3, kMaxLayers> c{};
        for (std::size_t i = 0; i < std::size_t(bands * bands); ++i)
            c[i] = coefficient(t, i);
        return c;
    }

    glm::vec3 irradiance(const PlainTexel& t, const SurfacePoint& p) const {
        return glm::max(shIrradiance(bands, coefficients(t).data(), p.normal), glm::vec3(0));
    }

    /// Correction of the constant coefficient by which the lower bands alone give the irradiance of
    /// all bands at the surface's own normal.
    glm::vec3 ofUpperBands(const PlainTexel& t) const {
        const auto p = surfacePoint(in.trace, hitAt(in.scene, t, {t.u, t.v}), NormalDetail::Mesh);
        if (int(settings.bands) >= bands || !p)
            return glm::vec3(0);
        const std::array<glm::vec3, kMaxLayers> c = coefficients(t);
        const float constant = std::sqrt(std::numbers::pi_v<float>) / 2; // pi Y_0
        return (shIrradiance(bands, c.data(), p->normal) -
                shIrradiance(int(settings.bands), c.data(), p->normal)) /
               constant;
    }

    /// Calls visit(surface point) for points of the texel.
    template <class Visit>
    void forEachPoint(const PlainTexel& t, const Visit& visit) const {
        const glm::vec2 size(plain.width, plain.height);
        const TexelPoints points(in.layout, t, in.scene.instances[t.instance].mesh, size);
        for (const glm::vec2 uv : points.uv)
            if (const auto p = surfacePoint(in.trace, hitAt(in.scene, t, uv), NormalDetail::Mesh))
                visit(*p);
    }

    glm::vec3 directLight(const PlainTexel& t) const {
        glm::vec3 sum(0);
        std::uint64_t rays = 0;
        forEachPoint(t, [&](const SurfacePoint& p) { sum += directIrradiance(in.trace, p, rays); });
        return sum / float(TexelPoints::kCount);
    }

    std::array<glm::vec3, kMaxLayers> harmonics(const PlainTexel& t) const {
        const std::size_t count = settings.bands * settings.bands;
        std::array<glm::vec3, kMaxLayers> c{};
        std::uint64_t rays = 0;
        if (settings.direct)
            forEachPoint(t, [&](const SurfacePoint& p) {
                addDirectHarmonics(in.trace, p, int(settings.bands), c.data(), rays);
            });
        for (std::size_t i = 0; i < count; ++i)
            c[i] = c[i] / float(TexelPoints::kCount) + coefficient(t, i);
        c[0] += ofUpperBands(t);
        return c;
    }

    glm::vec3 color(const PlainTexel& t) const {
        const auto p = surfacePoint(in.trace, hitAt(in.scene, t, {t.u, t.v}), NormalDetail::Mesh);
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

/// The colours of the plain lightmap's texels: values[layer * texels + texel]. Incomplete when
/// cancelled.
std::vector<glm::vec3> evaluate(const ExportScene& scene, const ExportSettings& settings,
                                const PlainLightmap& plain, std::uint32_t layers,
                                const Progress& progress) {
    const Evaluation evaluation{scene, settings, plain,
                                std::min(int(scene.field.bands), kIrradianceBands)};
    const std::size_t count = plain.texels.size();
    std::vector<glm::vec3> values(count * layers);
    constexpr std::size_t kStep = 16384; // texels between two reports of progress
    for (std::size_t first = 0; first < count && !progress.cancelled(); first += kStep) {
        progress.at("lightmap", float(first) / float(count));
        parallelRanges(std::min(kStep, count - first), 256,
                       [&](std::size_t begin, std::size_t end) {
                           for (std::size_t i = first + begin; i < first + end; ++i) {
                               std::array<glm::vec3, kMaxLayers> c{};
                               if (layers > 1)
                                   c = evaluation.harmonics(plain.texels[i]);
                               else
                                   c[0] = evaluation.color(plain.texels[i]);
                               for (std::uint32_t l = 0; l < layers; ++l)
                                   values[l * count + i] = c[l];
                           }
                       });
    }
    return values;
}

LightmapImage imageOf(const PlainLightmap& plain, const LightmapPages& pages, std::uint32_t page,
                      std::uint32_t layers, const std::vector<glm::vec3>& values) {
    const std::vector<std::uint32_t> texelAt = pageTexels(plain, pages, page);
    LightmapImage image{.width = pages.width, .height = pages.height, .layers = layers};
    image.rgb.resize(texelAt.size() * layers);
    for (std::uint32_t l = 0; l < layers; ++l)
        for (std::size_t t = 0; t < texelAt.size(); ++t)
            image.rgb[l * texelAt.size() + t] = values[l * plain.texels.size() + texelAt[t]];
    return image;
}

std::string nameOfInstance(const ExportScene& scene, std::uint32_t instance) {
    const auto object = scene.document.objects.find(scene.scene.instances[instance].node);
    return object != scene.document.objects.end() ? objectName(object->second) : std::string();
}

/// Number of texels per cache along each side with which every chart fits into a texture.
Result<std::uint32_t> pagedDetail(const ExportScene& scene, const ExportSettings& settings) {
    if (const std::string defect = settingsDefect(settings); !defect.empty())
        return fail(defect);
    std::uint32_t detail = settings.detail;
    const std::uint32_t whole = std::max(scene.layout.width, scene.layout.height);
    if (std::uint64_t(whole) * detail <= settings.maxSize)
        return detail;
    const LargestChart chart = largestChart(scene.scene, scene.layout);
    while (detail > 1 && chart.side * detail > settings.maxSize)
        detail -= 2;
    if (chart.side > settings.maxSize)
        return fail(fmt::format("max size: a chart of \"{}\" is {} texels long, more than {}; bake "
                                "fewer texels",
                                nameOfInstance(scene, chart.instance), chart.side,
                                settings.maxSize));
    return detail;
}

} // namespace

Result<void> checkLightmap(const ExportScene& scene, const ExportSettings& settings) {
    if (const std::string defect = settingsDefect(settings); !defect.empty())
        return fail(defect);
    if (scene.field.lightmapWidth == 0)
        return fail("no object of the scene has a lightmap");
    if (settings.bands > scene.field.bands)
        return fail(fmt::format("lightmap bands: the light has {}, not {}", scene.field.bands,
                                settings.bands));
    if (settings.bands > 1 && settings.quantity != LightmapQuantity::Irradiance)
        return fail("quantity: harmonics hold incident radiance; leave it at irradiance");
    return {};
}

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

Result<LightmapPages> exportPages(const ExportScene& scene, const ExportSettings& settings) {
    const Result<std::uint32_t> detail = pagedDetail(scene, settings);
    if (!detail)
        return tl::make_unexpected(detail.error());
    return lightmapPages(scene.scene, scene.layout, *detail, settings.maxSize);
}

Result<std::vector<LightmapImage>> lightmapImages(const ExportScene& scene,
                                                  const ExportSettings& settings,
                                                  const LightmapPages& pages,
                                                  const Progress& progress) {
    if (const Result<void> ok = checkLightmap(scene, settings); !ok)
        return tl::make_unexpected(ok.error());
    progress.at("lightmap", 0);
    const PlainLightmap plain = plainLightmap(scene.scene, scene.layout, pages.factor);
    const std::uint32_t layers = settings.bands > 1 ? settings.bands * settings.bands : 1;
    const std::vector<glm::vec3> values = evaluate(scene, settings, plain, layers, progress);
    std::vector<LightmapImage> images;
    for (std::uint32_t page = 0; page < pages.count && !progress.cancelled(); ++page)
        images.push_back(imageOf(plain, pages, page, layers, values));
    if (progress.cancelled())
        return fail("cancelled");
    return images;
}

Result<LightmapImage> lightmapImage(const ExportScene& scene, const ExportSettings& settings,
                                    const Progress& progress) {
    const Result<std::uint32_t> detail = lightmapDetail(scene.layout, settings);
    if (!detail)
        return tl::make_unexpected(detail.error());
    Result<std::vector<LightmapImage>> images =
        lightmapImages(scene, settings, onePage(scene.scene, scene.layout, *detail), progress);
    if (!images)
        return tl::make_unexpected(images.error());
    return std::move(images->front());
}

std::uint64_t lightmapBytes(std::uint64_t texels, const ExportSettings& settings) {
    constexpr std::array<std::uint64_t, 4> kBytes = {12, 8, 4, 1}; // a texel, by TextureEncoding
    const std::uint64_t layers = settings.bands > 1 ? settings.bands * settings.bands : 1;
    return kBytes[std::size_t(settings.encoding)] * layers * texels;
}

ExportForecast forecastLightmap(const LightmapLayout& layout, const ExportSettings& settings) {
    const Result<std::uint32_t> detail = lightmapDetail(layout, settings);
    if (!detail)
        return {};
    ExportForecast f{
        .width = layout.width * *detail, .height = layout.height * *detail, .detail = *detail};
    f.bytes = lightmapBytes(std::uint64_t(f.width) * f.height, settings);
    return f;
}

ExportForecast forecastPages(const ExportScene& scene, const ExportSettings& settings) {
    const Result<std::uint32_t> detail = pagedDetail(scene, settings);
    if (!detail)
        return {};
    const std::uint32_t pages = expectedPages(scene.scene, scene.layout, *detail, settings.maxSize);
    const std::uint32_t side = settings.maxSize / *detail * *detail;
    ExportForecast f{.width = pages > 1 ? side : scene.layout.width * *detail,
                     .height = pages > 1 ? side : scene.layout.height * *detail,
                     .pages = pages,
                     .detail = *detail};
    f.bytes = lightmapBytes(std::uint64_t(f.width) * f.height * pages, settings);
    return f;
}

} // namespace limn
