// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/texel_sharing.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/chart_crossings.h"

#include <array>
#include <cmath>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

constexpr std::array<glm::ivec2, 4> kSteps = SharingLinks::kSteps;

/// A piece of a chart: maps places of texels in the atlas to the plane of the chart.
struct PieceFrame {
    std::uint32_t chart = 0; ///< of the cut mesh
    glm::mat2 toChart{1}, toAtlas{1};
    glm::vec2 inAtlas{0}, inChart{0}; ///< the same point

    glm::vec2 chartAt(glm::vec2 place) const { return inChart + toChart * (place - inAtlas); }
    glm::vec2 placeAt(glm::vec2 uv) const { return inAtlas + toAtlas * (uv - inChart); }
};

/// The pieces of an instance whose charts are cut.
struct InstancePieces {
    std::vector<std::vector<PieceFrame>> ofChart; ///< per chart before; empty: nothing is cut
    std::vector<std::optional<PieceFrame>> piece; ///< per chart of the cut mesh
};

struct SharingFinder {
    const SideFinder& sides;
    const CutScene& cut;
    const LitTexels& lit;
    const std::vector<TexelSide>& side;
    std::vector<InstancePieces> pieces; ///< per instance

    const MeshCharts& chartsOf(std::uint32_t instance) const {
        return cut.charts[cut.scene.instances[instance].mesh];
    }
    std::uint32_t chartOf(std::uint32_t t) const {
        const AtlasTexel& texel = lit.atlas.texels[t];
        return chartOfTexel(chartsOf(texel.instance), texel);
    }
    const MeshCharts& chartsBefore(std::uint32_t instance) const {
        return sides.atlas.layout.meshes[sides.trace.scene().instances[instance].mesh];
    }
    glm::vec2 chartUvOf(std::uint32_t t) const {
        const AtlasTexel& texel = lit.atlas.texels[t];
        return chartUvAt(chartsBefore(texel.instance),
                         cut.toSource(texel.instance, texel.points[0]));
    }
    InstancePieces piecesOf(std::uint32_t instance) const;
    bool isOpenBetween(std::uint32_t a, std::uint32_t b) const {
        return side[a].open && side[b].open && sides.sees(side[a].points[0], side[b].points[0]);
    }
    std::uint32_t nextInRow(std::uint32_t t, std::uint32_t way) const;
    void linkAcross(std::uint32_t t, std::uint32_t way, SharingLinks& links) const;
    SharingLinks linksForward(std::uint32_t t) const;
    void completeLinks(std::uint32_t t, std::vector<SharingLinks>& all) const;
};

/// The map of a triangle of the cut mesh; std::nullopt where it has no area.
std::optional<PieceFrame> frameOf(const std::array<glm::vec2, 3>& inAtlas,
                                  const std::array<glm::vec2, 3>& inChart) {
    const glm::mat2 atlas(inAtlas[1] - inAtlas[0], inAtlas[2] - inAtlas[0]),
        chart(inChart[1] - inChart[0], inChart[2] - inChart[0]);
    if (!(std::abs(glm::determinant(atlas)) > 0) || !(std::abs(glm::determinant(chart)) > 0))
        return std::nullopt;
    PieceFrame frame;
    frame.toChart = chart * glm::inverse(atlas);
    frame.toAtlas = atlas * glm::inverse(chart);
    frame.inAtlas = inAtlas[0];
    frame.inChart = inChart[0];
    const auto isFinite = [](const glm::mat2& m) {
        return std::isfinite(m[0].x + m[0].y + m[1].x + m[1].y);
    };
    return isFinite(frame.toChart) && isFinite(frame.toAtlas) ? std::optional(frame) : std::nullopt;
}

/// Takes each piece's map from its largest triangle.
InstancePieces SharingFinder::piecesOf(std::uint32_t instance) const {
    InstancePieces found;
    const LightmapLayout& layout = lit.atlas.layout;
    if (!cut.sources[instance] || layout.instances[instance].uv.empty())
        return found;
    const MeshCharts& charts = chartsOf(instance);
    const glm::vec2 size(float(layout.width), float(layout.height));
    std::vector<float> area(charts.chartSize.size(), 0);
    found.piece.resize(charts.chartSize.size());
    for (std::uint32_t triangle = 0; triangle < charts.chartOfTriangle.size(); ++triangle) {
        std::array<glm::vec2, 3> inAtlas, inChart;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const MeshPoint corner{triangle, {k == 1 ? 1.f : 0.f, k == 2 ? 1.f : 0.f}};
            const std::uint32_t vertex = charts.indices[3 * std::size_t(triangle) + k];
            inAtlas[k] = layout.instances[instance].uv[vertex] * size - 0.5f;
            inChart[k] = chartUvAt(chartsBefore(instance), cut.toSource(instance, corner));
        }
        const std::uint32_t chart = charts.chartOfTriangle[triangle];
        const std::optional<PieceFrame> frame = frameOf(inAtlas, inChart);
        const float here =
            std::abs(glm::determinant(glm::mat2(inChart[1] - inChart[0], inChart[2] - inChart[0])));
        if (!frame || here <= area[chart])
            continue;
        area[chart] = here;
        found.piece[chart] = frame;
        found.piece[chart]->chart = chart;
    }
    found.ofChart.resize(chartsBefore(instance).chartSize.size());
    for (std::uint32_t c = 0; c < found.piece.size(); ++c)
        if (found.piece[c])
            found.ofChart[cut.chartBefore(instance, c).chart].push_back(*found.piece[c]);
    return found;
}

/// The next texel of the same chart in the atlas, or kNoTexel.
std::uint32_t SharingFinder::nextInRow(std::uint32_t t, std::uint32_t way) const {
    const AtlasTexel& texel = lit.atlas.texels[t];
    const glm::ivec2 size(int(lit.atlas.layout.width), int(lit.atlas.layout.height)),
        place = glm::ivec2(int(texel.texel) % size.x, int(texel.texel) / size.x) + kSteps[way];
    if (place.x < 0 || place.y < 0 || place.x >= size.x || place.y >= size.y)
        return kNoTexel;
    const std::uint32_t next = lit.texelAt[std::size_t(place.y) * std::size_t(size.x) + place.x];
    if (next == kNoTexel)
        return kNoTexel;
    const AtlasTexel& other = lit.atlas.texels[next];
    const bool isTogether =
        other.instance == texel.instance && other.back == texel.back && chartOf(next) == chartOf(t);
    return isTogether ? next : kNoTexel;
}

/// Links a texel at the end of a piece to the one of the next piece that has a point closest to
/// where its next neighbour would be.
void SharingFinder::linkAcross(std::uint32_t t, std::uint32_t way, SharingLinks& links) const {
    const AtlasTexel& texel = lit.atlas.texels[t];
    const InstancePieces& here = pieces[texel.instance];
    const std::uint32_t chart = chartOf(t);
    if (here.ofChart.empty() || chart == kMixedCharts || !here.piece[chart])
        return;
    const LightmapLayout& layout = lit.atlas.layout;
    const glm::vec2 size(float(layout.width), float(layout.height)),
        back(0, texel.back != 0 ? float(layout.instances[texel.instance].backRows) : 0.f),
        place =
            glm::vec2(float(texel.texel % layout.width), float(texel.texel / layout.width)) - back;
    const PieceFrame& frame = *here.piece[chart];
    const glm::vec2 beyond = frame.chartAt(place + glm::vec2(kSteps[way])),
                    step = beyond - frame.chartAt(place);
    float closest = glm::dot(step, step);
    for (const PieceFrame& other : here.ofChart[cut.chartBefore(texel.instance, chart).chart]) {
        const glm::vec2 there = glm::round(other.placeAt(beyond) + back);
        const bool isInside = there.x >= 0 && there.y >= 0 && there.x < size.x && there.y < size.y;
        if (other.chart == chart || !isInside)
            continue;
        const std::uint32_t next =
            lit.texelAt[std::size_t(there.y) * layout.width + std::size_t(there.x)];
        if (next == kNoTexel || lit.atlas.texels[next].instance != texel.instance ||
            lit.atlas.texels[next].back != texel.back || chartOf(next) != other.chart)
            continue;
        const glm::vec2 offset = chartUvOf(next) - beyond;
        const glm::mat2 turn = other.toAtlas * frame.toChart;
        if (glm::dot(offset, offset) >= closest || glm::determinant(turn) <= 0 ||
            !isOpenBetween(t, next))
            continue;
        closest = glm::dot(offset, offset);
        const float quarters =
            std::atan2(turn[0].y - turn[1].x, turn[0].x + turn[1].y) / glm::half_pi<float>();
        links.next[way] = lit.atlas.texels[next].texel;
        links.turn[way] = std::uint8_t((int(std::lround(quarters)) + 4) % 4);
    }
}

/// Links a texel to those to its right and below.
SharingLinks SharingFinder::linksForward(std::uint32_t t) const {
    SharingLinks links;
    for (const std::uint32_t way : {0U, 1U}) {
        const std::uint32_t next = nextInRow(t, way);
        if (next != kNoTexel && isOpenBetween(t, next))
            links.next[way] = lit.atlas.texels[next].texel;
    }
    return links;
}

/// Adds the links to the left, above, and across the ends of pieces.
void SharingFinder::completeLinks(std::uint32_t t, std::vector<SharingLinks>& all) const {
    const std::uint32_t place = lit.atlas.texels[t].texel;
    SharingLinks& links = all[place];
    for (std::uint32_t way = 0; way < kSteps.size(); ++way) {
        const std::uint32_t next = nextInRow(t, way);
        if (next == kNoTexel) {
            linkAcross(t, way, links);
            continue;
        }
        const std::uint32_t nextPlace = lit.atlas.texels[next].texel;
        if (way >= 2 && all[nextPlace].next[way - 2] == place)
            links.next[way] = nextPlace;
    }
}

} // namespace

std::vector<SharingLinks> findSharing(const SideFinder& sides, const CutScene& cut,
                                      const LitTexels& lit, const std::vector<TexelSide>& side,
                                      const Progress& progress) {
    SharingFinder finder{sides, cut, lit, side, {}};
    for (std::uint32_t i = 0; i < cut.scene.instances.size(); ++i)
        finder.pieces.push_back(finder.piecesOf(i));
    constexpr std::size_t kGrain = 64;
    std::vector<SharingLinks> links(lit.texelAt.size());
    const bool done = parallelRanges(
        side.size(), kGrain, progress, "texels", [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t)
                links[lit.atlas.texels[t].texel] = finder.linksForward(std::uint32_t(t));
        });
    // Of another texel's links, completeLinks() reads those forward alone, and changes none.
    if (done)
        parallelRanges(side.size(), kGrain, progress, "texels",
                       [&](std::size_t begin, std::size_t end) {
                           for (std::size_t t = begin; t < end; ++t)
                               finder.completeLinks(std::uint32_t(t), links);
                       });
    return links;
}

} // namespace limn
