// SPDX-License-Identifier: MIT
#include "engine/picture/final_gather.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/near_reach.h"
#include "engine/picture/final_gather_walk.h"
#include "engine/shading/direct_light.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace limn {

/// A pixel whose first stage has a standard error of this part of the picture's mean light gets as
/// many samples again, and others in proportion, up to kMaxSecondStage times as many.
static constexpr double kErrorToDouble = 0.125, kMaxSecondStage = 255;

/// Rays of a pixel's second stage; fewer are not worth taking.
static constexpr std::uint32_t kMinRays = 16;

static bool asksForIt(const FieldRenderOptions& options) {
    return options.emitted && options.gatherRays > 0 && options.samplesPerPixel > 1 &&
           showsBouncedLight(options.view);
}

static std::vector<float> texelWidths(const Scene& scene, const LightmapLayout& layout) {
    std::vector<float> widths = nearReaches(scene, layout);
    for (float& width : widths)
        width *= 2;
    return widths;
}

FinalGather::FinalGather(const TraceScene& trace, const IndirectField& field,
                         const LightmapLayout& layout, const FieldRenderOptions& options)
    : m_trace(trace), m_field(field), m_layout(layout), m_options(options),
      m_sources(asksForIt(options) ? findEmittedLightSources(trace) : EmittedLightSources{}),
      m_any(asksForIt(options) &&
            (m_sources.any || std::ranges::any_of(trace.scene().lights, shines))),
      m_widths(m_any ? texelWidths(trace.scene(), layout) : std::vector<float>()),
      m_rays(options.camera, options.width, options.height) {
    if (m_any)
        m_meanLight = meanLight();
}

/// Weight of irradiance in what the view shows.
glm::vec3 FinalGather::weightOf(const SurfacePoint& p) const {
    return m_options.view == View::Irradiance ? glm::vec3(1) : p.albedo / glm::pi<float>();
}

/// Mean of the field's light over the colours and over some points of the picture. The background
/// counts as dark, so surfaces that fill a small part of a picture get more samples a pixel.
double FinalGather::meanLight() const {
    constexpr std::uint32_t kColumns = 32, kRows = 18;
    const glm::vec2 cell = m_rays.size / glm::vec2(kColumns, kRows);
    double sum = 0;
    for (std::uint32_t y = 0; y < kRows; ++y)
        for (std::uint32_t x = 0; x < kColumns; ++x) {
            const Hit hit = m_trace.closestHit(m_rays.through(cell * (glm::vec2(x, y) + 0.5f)));
            const std::optional<SurfacePoint> p = hit ? surfacePoint(m_trace, hit) : std::nullopt;
            if (!p)
                continue;
            const FieldPoint point = fieldPoint(m_field, m_layout, m_trace.scene(), hit, *p);
            sum += greyOf(weightOf(*p) * sampleIrradiance(point));
        }
    return sum / (kColumns * kRows);
}

/// A sink that adds up the light of each part, which draws the picture. Of all lights it samples
/// one. Unless `rays` is null, it adds to it each ray and the light that the ray brings.
struct FinalGather::PartSink {
    const TraceScene& trace;
    std::vector<RayLight>* rays = nullptr;
    std::array<glm::vec3, kGatherParts> sums{};
    RayLight* ray = nullptr; ///< the last of `rays` while it is followed

    static constexpr bool reflects(std::uint32_t /*instance*/) { return true; }

    void rayBegins(const EmittedLightSample& sample) {
        if (rays && sample.weight > 0)
            ray = &rays->emplace_back(RayLight{sample.direction, sample.samples[2].pdf, 0});
    }
    void rayEnds() { ray = nullptr; }
    void add(glm::vec3 light, GatherPart part) {
        sums[part] += light;
        if (ray)
            ray->light += channelSum(light);
    }
    void fieldIrradiance(const FieldPoint& point, glm::vec3 weight, GatherPart part) {
        add(weight * sampleIrradiance(point), part);
    }
    void gatheredDirectLight(const SurfacePoint& p, const LightNumbers& numbers, glm::vec3 weight,
                             std::uint32_t /*via*/) {
        std::uint64_t shadowRays = 0;
        add(weight *
                sampleDirectLight(trace, p, numbers.pick, numbers.onLight, shadowRays).irradiance,
            Bounced);
    }
    void gatheredEmission(const IncidentLightSample& /*sample*/, glm::vec3 light, GatherPart part,
                          std::uint32_t /*via*/) {
        add(light, part);
    }
};

GatherSamples FinalGather::take(glm::uvec2 pixel, std::uint32_t begin, std::uint32_t count,
                                const LightGuide* guide, std::vector<RayLight>* learned) const {
    GatherSamples taken;
    taken.count = count;
    PartWeights whole;
    whole.fill(glm::vec3(1));
    for (std::uint32_t s = 0; s < count; ++s) {
        PartSink sink{m_trace, learned};
        taken.weight += walkSample(pixel, begin + s, guide, whole, sink);
        const bool half = s < count / 2;
        glm::vec3 all(0);
        for (std::uint32_t part = 0; part < kGatherParts; ++part) {
            taken.parts[part].add(sink.sums[part], half);
            all += sink.sums[part];
        }
        taken.all.add(all, half);
    }
    return taken;
}

/// The number of second-stage samples of a pixel whose first-stage samples have this variance.
std::uint32_t FinalGather::secondStageCount(double variance) const {
    if (!(m_meanLight > 0))
        return 0;
    const std::uint32_t count = m_options.samplesPerPixel;
    const double times = std::sqrt(variance / count) / (kErrorToDouble * m_meanLight);
    const auto second = std::uint32_t(std::min(times, kMaxSecondStage) * count);
    return second * m_options.gatherRays < kMinRays ? 0 : second;
}

/// Samples the tile whose upper left pixel is (x, y), in both stages.
GatherTile FinalGather::tileOf(std::uint32_t x, std::uint32_t y) const {
    GatherTile tile{.x = x,
                    .y = y,
                    .width = std::min(kGatherTile, m_options.width - x),
                    .height = std::min(kGatherTile, m_options.height - y)};
    const std::uint32_t count = m_options.samplesPerPixel;
    std::array<std::vector<RayLight>, 2> learned; // each by every other pixel
    const auto forEachPixel = [&](const auto& body) {
        for (std::uint32_t j = 0; j < tile.height; ++j)
            for (std::uint32_t i = 0; i < tile.width; ++i)
                body(i, j, j * kGatherTile + i);
    };
    forEachPixel([&](std::uint32_t i, std::uint32_t j, std::uint32_t p) {
        tile.firstStage[p] = take({x + i, y + j}, 0, count, nullptr, &learned[(i + j) % 2]);
    });
    tile.guide = learnGuide(learned[0], learned[1]);
    forEachPixel([&](std::uint32_t i, std::uint32_t j, std::uint32_t p) {
        const double variance = varianceAround(tile, i, j);
        tile.secondStage[p] =
            take({x + i, y + j}, count, secondStageCount(variance), &tile.guide, nullptr);
    });
    weighStages(tile);
    return tile;
}

bool FinalGather::gatherRows(GatheredLight& light, std::uint32_t firstRow, std::uint32_t lastRow,
                             const Progress& progress) const {
    const std::uint32_t columns = (m_options.width + kGatherTile - 1) / kGatherTile;
    return parallelRanges(std::size_t(columns) * (lastRow - firstRow), 1, progress, "gather",
                          [&](std::size_t first, std::size_t last) {
                              for (std::size_t t = first; t < last; ++t) {
                                  const auto row = firstRow + std::uint32_t(t / columns),
                                             column = std::uint32_t(t % columns);
                                  light.set(tileOf(column * kGatherTile, row * kGatherTile));
                              }
                          });
}

bool FinalGather::addTo(ImageF& image, const Progress& progress) const {
    GatheredLight light(picture());
    if (!gatherRows(light, 0, tileRows(), progress))
        return false;
    addGathered(image, light, picture());
    return true;
}

} // namespace limn
