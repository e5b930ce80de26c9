// SPDX-License-Identifier: MIT
#include "engine/picture/final_gather.h"

#include "engine/core/parallel.h"
#include "engine/picture/final_gather_walk.h"
#include "engine/picture/gather_stages.h"
#include "engine/picture/part_sink.h"

#include <algorithm>

#include <glm/gtc/constants.hpp>

namespace limn {

static bool asksForIt(const FieldRenderOptions& options) {
    return options.emitted && options.gatherRays > 0 && options.samplesPerPixel > 1 &&
           showsBouncedLight(options.view);
}

FinalGather::FinalGather(const TraceScene& trace, const IndirectField& field,
                         const LightmapLayout& layout, const FieldRenderOptions& options)
    : m_trace(trace), m_field(field), m_layout(layout), m_options(options),
      m_gather(asksForIt(options) ? std::optional(gatherScene(trace, field, *options.emitted,
                                                              layout, options.gatherRays))
                                  : std::nullopt),
      m_any(m_gather &&
            (m_gather->sources.any || std::ranges::any_of(trace.scene().lights, shines))),
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
            const Hit hit = m_trace.closestHit(m_rays.through(cell * (glm::vec2(x, y) + 0.5f)),
                                               TraceMask::Seen);
            const std::optional<SurfacePoint> p = hit ? surfacePoint(m_trace, hit) : std::nullopt;
            if (!p)
                continue;
            const FieldPoint point = fieldPoint(m_field, m_layout, m_trace.scene(), hit, *p);
            sum += greyOf(weightOf(*p) * sampleIrradiance(point));
        }
    return sum / (kColumns * kRows);
}

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

/// Samples the tile whose upper left pixel is (x, y), in both stages.
GatherTile FinalGather::tileOf(std::uint32_t x, std::uint32_t y) const {
    GatherTile tile{.x = x,
                    .y = y,
                    .width = std::min(kGatherTile, m_options.width - x),
                    .height = std::min(kGatherTile, m_options.height - y)};
    const GatherStages stages{m_options.samplesPerPixel, m_options.gatherRays, m_meanLight};
    takeStages(tile, stages,
               [&](std::uint32_t i, std::uint32_t j, std::uint32_t begin, std::uint32_t count,
                   const LightGuide* guide, std::vector<RayLight>* learned) {
                   return take({x + i, y + j}, begin, count, guide, learned);
               });
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
