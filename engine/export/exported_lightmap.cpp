// SPDX-License-Identifier: MIT
#include "engine/export/exported_lightmap.h"

#include "engine/export/lightmap_error.h"
#include "engine/export/lightmap_file.h"
#include "engine/files/ktx2.h"
#include "engine/final_lightmap/final_lightmap.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr std::uint32_t kMaxTexels = 1U << 24; ///< of a final lightmap
/// Doubling the texels is in vain where it leaves more than this part of the error.
constexpr double kMinGain = 0.95;

Result<ExportedLightmap> draftLightmap(const ExportScene& scene, const ExportSettings& settings,
                                       PageCount pageCount, const Progress& progress) {
    ExportedLightmap map;
    if (pageCount == PageCount::One) {
        const Result<std::uint32_t> detail = lightmapDetail(scene.layout, settings);
        if (!detail)
            return tl::make_unexpected(detail.error());
        map.pages = onePage(scene.scene, scene.layout, *detail);
    } else {
        Result<LightmapPages> pages = exportPages(scene, settings);
        if (!pages)
            return tl::make_unexpected(pages.error());
        map.pages = std::move(*pages);
    }
    Result<std::vector<LightmapImage>> images =
        lightmapImages(scene, settings, map.pages, progress);
    if (!images)
        return tl::make_unexpected(images.error());
    map.images = std::move(*images);
    return map;
}

/// Area of all sides that have texels [m^2]; objects that ask for other densities than the rest
/// count for as much as they get.
double weightedArea(const ExportScene& scene) {
    double area = 0;
    for (std::size_t i = 0; i < scene.layout.instances.size(); ++i) {
        const InstanceLightmap& place = scene.layout.instances[i];
        const Instance& instance = scene.scene.instances[i];
        if (!place.uv.empty())
            area += worldArea(scene.scene, instance) * (place.backRows > 0 ? 2 : 1) *
                    std::pow(double(instance.texelDensity), 2);
    }
    return area;
}

/// Number of texels that a final lightmap is to have; more than kMaxTexels where the density asks
/// for them.
double finalTexels(const ExportScene& scene, const ExportSettings& settings) {
    if (settings.texelsPerMetre > 0)
        return std::max(std::pow(double(settings.texelsPerMetre), 2) * weightedArea(scene), 1.0);
    if (settings.texels > 0)
        return settings.texels;
    const std::uint64_t draft =
        std::uint64_t(scene.layout.width) * scene.layout.height * settings.detail * settings.detail;
    // About a tenth of an atlas lies between its charts.
    return double(std::clamp<std::uint64_t>(draft * 9 / 10, 1, kMaxTexels));
}

LightmapImage imageOfPage(const FinalLightmap& map, const LightmapPages& pages,
                          std::uint32_t page) {
    const PlainLightmap plain{.width = map.layout.width,
                              .height = map.layout.height,
                              .texels = {},
                              .texelAt = map.texelAt};
    const std::vector<std::uint32_t> texelAt = pageTexels(plain, pages, page);
    LightmapImage image{.width = pages.width, .height = pages.height, .layers = map.layers};
    image.rgb.resize(texelAt.size() * map.layers);
    for (std::uint32_t l = 0; l < map.layers; ++l)
        for (std::size_t t = 0; t < texelAt.size(); ++t)
            if (texelAt[t] != kNoTexel)
                image.rgb[l * texelAt.size() + t] = map.values[l * map.texels() + texelAt[t]];
    return image;
}

Result<ExportedLightmap> finalLightmap(const ExportScene& scene, const ExportSettings& settings,
                                       PageCount pageCount, const Progress& progress) {
    if (const Result<void> possible = checkLightmap(scene, settings); !possible)
        return tl::make_unexpected(possible.error());
    const double texels = finalTexels(scene, settings);
    if (texels > kMaxTexels)
        return fail(fmt::format("--lightmap-texels-per-metre: {:g} would be {:.0f} texels, and {} "
                                "are possible",
                                settings.texelsPerMetre, texels, kMaxTexels));
    const IndirectField dark; // its emitted light is part of what is gathered as bounced light
    const FinalLightmapInput input{scene.trace, scene.layout, scene.field,
                                   scene.emitted ? *scene.emitted : dark};
    FinalLightmapOptions options{.texels = std::uint32_t(texels),
                                 .quantity = settings.quantity,
                                 .direct = settings.direct,
                                 .bands = settings.bands};
    options.maxSide = settings.maxSize;
    options.onePage = pageCount == PageCount::One;
    options.cutCharts = !settings.keepTriangles;
    std::optional<FinalLightmap> map = makeFinalLightmap(input, options, progress);
    if (!map)
        return fail("cancelled");
    ExportedLightmap exported;
    exported.cut = std::make_shared<const CutScene>(std::move(map->cut));
    const Scene& cut = exported.cut->scene;
    exported.pages = options.onePage ? onePage(cut, map->layout, 1)
                                     : lightmapPages(cut, map->layout, 1, settings.maxSize);
    for (std::uint32_t page = 0; page < exported.pages.count; ++page)
        exported.images.push_back(imageOfPage(*map, exported.pages, page));
    return exported;
}

} // namespace

Result<ExportedLightmap> exportedLightmap(const ExportScene& scene, const ExportSettings& settings,
                                          PageCount pageCount, const Progress& progress) {
    return settings.quality == LightmapQuality::Final
               ? finalLightmap(scene, settings, pageCount, progress)
               : draftLightmap(scene, settings, pageCount, progress);
}

/// Replaces the texels by those that a program reads from the files.
static Result<void> readBack(const std::vector<ExportFile>& files, const ExportSettings& settings,
                             std::vector<LightmapImage>& images) {
    if (settings.encoding == TextureEncoding::Exr)
        return {}; // it holds every number as it is
    for (std::size_t page = 0; page < files.size(); ++page) {
        const std::string& bytes = files[page].bytes;
        const Result<Ktx2Texture> texture =
            decodeKtx2({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, {});
        if (!texture)
            return tl::make_unexpected(texture.error());
        for (std::size_t t = 0; t < texture->texels.size(); ++t)
            images[page].rgb[t] = glm::vec3(texture->texels[t]);
    }
    return {};
}

static Result<WrittenLightmap> writeOnce(const ExportScene& scene, const ExportSettings& settings,
                                         const std::string& stem, const Progress& progress) {
    Result<ExportedLightmap> map = exportedLightmap(scene, settings, PageCount::Any, progress);
    if (!map)
        return tl::make_unexpected(map.error());
    Result<std::vector<ExportFile>> files = lightmapFiles(map->images, settings, stem);
    if (!files)
        return tl::make_unexpected(files.error());
    if (const Result<void> read = readBack(*files, settings, map->images); !read)
        return tl::make_unexpected(read.error());
    WrittenLightmap written{.cut = map->cut,
                            .pages = std::move(map->pages),
                            .first = {},
                            .files = std::move(*files),
                            .error = std::nullopt,
                            .seams = std::nullopt};
    if (const SeamError seams = exportedSeams(scene, written, map->images); seams.length > 0)
        written.files.front().seams = written.seams = seams;
    if (scene.camera && (settings.paths > 0 || settings.error > 0)) {
        LightmapErrorOptions options{.camera = *scene.camera};
        const std::uint32_t points = options.pointsPerSide * options.pointsPerSide;
        options.paths = std::max((settings.paths + points - 1) / points, 1U);
        const Result<Comparison> error =
            lightmapError(scene, written, map->images, settings, options, progress);
        if (!error && (settings.error > 0 || progress.cancelled()))
            return tl::make_unexpected(error.error());
        if (error)
            written.files.front().error = written.error = *error;
    }
    written.first = std::move(map->images.front());
    written.first.rgb.clear();
    return written;
}

Result<WrittenLightmap> writtenLightmap(const ExportScene& scene, const ExportSettings& wanted,
                                        const std::string& stem, const Progress& progress) {
    if (const Result<void> fits = checkEncoding(wanted, wanted.bands * wanted.bands); !fits)
        return tl::make_unexpected(fits.error()); // before minutes of work
    ExportSettings settings = wanted;
    for (double before = std::numeric_limits<double>::infinity();;) {
        Result<WrittenLightmap> written = writeOnce(scene, settings, stem, progress);
        if (!written || !(settings.error > 0) || !written->error ||
            written->error->nrmse <= double(settings.error))
            return written;
        const double nrmse = written->error->nrmse;
        const auto texels = std::uint32_t(finalTexels(scene, settings));
        if (nrmse > kMinGain * before || texels > kMaxTexels / 2)
            return fail(fmt::format("error: it is {:.3f} with {} texels, not {:g}, and more texels "
                                    "hardly reduce it",
                                    nrmse, texels, settings.error));
        before = nrmse;
        settings.texels = 2 * texels;
        settings.texelsPerMetre = 0;
    }
}

ExportForecast forecastLightmapOf(const ExportScene& scene, const ExportSettings& settings,
                                  PageCount pageCount) {
    if (settings.quality == LightmapQuality::Draft)
        return pageCount == PageCount::One ? forecastLightmap(scene.layout, settings)
                                           : forecastPages(scene, settings);
    const double texels = std::min(finalTexels(scene, settings), double(kMaxTexels)) / 0.9;
    const auto side = std::uint32_t(std::ceil(std::sqrt(texels)));
    ExportForecast f{.width = std::min(side, settings.maxSize),
                     .height = std::min(side, settings.maxSize)};
    if (pageCount == PageCount::Any)
        f.pages = std::uint32_t(std::ceil(texels / (double(settings.maxSize) * settings.maxSize)));
    f.bytes = lightmapBytes(std::uint64_t(f.width) * f.height * f.pages, settings);
    return f;
}

} // namespace limn
