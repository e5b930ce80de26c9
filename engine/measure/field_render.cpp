// SPDX-License-Identifier: MIT
#include "engine/measure/field_render.h"

#include "engine/core/parallel.h"
#include "engine/field/sample_field.h"
#include "engine/math/lobe.h"
#include "engine/reference/direct_light.h"
#include "engine/reference/path.h"
#include "engine/reference/pixel_rays.h"
#include "engine/reference/sampler.h"
#include "engine/reference/surface_point.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/scene/surface/reflection_lobe.h"

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
    std::vector<int> bands; ///< that each material reflects

    bool hasField() const { return field.lightmapWidth > 0 || field.gridSize.x > 0; }
};

glm::vec3 fieldIrradiance(const FieldContext& c, const Hit& hit, const SurfacePoint& p) {
    if (!c.hasField())
        return glm::vec3(0);
    return sampleIrradiance({c.field, c.layout, c.trace.scene(), hit.instance, hit.triangle, hit.u,
                             hit.v, p.position, p.normal, !hit.frontFace});
}

/// Specular reflection of the field's light.
glm::vec3 fieldReflection(const FieldContext& c, const Hit& hit, const GlossyPoint& g) {
    if (!c.hasField())
        return glm::vec3(0);
    const Scene& scene = c.trace.scene();
    const int bands = c.bands[scene.instances[hit.instance].material];
    const glm::vec3 n = g.surface.normal;
    const ReflectionLobe lobe =
        reflectionLobe(g.gloss.roughness, glm::clamp(glm::dot(n, g.toEye), 0.f, 1.f));
    const auto factors = c.windowedLobes ? windowedFactors(lobe.factors, bands) : lobe.factors;
    const glm::vec3 axis = lobeAxis(lobe, n, glm::reflect(-g.toEye, n));
    const glm::vec3 seen = sampleLobe({c.field, c.layout, scene, hit.instance, hit.triangle, hit.u,
                                       hit.v, g.surface.position, n, !hit.frontFace},
                                      axis, bands, factors);
    const bool hemisphere =
        hit.instance < c.layout.instances.size() && !c.layout.instances[hit.instance].uv.empty();
    const glm::vec3 radiance =
        hemisphere
            ? seen / hemisphereSeen(factors, bands, glm::dot(axis, g.surface.geometricNormal))
            : seen;
    return (g.gloss.F0 * lobe.share.x + lobe.share.y) * radiance;
}

glm::vec3 shadeLit(const FieldContext& c, const Hit& hit, const GlossyPoint& g,
                   const DirectSample& direct) {
    const SurfacePoint& p = g.surface;
    return p.emission + g.reflect(direct.irradiance, direct.toLight) +
           p.albedo / glm::pi<float>() * fieldIrradiance(c, hit, p) + fieldReflection(c, hit, g);
}

glm::vec3 shade(const FieldContext& c, const Ray& ray, float pickLight, glm::vec2 onLight) {
    const Hit hit = c.trace.closestHit(ray);
    if (!hit)
        return c.view == View::Lit ? skyRadiance(c.trace.scene().sky, ray.direction) : glm::vec3(0);
    const std::optional<SurfacePoint> p = surfacePoint(c.trace, hit);
    if (!p)
        return glm::vec3(0);
    std::uint64_t rays = 0;
    const auto direct = [&] { return sampleDirectLight(c.trace, *p, pickLight, onLight, rays); };
    const glm::vec3 reflectance = p->albedo / glm::pi<float>();
    switch (c.view) {
    case View::Lit:
        return shadeLit(c, hit, glossyPoint(c.trace, hit, ray, *p), direct());
    case View::Direct:
        return reflectance * direct().irradiance;
    case View::Indirect:
        return reflectance * fieldIrradiance(c, hit, *p);
    case View::Irradiance:
        return fieldIrradiance(c, hit, *p);
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
    FieldContext context{trace, field, layout, options.view, options.windowedLobes, {}};
    const int most = int(field.bands);
    for (const Material& m : trace.scene().materials)
        context.bands.push_back(options.allBands ? most
                                                 : receiverBands(*trace.scene().assets, m, most));
    const PixelRays pixelRays(options.camera, options.width, options.height);
    const std::size_t pixels = std::size_t(options.width) * options.height;
    ImageF image{options.width, options.height, std::vector<glm::vec3>(pixels)};
    const bool complete =
        parallelRanges(pixels, kTile, progress, "pixels", [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const glm::vec2 corner(float(i % options.width), float(i / options.width));
                glm::vec3 sum(0);
                for (std::uint32_t s = 0; s < options.samplesPerPixel; ++s) {
                    const Sampler sampler{mixBits(options.seed, std::uint32_t(i)), s};
                    sum += shade(context, pixelRays.through(corner + sampler.pair(0)),
                                 sampler.pair(1).x, sampler.pair(kOnLightDimension));
                }
                image.rgb[i] = sum / float(options.samplesPerPixel);
            }
        });
    return complete ? image : ImageF{};
}

} // namespace limn
