// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/picture/field_render.h"
#include "engine/picture/gather_point.h"
#include "engine/picture/gathered_light.h"
#include "engine/picture/pixel_sample.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

/// Final gathering: what rays from a picture's pixels find takes the place of the field's light, as
/// far as that is better. The field's light is a control variate: samples estimate the difference.
/// Reichert. A Two-Pass Radiosity Method Driven by Lights and Viewer Position. 1992
///
/// Emitted light of the sky and of surfaces is sampled. Bounced light is estimated by rays: it is
/// the direct light and the field's light where they end. Thus texels blur light one bounce away,
/// not where it is seen. A ray that is shorter than some of these texels' widths is continued by a
/// path. So light that comes from near surfaces needs no rays of its own (near_light.h).
///
/// Samples are taken in two stages (gather_stages.h). In the first, pixels have as many samples as
/// the picture. In the second, they have samples in proportion to the standard deviation of the
/// first ones. A guide samples directions of the second stage in proportion to the light that the
/// pixels of the same tile have found there.
///
/// Where the field is about right, the difference is noise alone. So each pixel shows its
/// difference, and the mean of those around it, times shrinkage factors (shrinkDifference()).
class FinalGather {
public:
    /// Prepares for pictures that are drawn with these arguments, which outlive the object.
    FinalGather(const TraceScene& trace, const IndirectField& field, const LightmapLayout& layout,
                const FieldRenderOptions& options);

    /// Whether the options ask for gathering, the view shows bounced light, and there is any light.
    /// Pictures of one sample a pixel are not gathered, because one sample has no variance.
    bool any() const { return m_any; }

    /// Adds the bounced light of diffuse surfaces to a picture of the options' size that has none
    /// yet. Returns false when cancelled. Precondition: any().
    bool addTo(ImageF& image, const Progress& progress = {}) const;

    /// Does the same in steps: gathers rows of tiles, [first, last), of the whole picture, whose
    /// light addGathered() adds.
    bool gatherRows(GatheredLight& light, std::uint32_t first, std::uint32_t last,
                    const Progress& progress = {}) const;
    /// Number of rows of tiles, each kGatherTile pixels high.
    std::uint32_t tileRows() const { return (m_options.height + kGatherTile - 1) / kGatherTile; }
    PixelRect picture() const { return {{0, 0}, {m_options.width, m_options.height}}; }

    /// Walks the light that addTo() adds to one pixel: hands each of its terms to a sink. In
    /// final_gather_walk.h. Precondition: any().
    template <GatherSink Sink>
    void walk(std::uint32_t x, std::uint32_t y, Sink& sink) const;

private:
    glm::vec3 weightOf(const SurfacePoint& p) const;
    double meanLight() const;
    GatherTile tileOf(std::uint32_t x, std::uint32_t y) const;
    GatherSamples take(glm::uvec2 pixel, std::uint32_t begin, std::uint32_t count,
                       const LightGuide* guide, std::vector<RayLight>* learned) const;
    /// Walks sample s of a pixel, and returns its weightOf(). `guide` samples directions of the
    /// second stage; it is null in the first one.
    template <GatherSink Sink>
    glm::vec3 walkSample(glm::uvec2 pixel, std::uint32_t s, const LightGuide* guide,
                         const PartWeights& partWeights, Sink& sink) const;
    /// Walks all samples of a pixel of the tile.
    template <GatherSink Sink>
    void walkPixel(const GatherTile& tile, glm::uvec2 pixel, const PartWeights& partWeights,
                   Sink& sink) const;
    const TraceScene& m_trace;
    const IndirectField& m_field;
    const LightmapLayout& m_layout;
    const FieldRenderOptions& m_options;
    std::optional<GatherScene> m_gather; ///< absent where the options ask for no gathering
    bool m_any;
    PixelRays m_rays;
    double m_meanLight = 0; ///< mean of the field's light in the picture
};

} // namespace limn
