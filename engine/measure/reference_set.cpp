// SPDX-License-Identifier: MIT
#include "engine/measure/reference_set.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

static constexpr double kNrmseThatMatters = 0.1, kBiasThatMatters = 0.02;
static constexpr std::size_t kWorstOneOf = 100; ///< pixels, left out of nrmseTrimmed

static constexpr std::uint32_t kParts = 4;

/// Renders four parts of `samples` samples each, with the seeds of that pass.
static std::optional<std::array<ImageF, kParts>>
renderParts(const TraceScene& trace, ReferenceOptions options, std::uint32_t samples,
            std::uint32_t pass, const Progress& progress) {
    std::array<ImageF, kParts> parts;
    options.samplesPerPixel = samples;
    for (std::uint32_t k = 0; k < kParts; ++k) {
        options.seed = kParts * pass + k + 1;
        const Progress whole{
            .report = [&](const char* stage,
                          float fraction) { progress.at(stage, (float(k) + fraction) / kParts); },
            .cancel = progress.cancel};
        ReferenceResult result = renderReference(trace, options, whole);
        if (result.samplesPerPixel < samples)
            return {};
        parts[k] = std::move(result.image);
    }
    return parts;
}

std::optional<ReferenceSet> renderReferenceSet(const TraceScene& trace,
                                               const ReferenceOptions& options,
                                               const Progress& progress) {
    auto parts = renderParts(trace, options, options.samplesPerPixel, 0, progress);
    if (!parts)
        return {};
    return ReferenceSet{std::move(*parts), options.samplesPerPixel, 1};
}

bool refine(ReferenceSet& set, const TraceScene& trace, const ReferenceOptions& options,
            const Progress& progress) {
    const auto more = renderParts(trace, options, set.samplesPerPixel, set.passes, progress);
    if (!more)
        return false;
    for (std::size_t k = 0; k < kParts; ++k)
        set.parts[k] = meanImage(set.parts[k], (*more)[k]);
    set.samplesPerPixel *= 2;
    ++set.passes;
    return true;
}

double noiseOf(const ReferenceSet& set) {
    const ImageF a = set.first(), b = set.second();
    double sum = 0, squares = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const glm::dvec3 half = (glm::dvec3(a.rgb[i]) - glm::dvec3(b.rgb[i])) / 2.0,
                         mean = (glm::dvec3(a.rgb[i]) + glm::dvec3(b.rgb[i])) / 2.0;
        if (!std::isfinite(half.x + half.y + half.z))
            continue;
        squares += glm::dot(half, half);
        sum += mean.x + mean.y + mean.z;
        count += 3;
    }
    return sum > 0 ? std::sqrt(squares * double(count)) / sum : 0;
}

/// Product of a picture's differences from two references, per pixel; NaN if any value is NaN.
static std::vector<double> products(const ImageF& test, const ImageF& a, const ImageF& b) {
    std::vector<double> result(test.rgb.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const glm::dvec3 t(test.rgb[i]);
        const glm::dvec3 p = (t - glm::dvec3(a.rgb[i])) * (t - glm::dvec3(b.rgb[i]));
        result[i] = (p.x + p.y + p.z) / 3;
    }
    return result;
}

Result<Comparison> compareImages(const ImageF& test, const ReferenceSet& set) {
    const ImageF first = set.first(), second = set.second();
    Result<Comparison> c = compareImages(test, first, second);
    if (!c)
        return c;
    const std::vector<double> half[2] = {products(test, set.parts[0], set.parts[2]),
                                         products(test, set.parts[1], set.parts[3])};
    std::vector<std::size_t> order;
    double mean = 0;
    for (std::size_t i = 0; i < test.rgb.size(); ++i)
        if (std::isfinite(half[0][i]) && std::isfinite(half[1][i])) {
            order.push_back(i);
            const glm::dvec3 r = glm::dvec3(first.rgb[i]) + glm::dvec3(second.rgb[i]);
            mean += (r.x + r.y + r.z) / 6;
        }
    const std::size_t left = order.size() - order.size() / kWorstOneOf;
    if (left == 0 || mean == 0)
        return c;
    mean /= double(order.size());
    double sum = 0;
    for (const int chooser : {0, 1}) {
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return std::pair(half[chooser][a], a) < std::pair(half[chooser][b], b);
        });
        for (std::size_t k = 0; k < left; ++k)
            sum += half[1 - chooser][order[k]] / 2;
    }
    c->nrmseTrimmed = std::sqrt(std::max(sum, 0.0) / double(left)) / std::abs(mean);
    return c;
}

bool isSure(const Comparison& c) {
    return c.nrmseNoise <= std::max(c.nrmse, kNrmseThatMatters) / 4 &&
           c.biasNoise <= std::max(std::abs(c.bias), kBiasThatMatters) / 4;
}

} // namespace limn
