// SPDX-License-Identifier: MIT
#include "engine/picture/light_guide.h"

namespace limn {

static constexpr std::array<float, 4> kProbabilities{0, 0.25f, 0.5f, 0.75f};

static void addAll(LightGuide& guide, std::span<const RayLight> rays) {
    for (const RayLight& r : rays)
        guide.add(r.direction, r.light);
}

/// Adds, for each probability, the second moment of the light of rays if they were guided with that
/// probability by a guide that has learned from other rays. Where q is the density with the guide,
/// it is the mean of light^2 pdf / q over rays whose density was pdf.
static void addSquares(std::array<double, kProbabilities.size()>& squares,
                       std::span<const RayLight> learned, std::span<const RayLight> rays) {
    LightGuide guide;
    addAll(guide, learned);
    guide.finish(kProbabilities.back());
    for (const RayLight& r : rays) {
        const float guided =
            r.light != 0 && guide.probability() > 0 ? guide.pdf(r.direction) : r.pdf;
        for (std::size_t i = 0; i < kProbabilities.size(); ++i)
            squares[i] +=
                double(r.light) * double(r.light) *
                double(r.pdf / ((1 - kProbabilities[i]) * r.pdf + kProbabilities[i] * guided));
    }
}

LightGuide learnGuide(std::span<const RayLight> half, std::span<const RayLight> otherHalf) {
    std::array<double, kProbabilities.size()> squares{};
    addSquares(squares, half, otherHalf);
    addSquares(squares, otherHalf, half);
    LightGuide guide;
    addAll(guide, half);
    addAll(guide, otherHalf);
    guide.finish(kProbabilities[std::size_t(std::ranges::min_element(squares) - squares.begin())]);
    return guide;
}

} // namespace limn
