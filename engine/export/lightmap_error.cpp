// SPDX-License-Identifier: MIT
#include "engine/export/lightmap_error.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/texel_lookups.h"
#include "engine/lightmap/atlas.h"
#include "engine/math/sh.h"
#include "engine/measure/seen_points.h"
#include "engine/reference/path.h"
#include "engine/shading/direct_light.h"
#include "engine/shading/pixel_rays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

/// What a lookup finds in one layer.
glm::vec3 lookUpLayer(const LightmapImage& image, std::size_t layer, const Bilinear& lookup) {
    const std::size_t first = layer * image.width * image.height;
    glm::vec3 sum(0);
    for (std::size_t k = 0; k < 4; ++k)
        sum += lookup.weight[k] * image.rgb[first + lookup.texel[k]];
    return sum;
}

/// What texels hold for unit irradiance.
glm::vec3 unitOf(const ExportSettings& settings, const SurfacePoint& p) {
    if (settings.bands > 1 || settings.quantity == LightmapQuantity::Irradiance)
        return glm::vec3(1);
    return (settings.quantity == LightmapQuantity::Radiance ? p.albedo : glm::vec3(1)) /
           glm::pi<float>();
}

/// Means over the points of each pixel that has some, as an image of one row. Points are in the
/// order of rows of points, so those of a pixel are not next to each other.
ImageF pixelMeans(const std::vector<glm::vec3>& values, const std::vector<std::uint32_t>& pixelOf) {
    const std::uint32_t pixels = *std::ranges::max_element(pixelOf) + 1;
    std::vector<glm::vec3> sums(pixels);
    std::vector<std::uint32_t> counts(pixels);
    for (std::size_t i = 0; i < values.size(); ++i) {
        sums[pixelOf[i]] += values[i];
        ++counts[pixelOf[i]];
    }
    ImageF row{0, 1, {}};
    for (std::uint32_t p = 0; p < pixels; ++p)
        if (counts[p] > 0)
            row.rgb.push_back(sums[p] / float(counts[p]));
    row.width = std::uint32_t(row.rgb.size());
    return row;
}

} // namespace

/// A lookup in the scene that the pages belong to, with charts per mesh.
static std::optional<glm::vec3> lookUpIn(const Scene& scene, const std::vector<MeshCharts>& meshes,
                                         const LightmapPages& pages,
                                         const std::vector<LightmapImage>& images,
                                         const SurfaceHit& hit, glm::vec3 normal) {
    if (hit.instance >= pages.instances.size() || pages.instances[hit.instance][0].uv.empty())
        return std::nullopt;
    const std::array<LightmapPages::Side, 2>& sides = pages.instances[hit.instance];
    const LightmapPages::Side& side = !hit.frontFace && !sides[1].uv.empty() ? sides[1] : sides[0];
    const MeshCharts& charts = meshes[scene.instances[hit.instance].mesh];
    const auto corner = [&](std::size_t k) {
        return side.uv[charts.indices[3 * std::size_t(hit.triangle) + k]];
    };
    const glm::vec2 uv = corner(0) * (1 - hit.u - hit.v) + corner(1) * hit.u + corner(2) * hit.v;
    const LightmapImage& image = images[side.page[charts.chartOfTriangle[hit.triangle]]];
    LightmapLayout page; // its size alone
    page.width = image.width;
    page.height = image.height;
    const Bilinear lookup = bilinearAt(page, uv);
    if (image.layers == 1)
        return lookUpLayer(image, 0, lookup);
    std::array<glm::vec3, kIrradianceBands * kIrradianceBands> c{};
    for (std::size_t i = 0; i < image.layers; ++i)
        c[i] = lookUpLayer(image, i, lookup);
    return glm::max(shIrradiance(image.layers == 4 ? 2 : 3, c.data(), normal), glm::vec3(0));
}

std::optional<glm::vec3> lookUpExported(const ExportScene& scene, const CutScene* cut,
                                        const LightmapPages& pages,
                                        const std::vector<LightmapImage>& images, SurfaceHit hit,
                                        glm::vec3 normal) {
    if (!cut)
        return lookUpIn(scene.scene, scene.layout.meshes, pages, images, hit, normal);
    const MeshPoint p = cut->fromSource(hit.instance, {hit.triangle, {hit.u, hit.v}});
    hit.triangle = p.triangle;
    hit.u = p.barycentric.x;
    hit.v = p.barycentric.y;
    return lookUpIn(cut->scene, cut->charts, pages, images, hit, normal);
}

Result<Comparison> lightmapError(const ExportScene& scene, const WrittenLightmap& map,
                                 const std::vector<LightmapImage>& images,
                                 const ExportSettings& settings,
                                 const LightmapErrorOptions& options, const Progress& progress) {
    const std::uint32_t side = options.pointsPerSide, columns = options.width * side;
    const PixelRays rays(options.camera, columns, options.height * side);
    std::vector<SeenPoint> points;
    std::vector<std::uint32_t> pixelOf; // of each point
    std::vector<glm::vec3> shown;
    for (std::uint32_t i = 0; i < columns * options.height * side; ++i) {
        const std::optional<SeenPoint> p = findSeenPoint(scene.trace, rays, i, 1);
        const std::optional<glm::vec3> value =
            p ? lookUpExported(scene, map.cut.get(), map.pages, images, p->hit, p->surface.normal)
              : std::nullopt;
        if (!value)
            continue;
        points.push_back(*p);
        pixelOf.push_back(i / columns / side * options.width + i % columns / side);
        shown.push_back(*value);
    }
    if (points.empty())
        return fail("the camera sees no surface with a lightmap");
    const Emitters emitters = findEmitters(scene.trace);
    const SkyLight sky = findSkyLight(scene.scene.sky);
    const PathContext context{scene.trace, emitters, sky};
    std::array<std::vector<glm::vec3>, 2> truths;
    for (std::uint32_t k = 0; k < 2; ++k) {
        auto traced = traceIrradiance(context, points, options.paths, 2 + k, progress);
        if (!traced)
            return fail("cancelled");
        truths[k] = std::move(*traced);
    }
    parallelRanges(points.size(), 64, [&](std::size_t begin, std::size_t end) {
        std::uint64_t shadowRays = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const SurfacePoint& p = points[i].surface;
            const glm::vec3 direct =
                settings.direct ? directIrradiance(scene.trace, p, shadowRays) : glm::vec3(0);
            for (std::vector<glm::vec3>& truth : truths)
                truth[i] = (truth[i] + direct) * unitOf(settings, p);
        }
    });
    const Result<Comparison> error = compareImages(
        pixelMeans(shown, pixelOf), pixelMeans(truths[0], pixelOf), pixelMeans(truths[1], pixelOf));
    if (error && !std::isfinite(error->nrmse))
        return fail("the camera sees no light");
    return error;
}

SeamError exportedSeams(const ExportScene& scene, const WrittenLightmap& map,
                        const std::vector<LightmapImage>& images) {
    constexpr std::uint32_t kSamples = 16; // an edge is often longer than a texel
    const Scene& shapes = map.cut ? map.cut->scene : scene.scene;
    LightmapLayout layout; // of what is measured, its charts alone
    layout.meshes = map.cut ? map.cut->charts : scene.layout.meshes;
    layout.instances = scene.layout.instances;
    return measureSeams(shapes, layout,
                        [&](std::uint32_t instance, const MeshPoint& point, glm::vec3 n) {
                            const Hit hit = hitOfPoint(shapes, instance, point, false);
                            return *lookUpIn(shapes, layout.meshes, map.pages, images, hit, n);
                        },
                        {.smooth = true, .samples = kSamples});
}

} // namespace limn
