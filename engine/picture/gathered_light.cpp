// SPDX-License-Identifier: MIT
#include "engine/picture/gathered_light.h"

#include "engine/core/parallel.h"

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
            const GatherSamples &first = tile.first[p], &more = tile.more[p];
            GatheredPixel& pixel = pixels[rect.numberOf({tile.x + i, tile.y + j})];
            pixel.weight = (first.weight + more.weight) / double(first.count + more.count);
            pixel.shown = tile.meanOf(p, Shown);
            for (const GatherPart part : {Emitted, Bounced}) {
                pixel.exchange[part] = tile.meanOf(p, part);
                pixel.noise[part] = float(tile.noise[part][p]);
            }
        }
}

void GatheredMean::add(const GatheredPixel& pixel, GatherPart part) {
    sum += pixel.exchange[part];
    weights += pixel.weight;
    noise += double(pixel.noise[part]);
}

glm::vec3 GatheredMean::factorFor(glm::vec3 weight) const {
    glm::vec3 factor(0);
    for (int c = 0; c < 3; ++c)
        factor[c] = weights[c] > 0 ? weight[c] / weights[c] : 0;
    return factor;
}

namespace {

/// Squared differences over the pixels of a window, and what part of them is expected of noise.
struct Difference {
    double squared = 0, noise = 0, weights = 0; ///< of greys
    double own = 0, ownNoise = 0;               ///< of the pixel in question

    void add(glm::vec3 differs, double itsNoise, glm::vec3 weight, bool isOwn) {
        const double grey = greyOf(differs), w = greyOf(weight) * greyOf(weight);
        squared += grey * grey;
        noise += itsNoise;
        weights += w;
        if (isOwn) {
            own = w;
            ownNoise = itsNoise;
        }
    }
    /// The share of its difference that the pixel in question keeps: signal / (signal + noise),
    /// both squared. The signal is taken to be in proportion to the pixel's weight.
    float kept() const {
        const double signal = squared > noise ? (squared - noise) * own / weights : 0;
        return signal > 0 ? float(signal / (signal + ownNoise)) : 0;
    }
};

} // namespace

KeptExchange keptExchange(const GatheredLight& light, GatherPart part, glm::uvec2 pixel) {
    const PixelRect window = windowAround(pixel, kGatherRadius, light.rect);
    constexpr std::size_t kMost = (2 * kGatherRadius + 1) * (2 * kGatherRadius + 1);
    std::array<GatheredMean, kMost> near;
    KeptExchange kept;
    window.forEach([&](glm::uvec2 at) {
        kept.window.add(light.at(at), part);
        GatheredMean& mean = near[window.numberOf(at)];
        windowAround(at, kNearRadius, window).forEach([&](glm::uvec2 q) {
            mean.add(light.at(q), part);
        });
    });
    kept.near = near[window.numberOf(pixel)];
    Difference ofNear, ofPixel;
    window.forEach([&](glm::uvec2 at) {
        const GatheredPixel& p = light.at(at);
        const GatheredMean& mean = near[window.numberOf(at)];
        const double a = greyOf(mean.factorFor(p.weight)),
                     b = greyOf(kept.window.factorFor(p.weight)), own = double(p.noise[part]);
        ofNear.add(mean.in(p.weight) - kept.window.in(p.weight),
                   (a - 2 * b) * a * mean.noise + b * b * kept.window.noise, p.weight, at == pixel);
        ofPixel.add(p.exchange[part] - mean.in(p.weight), (1 - 2 * a) * own + a * a * mean.noise,
                    p.weight, at == pixel);
    });
    Difference ofWindow;
    ofWindow.add(kept.window.sum, kept.window.noise, glm::vec3(1), true);
    kept.ofWindow = ofWindow.kept();
    kept.ofNear = ofNear.kept();
    kept.ofPixel = ofPixel.kept();
    return kept;
}

glm::vec3 KeptExchange::lightIn(const GatheredPixel& pixel, GatherPart part) const {
    return (ofWindow - ofNear) * window.in(pixel.weight) +
           (ofNear - ofPixel) * near.in(pixel.weight) + ofPixel * pixel.exchange[part];
}

glm::vec3 KeptExchange::factorOf(bool isNear, bool isItself, glm::vec3 weight) const {
    glm::vec3 factor = (ofWindow - ofNear) * window.factorFor(weight);
    if (isNear)
        factor += (ofNear - ofPixel) * near.factorFor(weight);
    return isItself ? factor + ofPixel : factor;
}

void addGathered(ImageF& image, const GatheredLight& light, const PixelRect& pixels) {
    const auto addRow = [&](std::uint32_t y) {
        PixelRect{{pixels.begin.x, y}, {pixels.end.x, y + 1}}.forEach([&](glm::uvec2 at) {
            const GatheredPixel& p = light.at(at);
            glm::vec3 sum = p.shown;
            for (const GatherPart part : {Emitted, Bounced})
                sum += keptExchange(light, part, at).lightIn(p, part);
            image.rgb[std::size_t(at.y) * image.width + at.x] += sum;
        });
    };
    parallelRanges(pixels.end.y - pixels.begin.y, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row)
            addRow(pixels.begin.y + std::uint32_t(row));
    });
}

} // namespace limn
