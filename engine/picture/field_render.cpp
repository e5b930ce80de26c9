// SPDX-License-Identifier: MIT
#include "engine/picture/field_render.h"

#include "engine/core/parallel.h"
#include "engine/picture/final_gather.h"
#include "engine/picture/pixel_walk.h"
#include "engine/picture/value_sink.h"

#include <cassert>
#include <optional>

namespace limn {

/// The sum that a view shows; none for views of surfaces.
static std::optional<PixelSum> sumOf(View view) {
    switch (view) {
    case View::Lit:
        return PixelSum::Radiance;
    case View::Direct:
        return PixelSum::DirectDiffuse;
    case View::Indirect:
        return PixelSum::BouncedDiffuse;
    case View::Irradiance:
        return PixelSum::BouncedIrradiance;
    case View::Albedo:
    case View::Normals:
        return std::nullopt;
    }
    return std::nullopt;
}

/// What View::Albedo and View::Normals show of a surface.
static glm::vec3 surfaceColor(const TraceScene& trace, View view, const Ray& ray) {
    const Hit hit = trace.closestHit(ray, TraceMask::Seen);
    const std::optional<SurfacePoint> p = hit ? surfacePoint(trace, hit) : std::nullopt;
    if (!p)
        return glm::vec3(0);
    return view == View::Albedo ? p->albedo : p->normal * 0.5f + 0.5f;
}

ImageF renderField(const TraceScene& trace, const IndirectField& field,
                   const LightmapLayout& layout, const FieldRenderOptions& options,
                   const Progress& progress) {
    assert(options.width > 0 && options.height > 0 && options.samplesPerPixel > 0);
    constexpr std::size_t kTile = 256; // pixels
    const FinalGather gather(trace, field, layout, options);
    const std::optional<PixelSum> shown = sumOf(options.view);
    const PixelWalk walk =
        pixelWalk(trace, field, layout, options, shown.value_or(PixelSum::Radiance), gather.any());
    const auto colorOf = [&](const PixelSample& sample) {
        if (!shown)
            return surfaceColor(trace, options.view, sample.ray);
        ValueSink value{trace, options.reflections};
        walkPixel(walk, sample, value);
        return value.sum;
    };
    const PixelRays pixelRays(options.camera, options.width, options.height);
    const std::size_t pixels = std::size_t(options.width) * options.height;
    ImageF image{options.width, options.height, std::vector<glm::vec3>(pixels)};
    const bool complete =
        parallelRanges(pixels, kTile, progress, "pixels", [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                glm::vec3 sum(0);
                for (std::uint32_t s = 0; s < options.samplesPerPixel; ++s)
                    sum += colorOf({pixelRays, options.seed, std::uint32_t(i), s});
                image.rgb[i] = sum / float(options.samplesPerPixel);
            }
        });
    if (!complete)
        return {};
    if (gather.any() && !gather.addTo(image, progress))
        return {};
    return image;
}

} // namespace limn
