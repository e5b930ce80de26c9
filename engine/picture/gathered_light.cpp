// SPDX-License-Identifier: MIT
#include "engine/picture/gathered_light.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <array>

#include <glm/common.hpp>

namespace limn {

PixelRect windowAround(glm::uvec2 pixel, std::uint32_t radius, const PixelRect& rect) {
    return {glm::max(pixel, rect.begin + radius) - radius, glm::min(pixel + radius + 1U, rect.end)};
}

void GatheredLight::set(const GatherTile& tile) {
    for (std::uint32_t j = 0; j < tile.height; ++j)
        for (std::uint32_t i = 0; i < tile.width; ++i) {
            const std::uint32_t p = j * kGatherTile + i;
            const GatherSamples &first = tile.firstStage[p], &second = tile.secondStage[p];
            GatheredPixel& pixel = pixels[rect.numberOf({tile.x + i, tile.y + j})];
            pixel.weight = (first.weight + second.weight) / double(first.count + second.count);
            pixel.shown = tile.meanOf(p, Shown);
            for (const GatherPart part : {Emitted, Bounced}) {
                pixel.difference[part] = tile.meanOf(p, part);
                pixel.variance[part] = float(tile.variance[part][p]);
            }
        }
}

void GatheredMean::add(const GatheredPixel& pixel, GatherPart part) {
    sum += pixel.difference[part];
    weights += pixel.weight;
    variance += double(pixel.variance[part]);
}

glm::vec3 GatheredMean::factorFor(glm::vec3 weight) const {
    glm::vec3 factor(0);
    for (int c = 0; c < 3; ++c)
        factor[c] = weights[c] > 0 ? weight[c] / weights[c] : 0;
    return factor;
}

namespace {

/// Squared deviations over the pixels of a window, and what part of them is expected of variance.
struct Deviations {
    double squared = 0, variance = 0, weights = 0; ///< sums over pixels, of greys
    double pixelWeight = 0, pixelVariance = 0;     ///< those of the pixel in question

    void add(glm::vec3 deviation, double expected, glm::vec3 weight, bool isPixel) {
        const double grey = greyOf(deviation), w = greyOf(weight) * greyOf(weight);
        squared += grey * grey;
        variance += expected;
        weights += w;
        if (isPixel) {
            pixelWeight = w;
            pixelVariance = expected;
        }
    }
    /// The shrinkage factor of the pixel in question: signal / (signal + variance). The signal is
    /// taken to be in proportion to the pixel's squared weight.
    float shrinkage() const {
        const double signal = squared > variance ? (squared - variance) * pixelWeight / weights : 0;
        return signal > 0 ? float(signal / (signal + pixelVariance)) : 0;
    }
};

} // namespace

SharingWindow sharingWindow(const GatheredLight& light, glm::uvec2 pixel) {
    SharingWindow window{windowAround(pixel, kGatherRadius, light.rect)};
    const PixelRect& rect = window.rect;
    if (light.shares.empty()) {
        std::fill_n(window.shares.begin(), rect.size(), true);
        return window;
    }
    std::array<glm::uvec2, kMaxWindowPixels> reached;
    std::size_t count = 0;
    const auto reach = [&](glm::uvec2 q) {
        bool& shares = window.shares[rect.numberOf(q)];
        if (!shares)
            reached[count++] = q;
        shares = true;
    };
    const auto sharesWith = [&](glm::uvec2 q, SharesNoise next) {
        return (light.shares[light.rect.numberOf(q)] & next) != 0;
    };
    reach(pixel);
    for (std::size_t k = 0; k < count; ++k) {
        const glm::uvec2 q = reached[k];
        const glm::uvec2 right(1, 0), below(0, 1);
        if (q.x + 1 < rect.end.x && sharesWith(q, WithRight))
            reach(q + right);
        if (q.y + 1 < rect.end.y && sharesWith(q, WithBelow))
            reach(q + below);
        if (q.x > rect.begin.x && sharesWith(q - right, WithRight))
            reach(q - right);
        if (q.y > rect.begin.y && sharesWith(q - below, WithBelow))
            reach(q - below);
    }
    return window;
}

ShrunkDifference shrinkDifference(const GatheredLight& light, GatherPart part, glm::uvec2 pixel) {
    const SharingWindow window = sharingWindow(light, pixel);
    std::array<GatheredMean, kMaxWindowPixels> near;
    ShrunkDifference shrunk;
    window.forEach(pixel, kGatherRadius, [&](glm::uvec2 q) {
        shrunk.window.add(light.at(q), part);
        GatheredMean& mean = near[window.rect.numberOf(q)];
        window.forEach(q, kNearRadius, [&](glm::uvec2 r) { mean.add(light.at(r), part); });
    });
    shrunk.near = near[window.rect.numberOf(pixel)];
    Deviations nearDeviations;  // of neighbourhoods' means from the window's mean
    Deviations pixelDeviations; // of pixels from their neighbourhoods' means
    window.forEach(pixel, kGatherRadius, [&](glm::uvec2 q) {
        const GatheredPixel& p = light.at(q);
        const GatheredMean& mean = near[window.rect.numberOf(q)];
        const double a = greyOf(mean.factorFor(p.weight)),
                     b = greyOf(shrunk.window.factorFor(p.weight));
        nearDeviations.add(mean.in(p.weight) - shrunk.window.in(p.weight),
                           (a - 2 * b) * a * mean.variance + b * b * shrunk.window.variance,
                           p.weight, q == pixel);
        pixelDeviations.add(p.difference[part] - mean.in(p.weight),
                            (1 - 2 * a) * double(p.variance[part]) + a * a * mean.variance,
                            p.weight, q == pixel);
    });
    Deviations windowDeviation; // of the window's mean from 0
    windowDeviation.add(shrunk.window.sum, shrunk.window.variance, glm::vec3(1), true);
    shrunk.windowFactor = windowDeviation.shrinkage();
    shrunk.nearFactor = nearDeviations.shrinkage();
    shrunk.pixelFactor = pixelDeviations.shrinkage();
    return shrunk;
}

glm::vec3 ShrunkDifference::lightIn(const GatheredPixel& pixel, GatherPart part) const {
    return (windowFactor - nearFactor) * window.in(pixel.weight) +
           (nearFactor - pixelFactor) * near.in(pixel.weight) +
           pixelFactor * pixel.difference[part];
}

glm::vec3 ShrunkDifference::factorOf(bool isNear, bool isItself, glm::vec3 weight) const {
    glm::vec3 factor = (windowFactor - nearFactor) * window.factorFor(weight);
    if (isNear)
        factor += (nearFactor - pixelFactor) * near.factorFor(weight);
    return isItself ? factor + pixelFactor : factor;
}

void addGathered(ImageF& image, const GatheredLight& light, const PixelRect& pixels) {
    const auto addRow = [&](std::uint32_t y) {
        PixelRect{{pixels.begin.x, y}, {pixels.end.x, y + 1}}.forEach([&](glm::uvec2 pixel) {
            const GatheredPixel& p = light.at(pixel);
            glm::vec3 sum = p.shown;
            for (const GatherPart part : {Emitted, Bounced})
                sum += shrinkDifference(light, part, pixel).lightIn(p, part);
            image.rgb[std::size_t(pixel.y) * image.width + pixel.x] += sum;
        });
    };
    parallelRanges(pixels.end.y - pixels.begin.y, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row)
            addRow(pixels.begin.y + std::uint32_t(row));
    });
}

} // namespace limn
