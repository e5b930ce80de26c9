// SPDX-License-Identifier: MIT
#include "engine/picture/field_render.h"

#include "engine/core/parallel.h"
#include "engine/field/sample_field.h"
#include "engine/picture/field_lobe.h"
#include "engine/picture/final_gather.h"
#include "engine/picture/near_light.h"
#include "engine/picture/pixel_sample.h"
#include "engine/shading/direct_light.h"
#include "engine/shading/surface_point.h"

#include <cassert>
#include <optional>

#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

struct FieldContext {
    const TraceScene& trace;
    const IndirectField& field;
    const LightmapLayout& layout;
    View view;
    bool windowedLobes;
    std::vector<int> bands;    ///< that each material reflects
    std::vector<bool> marches; ///< whether its reflections are marched
    MarchedCounts* counts;
    NearLight near;
    bool gathers; ///< diffuse light is added by FinalGather

    bool hasField() const { return field.lightmapWidth > 0 || field.gridSize.x > 0; }
};

glm::vec3 fieldIrradiance(const FieldContext& c, const Hit& hit, const SurfacePoint& p,
                          const Sampler& nearSampler) {
    if (!c.hasField() || c.gathers)
        return glm::vec3(0);
    return sampleIrradiance(fieldPoint(c.field, c.layout, c.trace.scene(), hit, p)) +
           nearCorrection(c.near, hit, p, nearSampler);
}

/// Specular reflection of the field's light.
glm::vec3 fieldReflection(const FieldContext& c, const Hit& hit, const GlossyPoint& g) {
    if (!c.hasField())
        return glm::vec3(0);
    const Scene& scene = c.trace.scene();
    const std::uint32_t material = scene.instances[hit.instance].material;
    if (c.field.marched && c.marches[material]) {
        const MarchedReflection found = marchReflection(*c.field.marched, c.trace, g);
        if (c.counts) {
            ++c.counts->rays;
            c.counts->unknown += found.end == MarchEnd::Unknown ? 1 : 0;
        }
        return found.weight * marchedRadiance(*c.field.marched, found.at);
    }
    const FieldPoint at = fieldPoint(c.field, c.layout, scene, hit, g.surface);
    const FieldLobe lobe = fieldLobe(at, g, c.bands[material], c.windowedLobes);
    return lobe.weight * sampleLobe(at, lobe.axis, lobe.bands, lobe.factors);
}

glm::vec3 shadeLit(const FieldContext& c, const Hit& hit, const GlossyPoint& g,
                   const DirectSample& direct, glm::vec3 bounced) {
    const SurfacePoint& p = g.surface;
    return p.emission + g.reflect(direct.irradiance, direct.toLight) +
           p.albedo / glm::pi<float>() * bounced + fieldReflection(c, hit, g);
}

glm::vec3 shade(const FieldContext& c, const PixelSample& sample) {
    const Hit hit = c.trace.closestHit(sample.ray);
    if (!hit)
        return c.view == View::Lit ? skyRadiance(c.trace.scene().sky, sample.ray.direction)
                                   : glm::vec3(0);
    const std::optional<SurfacePoint> p = surfacePoint(c.trace, hit);
    if (!p)
        return glm::vec3(0);
    std::uint64_t rays = 0;
    const auto direct = [&] {
        return sampleDirectLight(c.trace, *p, sample.pickLight, sample.onLight, rays);
    };
    const auto bounced = [&] { return fieldIrradiance(c, hit, *p, sample.near); };
    const glm::vec3 reflectance = p->albedo / glm::pi<float>();
    switch (c.view) {
    case View::Lit:
        return shadeLit(c, hit, glossyPoint(c.trace, hit, sample.ray, *p), direct(), bounced());
    case View::Direct:
        return reflectance * direct().irradiance;
    case View::Indirect:
        return reflectance * bounced();
    case View::Irradiance:
        return bounced();
    case View::Albedo:
        return p->albedo;
    case View::Normals:
        return p->normal * 0.5f + 0.5f;
    }
    return glm::vec3(0);
}

} // namespace

ImageF renderField(const TraceScene& trace, const IndirectField& field,
                   const LightmapLayout& layout, const FieldRenderOptions& options,
                   const Progress& progress) {
    assert(options.width > 0 && options.height > 0 && options.samplesPerPixel > 0);
    constexpr std::size_t kTile = 256; // pixels
    const FinalGather gather(trace, field, layout, options);
    FieldContext context{.trace = trace,
                         .field = field,
                         .layout = layout,
                         .view = options.view,
                         .windowedLobes = options.windowedLobes,
                         .bands = {},
                         .marches = {},
                         .counts = options.marched,
                         .near =
                             nearLight(trace, field, layout, gather.any() ? 0 : options.nearRays),
                         .gathers = gather.any()};
    context.bands = options.allBands
                        ? std::vector<int>(trace.scene().materials.size(), int(field.bands))
                        : reflectedBands(trace.scene(), field);
    if (field.marched)
        context.marches = marchedReflections(trace.scene());
    const PixelRays pixelRays(options.camera, options.width, options.height);
    const std::size_t pixels = std::size_t(options.width) * options.height;
    ImageF image{options.width, options.height, std::vector<glm::vec3>(pixels)};
    const bool complete =
        parallelRanges(pixels, kTile, progress, "pixels", [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                glm::vec3 sum(0);
                for (std::uint32_t s = 0; s < options.samplesPerPixel; ++s) {
                    sum += shade(context, {pixelRays, options.seed, std::uint32_t(i), s});
                }
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
