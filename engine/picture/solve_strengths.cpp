// SPDX-License-Identifier: MIT
#include "engine/picture/solve_strengths.h"

#include "engine/math/luminance.h"
#include "engine/picture/nonnegative_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

namespace limn {

namespace {

/// Weight of a factor's distance from 1 beside a goal's relative error: small enough that a
/// hundredfold strength misses a goal by less than a hundredth of a per cent.
constexpr double kKeep = 1e-6;

constexpr int kRounds = 4;        ///< of lighting and solving, at most
constexpr double kSettled = 2e-3; ///< relative difference of what was solved and what is there

/// Luminance of a pixel by what sends it.
struct PixelByLight {
    double all = 0;
    std::vector<double> ofLight; ///< of each of Scene::lights
};

PixelByLight byLight(const ConvergedLight& lit, const PixelQuestion& question) {
    const PixelExplanation e = explainPixel(lit, question);
    PixelByLight result{luminance(glm::dvec3(e.total)),
                        std::vector<double>(lit.scene->lights.size())};
    for (const LightRow& row : e.tables.byOrigin)
        if (row.kind == LightRowKind::Light && row.index < result.ofLight.size())
            result.ofLight[row.index] += luminance(glm::dvec3(row.value));
    return result;
}

/// An equation for each goal, relative to it, then one for each light that asks for a factor of 1.
LinearSystem equationsOf(std::span<const PixelByLight> pixels, std::span<const StrengthGoal> goals,
                         std::span<const std::uint32_t> lights) {
    LinearSystem system{.unknowns = lights.size()};
    for (std::size_t g = 0; g < goals.size(); ++g) {
        double rest = pixels[g].all;
        for (const std::uint32_t l : lights) {
            system.matrix.push_back(pixels[g].ofLight[l] / goals[g].luminance);
            rest -= pixels[g].ofLight[l];
        }
        system.right.push_back((goals[g].luminance - rest) / goals[g].luminance);
    }
    for (std::size_t k = 0; k < lights.size(); ++k) {
        for (std::size_t other = 0; other < lights.size(); ++other)
            system.matrix.push_back(other == k ? kKeep : 0);
        system.right.push_back(kKeep);
    }
    return system;
}

Result<std::vector<PixelByLight>> readGoals(const ConvergedLight& lit,
                                            std::span<const StrengthGoal> goals,
                                            const Progress& progress) {
    std::vector<PixelByLight> pixels;
    for (const StrengthGoal& goal : goals) {
        assert(goal.luminance > 0);
        progress.at("goals", float(pixels.size()) / float(goals.size()));
        if (progress.cancelled())
            return fail("cancelled");
        pixels.push_back(byLight(lit, goal.question));
        if (!std::isfinite(pixels.back().all))
            return fail(fmt::format("the light of pixel {},{} is not finite", goal.question.x,
                                    goal.question.y));
    }
    return pixels;
}

/// Those of `lights` that bring light to a goal.
std::vector<std::uint32_t> reaching(std::span<const PixelByLight> pixels,
                                    std::span<const std::uint32_t> lights) {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t l : lights)
        if (std::ranges::any_of(pixels, [&](const PixelByLight& p) { return p.ofLight[l] > 0; }))
            found.push_back(l);
    return found;
}

double withFactors(const PixelByLight& pixel, std::span<const std::uint32_t> lights,
                   std::span<const double> factors) {
    double sum = pixel.all;
    for (std::size_t k = 0; k < lights.size(); ++k)
        sum += (factors[k] - 1) * pixel.ofLight[lights[k]];
    return sum;
}

/// The scene of `lit` with strengths times `factor`, lit again.
Result<ConvergedLight> litWith(const ConvergedLight& lit, const Technique& technique,
                               std::span<const double> factor, const Viewpoint& view,
                               const Progress& progress) {
    auto scene = std::make_shared<Scene>(*lit.scene);
    for (std::size_t l = 0; l < factor.size(); ++l)
        scene->lights[l].strength = float(double(scene->lights[l].strength) * factor[l]);
    const auto trace = std::make_shared<const TraceScene>(*scene, *lit.trace);
    return convergeLight(scene, trace, technique, lit.prepared, LitFor::Pictures, progress, &view);
}

} // namespace

Result<SolvedStrengths> solveStrengths(const ConvergedLight& lit, const Technique& technique,
                                       std::span<const StrengthGoal> goals,
                                       std::span<const std::uint32_t> lights,
                                       const Progress& progress) {
    assert(!goals.empty());
    const PixelQuestion& first = goals.front().question;
    const Viewpoint view = viewpointOf(first.camera, {first.width, first.height});
    auto pixels = readGoals(lit, goals, progress);
    if (!pixels)
        return tl::make_unexpected(pixels.error());
    SolvedStrengths result{.factor = std::vector<double>(lit.scene->lights.size(), 1)};
    for (const PixelByLight& pixel : *pixels)
        result.goals.push_back({pixel.all, pixel.all});
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<std::uint32_t> free = reaching(*pixels, lights);
        if (free.empty() && round == 0)
            return fail("none of the lights that may change reaches a goal");
        const std::vector<double> found = nonnegativeFit(equationsOf(*pixels, goals, free));
        for (std::size_t k = 0; k < free.size(); ++k)
            result.factor[free[k]] *= found[k];
        std::vector<double> expected;
        for (const PixelByLight& pixel : *pixels)
            expected.push_back(withFactors(pixel, free, found));
        const auto again = litWith(lit, technique, result.factor, view, progress);
        if (!again)
            return tl::make_unexpected(again.error());
        pixels = readGoals(*again, goals, progress);
        if (!pixels)
            return tl::make_unexpected(pixels.error());
        bool settled = true;
        for (std::size_t g = 0; g < goals.size(); ++g) {
            result.goals[g].after = (*pixels)[g].all;
            settled &=
                std::abs(result.goals[g].after - expected[g]) <= kSettled * goals[g].luminance;
        }
        if (settled)
            break;
    }
    return result;
}

} // namespace limn
