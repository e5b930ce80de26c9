// SPDX-License-Identifier: MIT
#include "engine/picture/explain_pixel.h"

#include "engine/math/luminance.h"
#include "engine/picture/field_lobe.h"
#include "engine/picture/final_gather_read.h"
#include "engine/picture/near_light.h"
#include "engine/picture/pixel_sample.h"
#include "engine/shading/direct_light.h"

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
    /// Light that gathering found: straight from the sky and each of Scene::instances, and what
    /// else is not the field's, by where it comes from and by the instance that sends it here.
    struct Gathered {
        glm::vec3 sky{0};
        std::vector<glm::vec3> bySurface, byLight;
    };
    Gathered straight, bounced;
    std::vector<glm::vec3> bouncedVia;
    FieldReading reading; ///< of the field: all other light
    std::vector<std::uint32_t> seen;
};

struct PixelReader {
    const ConvergedLight& lit;
    const PixelQuestion& question;
    const ExplainOptions& options;
    std::vector<int> bands;    ///< that each material reflects
    std::vector<bool> marches; ///< whether its reflections are marched
    NearLight near;
    bool gathers; ///< diffuse light is readGathered()'s
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
        addBounced(sample, hit, p, glm::vec3(share()));
    }

    bool isBlack(std::uint32_t instance) const {
        return std::ranges::count(options.black, instance) > 0;
    }

    /// Adds weight times the irradiance from bounces at the point, unless that is gathered.
    void addBounced(const PixelSample& sample, const Hit& hit, const SurfacePoint& p,
                    glm::vec3 weight) {
        if (gathers || !hasField())
            return;
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
        addBounced(sample, hit, p, p.albedo * (share() / glm::pi<float>()));
        if (!hasField())
            return;
        const Scene& scene = lit.trace->scene();
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

/// Reads gathered light.
struct GatheredReader {
    const PixelReader& pixel;
    PixelParts& parts;
    FieldReading straight; ///< of the straight field

    bool shows(std::uint32_t instance) const {
        return pixel.question.light == PixelLight::Irradiance || reflects(instance);
    }
    bool reflects(std::uint32_t instance) const { return !pixel.isBlack(instance); }
    FieldReading& readingOf(const FieldPoint& at) {
        return &at.field == &pixel.lit.field() ? parts.reading : straight;
    }
    void fieldIrradiance(const FieldPoint& at, glm::vec3 weight, GatherPart /*part*/) {
        addIrradiance(at, weight, readingOf(at));
    }
    void directLight(const StraightSample& met, const Sampler& own, glm::vec3 weight,
                     std::uint32_t via) {
        std::uint64_t rays = 0;
        const std::vector<Light>& lights = pixel.lit.trace->scene().lights;
        for (std::size_t l = 0; l < lights.size(); ++l) {
            const glm::vec3 light = weight * sampleDirectLightFrom(*pixel.lit.trace, *met.point,
                                                                   lights[l], own.pair(1), rays)
                                                 .irradiance;
            parts.bounced.byLight[l] += light;
            parts.bouncedVia[via] += light;
        }
    }
    // Only guides learn from single rays.
    void rayBegins(const StraightSample& /*found*/) {}
    void rayEnds() {}
    void arrives(const FoundLight& from, glm::vec3 value, GatherPart part, std::uint32_t via) {
        PixelParts::Gathered& to = part == Straight ? parts.straight : parts.bounced;
        (from.instance == ~0U ? to.sky : to.bySurface[from.instance]) += value;
        if (part == Bounced)
            parts.bouncedVia[via] += value;
    }
};

/// With which a picture of the question's pixel is drawn.
FieldRenderOptions pictureOptions(const ConvergedLight& lit, const PixelQuestion& q) {
    FieldRenderOptions options;
    options.view = q.light == PixelLight::Radiance ? View::Lit : View::Irradiance;
    options.camera = q.camera;
    options.width = q.width;
    options.height = q.height;
    options.samplesPerPixel = q.samples;
    options.seed = q.seed;
    options.nearRays = q.nearRays;
    options.gatherRays = q.gatherRays;
    if (q.gatherRays > 0)
        options.straight = lit.lighting->straightField(*lit.scene);
    return options;
}

void readGathered(const FinalGather& gather, PixelReader& pixel) {
    const PixelQuestion& q = pixel.question;
    GatheredReader reader{pixel, pixel.parts, {}};
    gather.read(q.x, q.y, reader);
    pixel.parts.reading.straight = std::move(reader.straight.entries);
}

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

/// Light by way of each of Scene::instances.
std::vector<LightRow> surfaceRows(const Scene& scene, const std::vector<glm::vec3>& bySurface) {
    std::vector<LightRow> rows;
    for (std::uint32_t i = 0; i < bySurface.size(); ++i)
        if (bySurface[i] != glm::vec3(0))
            addRow(rows, {.kind = LightRowKind::Surface,
                          .label = objectLabel(scene, i),
                          .index = i,
                          .value = bySurface[i]});
    return rows;
}

/// Gathered light by where it comes from.
std::vector<LightRow> gatheredRows(const Scene& scene, const PixelParts::Gathered& gathered) {
    std::vector<LightRow> rows = lightRows(scene, gathered.byLight);
    addRows(rows, surfaceRows(scene, gathered.bySurface), LightRow::kNone);
    if (gathered.sky != glm::vec3(0))
        addRow(rows, {.kind = LightRowKind::Sky, .label = "Sky", .value = gathered.sky});
    return rows;
}

constexpr const char* kNearLabel = "Direct light on what is near";
constexpr const char* kStraightLabel = "Straight from sky and emissive surfaces";
constexpr const char* kBouncedLabel = "Gathered from what rays met";

} // namespace

PixelExplanation explainPixel(const ConvergedLight& lit, const PixelQuestion& question,
                              const ExplainOptions& options) {
    const Scene& scene = lit.trace->scene();
    const FieldRenderOptions picture = pictureOptions(lit, question);
    const FinalGather gather(*lit.trace, lit.field(), *lit.layout, picture);
    PixelReader reader{
        lit,
        question,
        options,
        reflectedBands(scene, lit.field()),
        marchedReflections(scene),
        nearLight(*lit.trace, lit.field(), *lit.layout, gather.any() ? 0 : question.nearRays),
        gather.any(),
        {}};
    reader.parts.byLight.assign(scene.lights.size(), glm::vec3(0));
    reader.parts.nearByLight = reader.parts.byLight;
    reader.parts.nearBySurface.assign(scene.instances.size(), glm::vec3(0));
    reader.parts.straight.bySurface = reader.parts.nearBySurface;
    reader.parts.bouncedVia = reader.parts.nearBySurface;
    reader.parts.bounced = {.bySurface = reader.parts.nearBySurface,
                            .byLight = reader.parts.byLight};
    const PixelRays rays(question.camera, question.width, question.height);
    for (std::uint32_t s = 0; s < question.samples; ++s)
        reader.add(PixelSample(rays, question.seed, question.y * question.width + question.x, s));
    if (gather.any())
        readGathered(gather, reader);
    PixelExplanation result;
    const Explanation indirect = lit.lighting->explain(scene, reader.parts.reading, options);
    result.tables.byOrigin = result.tables.bySender = straightRows(scene, reader.parts);
    addGroup(result.tables.byOrigin, kNearLabel, lightRows(scene, reader.parts.nearByLight));
    addGroup(result.tables.bySender, kNearLabel,
             strongest(surfaceRows(scene, reader.parts.nearBySurface), options.rows));
    const std::vector<LightRow> straight = gatheredRows(scene, reader.parts.straight);
    addGroup(result.tables.byOrigin, kStraightLabel, straight);
    addGroup(result.tables.bySender, kStraightLabel, strongest(straight, options.rows));
    addGroup(result.tables.byOrigin, kBouncedLabel, gatheredRows(scene, reader.parts.bounced));
    addGroup(result.tables.bySender, kBouncedLabel,
             strongest(surfaceRows(scene, reader.parts.bouncedVia), options.rows));
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
