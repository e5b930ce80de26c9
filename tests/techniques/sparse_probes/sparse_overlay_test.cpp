// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/sparse_overlay.h"

#include "engine/math/luminance.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/techniques/sparse_probes/relight_rays.h"
#include "tests/techniques/sparse_probes/lit_by_sparse.h"

#include <algorithm>
#include <map>
#include <string>

namespace limn::sparse_overlay_test {
namespace {

struct Shown : LitBySparse {
    Shown() : LitBySparse(room(), {}, 800) { update(); }
    OverlayData overlay(std::size_t kind, std::uint32_t pick = ~0U, bool light = true) const {
        return prepared.data->overlay({.kind = &kSparseOverlays[kind], .pick = pick}, scene,
                                      light ? lighting->snapshot().get() : nullptr);
    }
};

TEST(SparseOverlay, ProbesAreBallsInTheLightThatReachesThem) {
    const Shown s;
    const OverlayData lit = s.overlay(0), unlit = s.overlay(0, ~0U, false);
    EXPECT_EQ(lit.marks.size() % s.bake().probes.size(), 0U);
    ASSERT_EQ(lit.marks.size(), unlit.marks.size());
    EXPECT_FALSE(std::ranges::equal(lit.marks, unlit.marks));
    EXPECT_GT(lit.legend.entries.size(), unlit.legend.entries.size());
    // Light of another bake is not shown.
    const SparseSnapshot other(ProbeRadiance(3));
    EXPECT_EQ(s.prepared.data->overlay({.kind = &kSparseOverlays[0]}, s.scene, &other).marks,
              unlit.marks);
}

TEST(SparseOverlay, TexelsAreColouredByWhatNoProbeSees) {
    const Shown s;
    const OverlayData data = s.overlay(1);
    const std::vector<float>& unseen = s.bake().transport.unseen;
    const auto most = std::size_t(std::ranges::max_element(unseen) - unseen.begin());
    ASSERT_EQ(data.texels.size(), std::size_t(data.width) * data.height);
    EXPECT_EQ(data.texels[s.bake().receivers.texel[most]], packColor(viridis(1)));
    const auto painted = std::ranges::count_if(data.texels, [](std::uint32_t c) { return c != 0; });
    EXPECT_EQ(std::size_t(painted), unseen.size());
}

TEST(SparseOverlay, ATexelShowsItsProbesAndIsFoundWhereItLies) {
    const Shown s;
    const std::uint32_t r = 100;
    const OverlayData data = s.overlay(2, r);
    const float largest =
        std::ranges::max_element(data.marks.begin() + 1, data.marks.end(), {}, &OverlayMark::radius)
            ->radius;
    EXPECT_EQ(std::ranges::count(data.marks, largest, &OverlayMark::radius), 8);
    EXPECT_TRUE(s.overlay(2).marks.empty()) << "none is picked";
    const auto lines = s.prepared.data->describePick(s.scene, r);
    EXPECT_EQ(lines.size(), 5U + 8U);
    EXPECT_NE(lines[0].text.find("Texel 100"), std::string::npos);
    const ReceiverPoints points = pointsOf(s.scene, s.bake().receivers);
    const Hit hit =
        s.trace->closestHit({points.position[r] + 0.1f * points.normal[r], -points.normal[r]});
    EXPECT_EQ(s.prepared.data->pickAt(s.scene, hit), r);
    Hit unknown = hit;
    unknown.instance = std::uint32_t(s.scene.instances.size());
    EXPECT_FALSE(s.prepared.data->pickAt(s.scene, unknown));
    EXPECT_EQ(s.prepared.data->nearestPick(*s.prepared.data, r), r);
}

TEST(SparseOverlay, RaysEndAtTheTexelsThatLightTheProbe) {
    const Shown s;
    const OverlayData data = s.overlay(3, 100);
    EXPECT_EQ(data.marks.size(), 1 + s.bake().sparse.rays);
    const ReceiverPoints points = pointsOf(s.scene, s.bake().receivers);
    const NearProbes near = nearestProbes(s.bake().probes, points.position[100]);
    EXPECT_EQ(data.marks[0].position, s.bake().probes[near.probe[0]]);
    const std::uint32_t hit = s.bake().hits[near.probe[0] * s.bake().sparse.rays];
    ASSERT_LT(hit, kDarkHit);
    EXPECT_LT(glm::distance(data.marks[1].position, points.position[hit]),
              s.bake().receivers.width[hit]);
}

TEST(SparseOverlay, ARowOfTheTransportIsALobeAtEachOfItsProbes) {
    const Shown s;
    const std::uint32_t r = 100;
    const OverlayData data = s.overlay(4, r);
    ASSERT_EQ((data.marks.size() - 1) % kProbesPerReceiver, 0U);
    const ReceiverPoints points = pointsOf(s.scene, s.bake().receivers);
    const NearProbes near = nearestProbes(s.bake().probes, points.position[r]);
    std::map<std::uint16_t, std::size_t> dots; // of the probe that a dot is nearest to
    for (std::size_t k = 1; k < data.marks.size(); ++k) {
        const auto nearest = std::ranges::min_element(near.probe, {}, [&](std::uint16_t p) {
            return glm::distance(s.bake().probes[p], data.marks[k].position);
        });
        ++dots[*nearest];
    }
    EXPECT_EQ(dots.size(), kProbesPerReceiver);
    for (const auto& [probe, count] : dots)
        EXPECT_EQ(count, (data.marks.size() - 1) / kProbesPerReceiver) << probe;
    EXPECT_TRUE(s.overlay(4).marks.empty()) << "none is picked";
}

TEST(SparseOverlay, TexelsWithLessThanNoLightAreCountedAndMagenta) {
    Shown s;
    // A narrow spot far from most walls makes harmonics ring.
    s.scene.lights = {{.kind = LightKind::Spot,
                       .position = {2, 2.5f, 2},
                       .direction = {0, -1, 0},
                       .strength = 100,
                       .innerAngle = 0.05f,
                       .outerAngle = 0.1f}};
    s.update();
    const OverlayData data = s.overlay(5);
    const auto magenta = std::size_t(std::ranges::count(data.texels, packColor(kNegativeLight)));
    EXPECT_GT(magenta, 0U);
    const auto lit = s.lighting->snapshot();
    std::vector<glm::vec3> whole;
    gatherReceivers(s.bake(), static_cast<const SparseSnapshot&>(*lit).probes(),
                    NotNegative::Nothing, whole);
    for (std::size_t r = 0; r < whole.size(); ++r) {
        const std::uint32_t color = data.texels[s.bake().receivers.texel[r]];
        EXPECT_NE(color, 0U);
        EXPECT_EQ(color == packColor(kNegativeLight), luminance(whole[r]) < 0) << r;
        for (int c = 0; c < 3; ++c) // what surfaces get is this, cut off
            EXPECT_NEAR(s.ofReceiver(r)[c], std::max(whole[r][c], 0.f), 1e-5f) << r;
    }
    EXPECT_NE(data.legend.entries.back().text.find(std::to_string(magenta) + " of"),
              std::string::npos);
    EXPECT_TRUE(s.overlay(5, ~0U, false).texels.empty()) << "nothing is lit";
}

} // namespace
} // namespace limn::sparse_overlay_test
