// SPDX-License-Identifier: MIT
#include "engine/picture/gathered_light.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <array>
#include <tuple>

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

/// Fills a window by following links. Where pixels on the two sides of a seam differ in size, links
/// lead to one of them from several places; it belongs to the first.
static void followLinks(const GatheredLight& light, std::uint32_t middle, SharingWindow& window) {
    struct Reached {
        glm::ivec2 place;
        std::uint32_t pixel, turn;
    };
    constexpr std::array<glm::ivec2, 4> kSteps = SharingLinks::kSteps;
    std::array<Reached, std::tuple_size_v<decltype(window.pixel)>> reached;
    std::size_t count = 0;
    bool crossed = false; // a seam
    const auto reach = [&](const Reached& r) {
        const glm::ivec2 end(SharingWindow::kPlaces.end);
        if (r.place.x < 0 || r.place.y < 0 || r.place.x >= end.x || r.place.y >= end.y)
            return;
        std::uint32_t& pixel = window.pixel[SharingWindow::kPlaces.numberOf(glm::uvec2(r.place))];
        const auto isSame = [&](const Reached& other) { return other.pixel == r.pixel; };
        if (pixel != SharingLinks::kNone ||
            (crossed && std::any_of(reached.begin(), reached.begin() + count, isSame)))
            return;
        pixel = r.pixel;
        reached[count++] = r;
    };
    reach({glm::ivec2(SharingWindow::kMiddle), middle, 0});
    const std::uint32_t width = light.rect.end.x - light.rect.begin.x;
    for (std::size_t k = 0; k < count; ++k) {
        const Reached from = reached[k];
        const SharingLinks& links = light.links[from.pixel];
        for (std::uint32_t step = 0; step < kSteps.size(); ++step) {
            const std::uint32_t way = (step + from.turn) % kSteps.size(), next = links.next[way];
            if (next == SharingLinks::kNone)
                continue;
            const glm::ivec2 inRow = kSteps[way];
            crossed |= next != from.pixel + std::uint32_t(inRow.x + inRow.y * int(width));
            reach({from.place + kSteps[step], next, from.turn + links.turn[way]});
        }
    }
}

SharingWindow sharingWindow(const GatheredLight& light, glm::uvec2 pixel) {
    SharingWindow window;
    window.pixel.fill(SharingLinks::kNone);
    if (!light.links.empty()) {
        followLinks(light, std::uint32_t(light.rect.numberOf(pixel)), window);
        return window;
    }
    windowAround(pixel, kGatherRadius, light.rect).forEach([&](glm::uvec2 q) {
        window.pixel[SharingWindow::kPlaces.numberOf(q + kGatherRadius - pixel)] =
            std::uint32_t(light.rect.numberOf(q));
    });
    return window;
}

ShrunkDifference shrinkDifference(const GatheredLight& light, GatherPart part, glm::uvec2 pixel) {
    const SharingWindow window = sharingWindow(light, pixel);
    std::array<GatheredMean, std::tuple_size_v<decltype(window.pixel)>> near;
    const auto nearOf = [&](glm::uvec2 place) -> GatheredMean& {
        return near[SharingWindow::kPlaces.numberOf(place)];
    };
    ShrunkDifference shrunk;
    window.forEach(SharingWindow::kMiddle, kGatherRadius, [&](glm::uvec2 q, std::uint32_t number) {
        shrunk.window.add(light.pixels[number], part);
        GatheredMean& mean = nearOf(q);
        window.forEach(q, kNearRadius, [&](glm::uvec2, std::uint32_t beside) {
            mean.add(light.pixels[beside], part);
        });
    });
    shrunk.near = nearOf(SharingWindow::kMiddle);
    Deviations nearDeviations;  // of neighbourhoods' means from the window's mean
    Deviations pixelDeviations; // of pixels from their neighbourhoods' means
    window.forEach(SharingWindow::kMiddle, kGatherRadius, [&](glm::uvec2 q, std::uint32_t number) {
        const GatheredPixel& p = light.pixels[number];
        const GatheredMean& mean = nearOf(q);
        const bool isMiddle = q == SharingWindow::kMiddle;
        const double a = greyOf(mean.factorFor(p.weight)),
                     b = greyOf(shrunk.window.factorFor(p.weight));
        nearDeviations.add(mean.in(p.weight) - shrunk.window.in(p.weight),
                           (a - 2 * b) * a * mean.variance + b * b * shrunk.window.variance,
                           p.weight, isMiddle);
        pixelDeviations.add(p.difference[part] - mean.in(p.weight),
                            (1 - 2 * a) * double(p.variance[part]) + a * a * mean.variance,
                            p.weight, isMiddle);
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
