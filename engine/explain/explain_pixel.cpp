// SPDX-License-Identifier: MIT
#include "engine/explain/explain_pixel.h"

#include "engine/math/luminance.h"
#include "engine/measure/field_lobe.h"
#include "engine/measure/near_light.h"
#include "engine/measure/pixel_sample.h"
#include "engine/reference/direct_light.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

/// What a pixel shows, as means over its samples.
struct PixelParts {
    glm::vec3 sky{0};               ///< seen itself
    glm::vec3 emission{0};          ///< of the surfaces that are seen
    std::vector<glm::vec3> byLight; ///< direct light of each of Scene::lights
    /// Direct light of each of them by way of near surfaces, which the field is too coarse for.
    std::vector<glm::vec3> nearByLight;
    std::vector<glm::vec3> nearBySurface; ///< the same by way of each of Scene::instances
    FieldReading reading;                 ///< of the field: all other light
    std::vector<std::uint32_t> seen;
};

struct PixelReader {
    const ConvergedLight& lit;
    const PixelQuestion& question;
    const ExplainOptions& options;
    std::vector<int> bands;    ///< that each material reflects
    std::vector<bool> marches; ///< whether its reflections are marched
    NearLight near;
    PixelParts parts;

    float share() const { return 1 / float(question.samples); }

    void add(const PixelSample& sample) {
        const TraceScene& trace = *lit.trace;
        const Hit hit = trace.closestHit(sample.ray);
        if (!hit) {
            if (question.light == PixelLight::Radiance)
                parts.sky += share() * skyRadiance(trace.scene().sky, sample.ray.direction);
            return;
        }
        const std::optional<SurfacePoint> p = surfacePoint(trace, hit);
        if (!p)
            return;
        if (std::ranges::count(parts.seen, hit.instance) == 0)
            parts.seen.push_back(hit.instance);
        if (question.light == PixelLight::Irradiance)
            addArriving(sample, hit, *p);
        else
            addLeaving(sample, hit, *p);
    }

    bool hasField() const { return lit.field().lightmapWidth > 0 || lit.field().gridSize.x > 0; }

    FieldPoint pointOf(const Hit& hit, const SurfacePoint& p) const {
        return fieldPoint(lit.field(), *lit.layout, lit.trace->scene(), hit, p);
    }

    template <class Reflect>
    void addDirect(const PixelSample& sample, const SurfacePoint& p, const Reflect& reflect) {
        std::uint64_t rays = 0;
        const std::vector<Light>& lights = lit.trace->scene().lights;
        for (std::size_t l = 0; l < lights.size(); ++l)
            parts.byLight[l] += share() * reflect(sampleDirectLightFrom(*lit.trace, p, lights[l],
                                                                        sample.onLight, rays));
    }

    void addArriving(const PixelSample& sample, const Hit& hit, const SurfacePoint& p) {
        addDirect(sample, p, [](const DirectSample& d) { return d.irradiance; });
        if (hasField())
            addBounced(sample, hit, p, glm::vec3(share()));
    }

    bool isBlack(std::uint32_t instance) const {
        return std::ranges::count(options.black, instance) > 0;
    }

    /// Adds weight times the irradiance from bounces at the point.
    void addBounced(const PixelSample& sample, const Hit& hit, const SurfacePoint& p,
                    glm::vec3 weight) {
        const FieldPoint at = pointOf(hit, p);
        addIrradiance(at, weight, parts.reading);
        for (const NearSurface& s : findNearSurfaces(near, hit, p, sample.near)) {
            addRadiance(at, s.direction, -s.weight * weight, parts.reading);
            if (s.point && !isBlack(s.hit.instance))
                addNear(s, s.weight / glm::pi<float>() * s.point->albedo * weight);
        }
    }

    /// Adds weight times the irradiance of a near surface.
    void addNear(const NearSurface& s, glm::vec3 weight) {
        addIrradiance(pointOf(s.hit, *s.point), weight, parts.reading);
        std::uint64_t rays = 0;
        const std::vector<Light>& lights = lit.trace->scene().lights;
        for (std::size_t l = 0; l < lights.size(); ++l) {
            const glm::vec3 light =
                weight * sampleDirectLightFrom(*lit.trace, *s.point, lights[l],
                                               s.sampler.pair(kNearOnLight), rays)
                             .irradiance;
            parts.nearByLight[l] += light;
            parts.nearBySurface[s.hit.instance] += light;
        }
    }

    void addLeaving(const PixelSample& sample, const Hit& hit, SurfacePoint p) {
        if (isBlack(hit.instance))
            p.albedo = glm::vec3(0);
        const GlossyPoint g = glossyPoint(*lit.trace, hit, sample.ray, p);
        parts.emission += share() * p.emission;
        addDirect(sample, p,
                  [&](const DirectSample& d) { return g.reflect(d.irradiance, d.toLight); });
        if (!hasField())
            return;
        const Scene& scene = lit.trace->scene();
        addBounced(sample, hit, p, p.albedo * (share() / glm::pi<float>()));
        const FieldPoint at = pointOf(hit, p);
        const std::uint32_t material = scene.instances[hit.instance].material;
        if (lit.field().marched && marches[material]) {
            const MarchedReflection found = marchReflection(*lit.field().marched, *lit.trace, g);
            parts.reading.marched.push_back({found.at, found.weight * share()});
            return;
        }
        const FieldLobe lobe = fieldLobe(at, g, bands[material], true);
        addLobe(at, lobe.axis, lobe.bands, lobe.factors, lobe.weight * share(), parts.reading);
    }
};

/// Adds rows below one of their sum, if there are any.
void addGroup(std::vector<LightRow>& rows, const char* label, const std::vector<LightRow>& group) {
    if (!group.empty())
        addRows(rows, group, addRow(rows, {.label = label, .value = totalOf(group)}));
}

/// The light of each of Scene::lights.
std::vector<LightRow> lightRows(const Scene& scene, const std::vector<glm::vec3>& byLight) {
    std::vector<LightRow> rows;
    for (std::uint32_t l = 0; l < byLight.size(); ++l)
        if (byLight[l] != glm::vec3(0))
            addRow(rows, {.kind = LightRowKind::Light,
                          .label = scene.lights[l].name,
                          .index = l,
                          .value = byLight[l]});
    return rows;
}

/// The rows that both tables begin with.
std::vector<LightRow> straightRows(const Scene& scene, const PixelParts& parts) {
    std::vector<LightRow> rows;
    if (parts.sky != glm::vec3(0))
        addRow(rows, {.kind = LightRowKind::Sky, .label = "Sky behind", .value = parts.sky});
    if (parts.emission != glm::vec3(0))
        addRow(rows, {.label = "Emitted here", .value = parts.emission});
    addGroup(rows, "Direct", lightRows(scene, parts.byLight));
    return rows;
}

/// Direct light by way of each near surface.
std::vector<LightRow> nearSurfaceRows(const Scene& scene, const PixelParts& parts) {
    std::vector<LightRow> rows;
    for (std::uint32_t i = 0; i < parts.nearBySurface.size(); ++i)
        if (parts.nearBySurface[i] != glm::vec3(0))
            addRow(rows, {.kind = LightRowKind::Surface,
                          .label = objectLabel(scene, i),
                          .index = i,
                          .value = parts.nearBySurface[i]});
    return rows;
}

constexpr const char* kNearLabel = "Direct light on what is near";

} // namespace

PixelExplanation explainPixel(const ConvergedLight& lit, const PixelQuestion& question,
                              const ExplainOptions& options) {
    const Scene& scene = lit.trace->scene();
    PixelReader reader{lit,
                       question,
                       options,
                       reflectedBands(scene, lit.field()),
                       marchedReflections(scene),
                       nearLight(*lit.trace, lit.field(), *lit.layout, question.nearRays),
                       {}};
    reader.parts.byLight.assign(scene.lights.size(), glm::vec3(0));
    reader.parts.nearByLight = reader.parts.byLight;
    reader.parts.nearBySurface.assign(scene.instances.size(), glm::vec3(0));
    const PixelRays rays(question.camera, question.width, question.height);
    for (std::uint32_t s = 0; s < question.samples; ++s)
        reader.add(PixelSample(rays, question.seed, question.y * question.width + question.x, s));
    PixelExplanation result;
    const Explanation indirect = lit.lighting->explain(scene, reader.parts.reading, options);
    result.tables.byOrigin = result.tables.bySender = straightRows(scene, reader.parts);
    addGroup(result.tables.byOrigin, kNearLabel, lightRows(scene, reader.parts.nearByLight));
    addGroup(result.tables.bySender, kNearLabel,
             strongest(nearSurfaceRows(scene, reader.parts), options.rows));
    addGroup(result.tables.byOrigin, "Indirect", indirect.byOrigin);
    addGroup(result.tables.bySender, "Indirect", indirect.bySender);
    result.tables.bounces = indirect.bounces;
    result.total = totalOf(result.tables.byOrigin);
    result.seen = std::move(reader.parts.seen);
    return result;
}

double shareOf(glm::vec3 value, glm::vec3 total) {
    const double all = luminance(glm::dvec3(total));
    return all > 0 ? luminance(glm::dvec3(value)) / all : 0;
}

glm::vec3 lightWithout(const ConvergedLight& lit, const PixelQuestion& question,
                       const Muted& muted) {
    const PixelExplanation e = explainPixel(lit, question, {.black = muted.surfaces});
    const auto isMuted = [&](const LightRow& row) {
        return row.kind == LightRowKind::Sky ? muted.sky
                                             : row.kind == LightRowKind::Light &&
                                                   std::ranges::count(muted.lights, row.index) > 0;
    };
    glm::vec3 left = e.total;
    for (const LightRow& row : e.tables.byOrigin)
        if (isMuted(row))
            left -= row.value;
    return left;
}

} // namespace limn
