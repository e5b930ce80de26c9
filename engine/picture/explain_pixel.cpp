// SPDX-License-Identifier: MIT
#include "engine/picture/explain_pixel.h"

#include "engine/math/luminance.h"
#include "engine/picture/final_gather_walk.h"
#include "engine/picture/pixel_walk.h"
#include "engine/picture/reading_sink.h"

#include <algorithm>
#include <utility>

namespace limn {

namespace {

/// The options with which renderField() draws the picture of the question's pixel.
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
        options.emitted = lit.lighting->emittedField(*lit.scene);
    return options;
}

/// Adds a row for the sum of `group` and the group's rows below it, if there are any.
void addGroup(std::vector<LightRow>& rows, const char* label, const std::vector<LightRow>& group) {
    if (!group.empty())
        addRows(rows, group, addRow(rows, {.label = label, .value = totalOf(group)}));
}

/// Rows of the direct light of each of Scene::lights.
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

/// The rows that both tables begin with: light of what the pixel sees itself.
std::vector<LightRow> seenRows(const Scene& scene, const PixelParts& parts) {
    std::vector<LightRow> rows;
    if (parts.sky != glm::vec3(0))
        addRow(rows, {.kind = LightRowKind::Sky, .label = "Sky behind", .value = parts.sky});
    if (parts.emission != glm::vec3(0))
        addRow(rows, {.label = "Emitted here", .value = parts.emission});
    addGroup(rows, "Direct", lightRows(scene, parts.byLight));
    return rows;
}

/// Rows of the light that each of Scene::instances sends.
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

/// Rows of gathered light by light, surface or sky.
std::vector<LightRow> gatheredRows(const Scene& scene, const PixelParts::Gathered& gathered) {
    std::vector<LightRow> rows = lightRows(scene, gathered.byLight);
    addRows(rows, surfaceRows(scene, gathered.bySurface), LightRow::kNone);
    if (gathered.sky != glm::vec3(0))
        addRow(rows, {.kind = LightRowKind::Sky, .label = "Sky", .value = gathered.sky});
    return rows;
}

constexpr const char* kNearLabel = "Direct light that near surfaces reflect";
constexpr const char* kEmittedLabel = "Emitted light from sky and surfaces";
constexpr const char* kBouncedLabel = "Gathered bounced light";

PixelParts readPixel(const ConvergedLight& lit, const PixelQuestion& question,
                     const ExplainOptions& options) {
    const FieldRenderOptions picture = pictureOptions(lit, question);
    const FinalGather gather(*lit.trace, lit.field(), *lit.layout, picture);
    const PixelSum sum =
        question.light == PixelLight::Radiance ? PixelSum::Radiance : PixelSum::Irradiance;
    const PixelWalk walk =
        pixelWalk(*lit.trace, lit.field(), *lit.layout, picture, sum, gather.any());
    const PixelRays rays(question.camera, question.width, question.height);
    const std::uint32_t pixel = question.y * question.width + question.x;
    ReadingSink sink(lit, options.black);
    sink.scaled(glm::vec3(1 / float(question.samples)), [&] {
        for (std::uint32_t s = 0; s < question.samples; ++s)
            walkPixel(walk, PixelSample(rays, question.seed, pixel, s), sink);
    });
    if (gather.any())
        gather.walk(question.x, question.y, sink);
    return std::move(sink.parts);
}

} // namespace

const char* unitOf(PixelLight light) {
    switch (light) {
    case PixelLight::Radiance:
        return "W m^-2 sr^-1";
    case PixelLight::Irradiance:
        return "W m^-2";
    }
    return "";
}

PixelExplanation explainPixel(const ConvergedLight& lit, const PixelQuestion& question,
                              const ExplainOptions& options) {
    const Scene& scene = lit.trace->scene();
    PixelParts parts = readPixel(lit, question, options);
    parts.reading.emitted = std::move(parts.emittedReading.entries);
    PixelExplanation result;
    const Explanation indirect = lit.lighting->explain(scene, parts.reading, options);
    result.tables.byOrigin = result.tables.bySender = seenRows(scene, parts);
    addGroup(result.tables.byOrigin, kNearLabel, lightRows(scene, parts.nearByLight));
    addGroup(result.tables.bySender, kNearLabel,
             strongest(surfaceRows(scene, parts.nearBySurface), options.rows));
    const std::vector<LightRow> emitted = gatheredRows(scene, parts.emitted);
    addGroup(result.tables.byOrigin, kEmittedLabel, emitted);
    addGroup(result.tables.bySender, kEmittedLabel, strongest(emitted, options.rows));
    addGroup(result.tables.byOrigin, kBouncedLabel, gatheredRows(scene, parts.bounced));
    addGroup(result.tables.bySender, kBouncedLabel,
             strongest(surfaceRows(scene, parts.bouncedVia), options.rows));
    addGroup(result.tables.byOrigin, "Indirect", indirect.byOrigin);
    addGroup(result.tables.bySender, "Indirect", indirect.bySender);
    result.tables.bounces = indirect.bounces;
    result.total = totalOf(result.tables.byOrigin);
    result.seen = std::move(parts.seen);
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
