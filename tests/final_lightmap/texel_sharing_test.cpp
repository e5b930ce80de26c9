// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/fit_input.h"
#include "engine/final_lightmap/lit_texels.h"
#include "engine/lightmap/charts.h"
#include "engine/lightmap/plain_lightmap.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

namespace limn::texel_sharing_test {
namespace {

using namespace simple;

/// A floor of 4 m whose chart is cut in two along z = x / 2, of different densities.
struct CutFloor {
    Scene scene;
    std::vector<MeshCharts> charts;
    CutScene cut;
    LitTexels lit;

    explicit CutFloor(bool hasWall) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0.5f)));
        b.add(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
        if (hasWall)
            b.add(quad({-3, -1, -1.5f}, {6, 0, 3}, {0, 3, 0}));
        b.scene.sky.radiance = {1, 1, 1};
        scene = b.build();
        for (const Mesh& mesh : scene.assets->meshes)
            charts.push_back(buildCharts(mesh));
        // The line through three points of the floor, in the plane of its chart.
        const glm::vec2 a = chartUvOf({-2, 0, -1}), along = chartUvOf({2, 0, 1}) - a;
        const glm::vec2 across = glm::normalize(glm::vec2(along.y, -along.x));
        SceneCuts cuts(scene.instances.size());
        cuts[0] = {ChartCuts{{{across, glm::dot(across, a), 1}, {{}, 0, 0}, {{}, 0, 1}}}};
        cut = cutScene(scene, charts, cuts);
        ChartFactors factors(scene.instances.size());
        factors[0] = {1.f, 1.6f};
        lit = layLitTexels(cut, factors, {.texels = 1200}, {});
        findOpenTexels(TraceScene(scene), charts, cut, lit, {});
    }
    /// Position of a floor's point in the plane of its chart.
    glm::vec2 chartUvOf(glm::vec3 position) const {
        const Mesh& mesh = scene.meshOf(scene.instances[0]);
        const MeshCharts& c = charts[0];
        const auto corner = [&](std::size_t k) { return mesh.positions[mesh.indices[k]]; };
        const auto uv = [&](std::size_t k) { return c.chartUv[c.indices[k]]; };
        const glm::vec3 e1 = corner(1) - corner(0), e2 = corner(2) - corner(0),
                        p = position - corner(0);
        const glm::mat2 gram(glm::dot(e1, e1), glm::dot(e1, e2), glm::dot(e1, e2),
                             glm::dot(e2, e2));
        const glm::vec2 w = glm::inverse(gram) * glm::vec2(glm::dot(p, e1), glm::dot(p, e2));
        return uv(0) + w.x * (uv(1) - uv(0)) + w.y * (uv(2) - uv(0));
    }
    /// Mean of a texel's points.
    glm::vec3 positionOf(std::uint32_t t) const {
        glm::vec3 sum(0);
        const std::uint32_t count = lit.atlas.texels[t].count;
        for (std::uint32_t k = 0; k < count; ++k)
            sum += hitOf(scene, cut, lit, {t, k}).position;
        return sum / float(count);
    }
    static bool isAbove(glm::vec3 p) { return p.z > p.x / 2; }
    /// The texel's neighbours that share noise with it.
    std::vector<std::uint32_t> linkedTo(std::uint32_t t) const {
        std::vector<std::uint32_t> linked;
        for (const std::uint32_t place : lit.links[lit.atlas.texels[t].texel].next)
            if (place != SharingLinks::kNone)
                linked.push_back(lit.texelAt[place]);
        return linked;
    }
    /// The texels of the floor.
    std::vector<std::uint32_t> texels() const {
        std::vector<std::uint32_t> all;
        for (std::uint32_t t = 0; t < lit.atlas.texels.size(); ++t)
            if (lit.atlas.texels[t].instance == 0)
                all.push_back(t);
        return all;
    }
    std::size_t linksAcross() const {
        std::size_t across = 0;
        for (const std::uint32_t t : texels())
            for (const std::uint32_t n : linkedTo(t))
                across += isAbove(positionOf(t)) != isAbove(positionOf(n));
        return across;
    }
};

TEST(TexelSharing, GoesOnAcrossCuts) {
    const CutFloor floor(false);
    ASSERT_EQ(floor.cut.charts[floor.cut.scene.instances[0].mesh].chartSize.size(), 2U);
    // A texel linked to lies less than a step from where the next one would be.
    for (const std::uint32_t t : floor.texels())
        for (const std::uint32_t n : floor.linkedTo(t)) {
            const float width =
                std::max(floor.lit.atlas.texels[t].width, floor.lit.atlas.texels[n].width);
            EXPECT_LT(glm::distance(floor.positionOf(t), floor.positionOf(n)), 2.5f * width);
        }
    // The cut is 4.5 m long. Each texel along it leads to the other side.
    const float width = floor.lit.atlas.texels[0].width;
    EXPECT_GT(float(floor.linksAcross()), 4.5f / width);
}

TEST(TexelSharing, KeepsDirectionsWherePiecesAreTurned) {
    const CutFloor floor(false);
    // Two steps in the same way lead on in about the same direction, also across the cut.
    std::size_t ways = 0;
    for (const std::uint32_t t : floor.texels()) {
        const SharingLinks& links = floor.lit.links[floor.lit.atlas.texels[t].texel];
        for (std::uint32_t way = 0; way < 4; ++way) {
            if (links.next[way] == SharingLinks::kNone)
                continue;
            const std::uint32_t n = floor.lit.texelAt[links.next[way]],
                                on = floor.lit.links[links.next[way]]
                                         .next[(way + links.turn[way]) % 4];
            const std::uint32_t p = links.next[(way + 2) % 4];
            const bool crosses =
                floor.isAbove(floor.positionOf(t)) != floor.isAbove(floor.positionOf(n));
            if (on == SharingLinks::kNone || p == SharingLinks::kNone || !crosses)
                continue;
            const glm::vec3 before = floor.positionOf(t) - floor.positionOf(floor.lit.texelAt[p]),
                            after = floor.positionOf(floor.lit.texelAt[on]) - floor.positionOf(n);
            EXPECT_GT(glm::dot(glm::normalize(before), glm::normalize(after)), 0.4f);
            ++ways;
        }
    }
    EXPECT_GT(ways, 20U);
}

TEST(TexelSharing, StopsAtWalls) {
    EXPECT_EQ(CutFloor(true).linksAcross(), 0U);
}

} // namespace
} // namespace limn::texel_sharing_test
