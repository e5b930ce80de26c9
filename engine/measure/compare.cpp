// SPDX-License-Identifier: MIT
#include "engine/measure/compare.h"

#include "engine/math/luminance.h"
#include "engine/measure/flip.h"
#include "engine/measure/ssim.h"
#include "engine/overlay/palette.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr double kRelMseFloor = 0.01;    ///< of mean(ref)^2
constexpr double kRelMseDropped = 0.001; ///< share of the worst pixels
constexpr std::size_t kWorstOneOf = 100; ///< pixels, left out of nrmseTrimmed
constexpr double kMinSquare = 1e-4;      ///< squared relative error of the darkest colour
constexpr float kHeatmapFull = 0.5f;     ///< relative error of the darkest colours
constexpr float kHeatmapFloor = 0.05f;   ///< of mean(ref), keeps black pixels from ruling the map

bool isValid(glm::vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

double channelMean(glm::dvec3 c) {
    return (c.x + c.y + c.z) / 3;
}

/// Quotient a / b, where 0 / 0 is 0 and x / 0 is infinite.
double ratio(double a, double b) {
    if (a == 0 && b == 0)
        return 0;
    return b != 0 ? a / b : std::numeric_limits<double>::infinity();
}

std::vector<bool> validPixels(const ImageF& a, const ImageF& b) {
    std::vector<bool> valid(a.rgb.size());
    for (std::size_t i = 0; i < valid.size(); ++i)
        valid[i] = isValid(a.rgb[i]) && isValid(b.rgb[i]);
    return valid;
}

std::string sizesDiffer(const ImageF& a, const ImageF& b) {
    return fmt::format("sizes differ: {} x {} against {} x {}", a.width, a.height, b.width,
                       b.height);
}

bool sameSize(const ImageF& a, const ImageF& b) {
    return a.width == b.width && a.height == b.height;
}

double meanOfValid(const ImageF& image, const std::vector<bool>& valid) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < valid.size(); ++i)
        if (valid[i]) {
            sum += channelMean(image.rgb[i]);
            ++count;
        }
    return count > 0 ? sum / double(count) : 0;
}

double meanOfValid(const Plane& plane, const std::vector<bool>& valid, double none) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < valid.size(); ++i)
        if (valid[i]) {
            sum += double(plane.values[i]);
            ++count;
        }
    return count > 0 ? sum / double(count) : none;
}

/// Computes `nrmse` and `nrmseTrimmed` from the pixels' squared errors, or estimates of them.
/// Reorders `squares`.
void rootMeanSquares(std::vector<double>& squares, double mean, Comparison& c) {
    if (squares.empty())
        return;
    const auto root = [&](std::size_t count) {
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            sum += squares[i];
        return ratio(std::sqrt(std::max(sum, 0.0) / double(count)), std::abs(mean));
    };
    std::sort(squares.begin(), squares.end());
    c.nrmse = root(squares.size());
    c.nrmseTrimmed = root(squares.size() - squares.size() / kWorstOneOf);
}

/// Error of a pixel as Comparison::relmse has it: mean over channels. `d` is test - reference `r`.
double relativeSquare(glm::dvec3 d, glm::dvec3 r, double meanR) {
    const glm::dvec3 base = r * r + kRelMseFloor * meanR * meanR;
    return (ratio(d.x * d.x, base.x) + ratio(d.y * d.y, base.y) + ratio(d.z * d.z, base.z)) / 3;
}

void numericErrors(const ImageF& test, const ImageF& reference, const std::vector<bool>& valid,
                   Comparison& c) {
    const double meanR = meanOfValid(reference, valid), meanT = meanOfValid(test, valid);
    std::vector<double> relative, squares;
    for (std::size_t i = 0; i < valid.size(); ++i) {
        if (!valid[i])
            continue;
        const glm::dvec3 r(reference.rgb[i]), d = glm::dvec3(test.rgb[i]) - r;
        squares.push_back(channelMean(d * d));
        relative.push_back(relativeSquare(d, r, meanR));
    }
    if (relative.empty())
        return;
    rootMeanSquares(squares, meanR, c);
    c.bias = ratio(meanT - meanR, meanR);
    std::sort(relative.begin(), relative.end());
    relative.resize(relative.size() - std::size_t(kRelMseDropped * double(relative.size())));
    for (double r : relative)
        c.relmse += r / double(relative.size());
}

// ACES as fitted by Narkowicz, 2015. In and out linear; out in [0, 1] is what a display emits.
glm::vec3 toneMap(glm::vec3 x) {
    x = glm::max(x, glm::vec3(0));
    return glm::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.f, 1.f);
}

float encodeSrgb(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

ImageF displayed(const ImageF& image, const std::vector<bool>& valid, float exposure) {
    ImageF result = image;
    for (std::size_t i = 0; i < valid.size(); ++i)
        result.rgb[i] = valid[i] ? toneMap(glm::min(image.rgb[i] * exposure, 1e6f)) : glm::vec3(0);
    return result;
}

/// The exposure at which the mean of the valid pixels is middle grey.
float exposureOf(const ImageF& reference, const std::vector<bool>& valid) {
    const double mean = meanOfValid(reference, valid);
    return mean > 0 ? float(double(kMiddleGrey) / mean) : 1;
}

Plane displayedLuminance(const ImageF& image) {
    Plane plane{image.width, image.height, {}};
    for (glm::vec3 c : image.rgb)
        plane.values.push_back(encodeSrgb(luminance(c)));
    return plane;
}

} // namespace

Result<Comparison> compareImages(const ImageF& test, const ImageF& reference) {
    if (!sameSize(test, reference))
        return fail(sizesDiffer(test, reference));
    const std::vector<bool> valid = validPixels(test, reference);
    Comparison c;
    c.invalidPixels = std::uint64_t(std::count(valid.begin(), valid.end(), false));
    numericErrors(test, reference, valid, c);
    const float exposure = exposureOf(reference, valid);
    const ImageF t = displayed(test, valid, exposure), r = displayed(reference, valid, exposure);
    c.ssim = meanOfValid(ssimMap(displayedLuminance(t), displayedLuminance(r)), valid, 1);
    c.flip = meanOfValid(flipMap(t, r), valid, 0);
    return c;
}

// With t = truth + e and r_k = truth + n_k, E[(t - r_1)(t - r_2)] = e^2 as long as n_1 and n_2 have
// zero mean and are independent of each other; (t - r)^2 has an expectation of e^2 + var(n).
// The product is (t - m)^2 - d^2 / 4 with m = (r_1 + r_2) / 2 and d = r_1 - r_2. Its variance,
// 2 e^2 var(n) + var(n)^2, is the expectation of (t - m)^2 d^2 for normal noise.
Result<Comparison> compareImages(const ImageF& test, const ImageF& reference,
                                 const ImageF& reference2) {
    for (const ImageF* r : {&reference, &reference2})
        if (!sameSize(test, *r))
            return fail(sizesDiffer(test, *r));
    const ImageF mean = meanImage(reference, reference2);
    Result<Comparison> c = compareImages(test, mean);
    if (!c)
        return c;
    const std::vector<bool> valid = validPixels(test, mean);
    std::vector<double> products;
    double noise = 0, productVariance = 0, meanVariance = 0;
    for (std::size_t i = 0; i < valid.size(); ++i) {
        if (!valid[i])
            continue;
        const glm::dvec3 t(test.rgb[i]), r1(reference.rgb[i]), r2(reference2.rgb[i]);
        const glm::dvec3 d = r1 - r2, m = (r1 + r2) / 2.0;
        products.push_back(channelMean((t - r1) * (t - r2)));
        noise += channelMean(d * d) / 4;                          // the variance of m
        const double spread = channelMean(glm::abs(d * (t - m))); // channels share their noise
        productVariance += spread * spread;
        meanVariance += channelMean(d) * channelMean(d) / 4;
    }
    if (products.empty())
        return c;
    const double scale = std::abs(meanOfValid(mean, valid)), count = double(products.size());
    c->referenceNoise = ratio(std::sqrt(noise / count), scale);
    c->biasNoise = ratio(std::sqrt(meanVariance) / count, scale);
    rootMeanSquares(products, scale, *c);
    const double squareNoise = ratio(std::sqrt(productVariance) / count, scale * scale);
    c->nrmseNoise = std::min(std::sqrt(squareNoise), ratio(squareNoise, 2 * c->nrmse));
    return c;
}

double meanOf(const ImageF& image) {
    double sum = 0;
    for (const glm::vec3 p : image.rgb)
        sum += channelMean(p);
    return sum / double(std::max<std::size_t>(image.rgb.size(), 1));
}

ImageF meanImage(const ImageF& a, const ImageF& b) {
    assert(sameSize(a, b));
    ImageF mean = a;
    for (std::size_t i = 0; i < mean.rgb.size(); ++i)
        mean.rgb[i] = 0.5f * a.rgb[i] + 0.5f * b.rgb[i];
    return mean;
}

// Ends of a blue to orange scale that is distinguishable with all kinds of colour blindness, sRGB.
Image errorHeatmap(const ImageF& test, const ImageF& reference) {
    constexpr glm::vec3 dark(5, 48, 97), white(247), bright(179, 88, 6), invalid(255, 0, 255);
    Image map{"error", reference.width, reference.height, {}};
    map.rgba.reserve(reference.rgb.size() * 4);
    const std::vector<bool> valid = validPixels(test, reference);
    const float floor = kHeatmapFloor * float(std::abs(meanOfValid(reference, valid)));
    for (std::size_t i = 0; i < valid.size(); ++i) {
        glm::vec3 color = invalid;
        if (valid[i]) {
            const float r = luminance(reference.rgb[i]), d = luminance(test.rgb[i]) - r;
            const float error = d == 0 ? 0 : d / (std::abs(r) + floor);
            const float amount = std::min(std::abs(error) / kHeatmapFull, 1.f);
            color = glm::mix(white, error < 0 ? dark : bright, amount);
        }
        for (int k = 0; k < 3; ++k)
            map.rgba.push_back(std::uint8_t(std::lround(color[k])));
        map.rgba.push_back(255);
    }
    return map;
}

Image flipHeatmap(const ImageF& test, const ImageF& reference) {
    Image map{"FLIP", reference.width, reference.height, {}};
    map.rgba.reserve(reference.rgb.size() * 4);
    const std::vector<bool> valid = validPixels(test, reference);
    const float exposure = exposureOf(reference, valid);
    const Plane flip =
        flipMap(displayed(test, valid, exposure), displayed(reference, valid, exposure));
    for (std::size_t i = 0; i < valid.size(); ++i) {
        const glm::vec3 color = valid[i] ? viridis(flip.values[i]) : glm::vec3(1, 0, 1);
        for (int k = 0; k < 3; ++k)
            map.rgba.push_back(std::uint8_t(std::lround(255 * color[k])));
        map.rgba.push_back(255);
    }
    return map;
}

Image squaredErrorHeatmap(const ImageF& test, const ImageF& reference) {
    Image map{"relMSE", reference.width, reference.height, {}};
    map.rgba.reserve(reference.rgb.size() * 4);
    const std::vector<bool> valid = validPixels(test, reference);
    const double mean = meanOfValid(reference, valid);
    for (std::size_t i = 0; i < valid.size(); ++i) {
        glm::vec3 color(1, 0, 1);
        if (valid[i]) {
            const glm::dvec3 r(reference.rgb[i]), d = glm::dvec3(test.rgb[i]) - r;
            const double error = relativeSquare(d, r, mean);
            const double decades = std::log10(std::max(error, kMinSquare) / kMinSquare);
            color = viridis(float(decades / -std::log10(kMinSquare)));
        }
        for (int k = 0; k < 3; ++k)
            map.rgba.push_back(std::uint8_t(std::lround(255 * color[k])));
        map.rgba.push_back(255);
    }
    return map;
}

std::uint64_t countInvalidPixels(const ImageF& image) {
    return std::uint64_t(
        std::count_if(image.rgb.begin(), image.rgb.end(), [](glm::vec3 p) { return !isValid(p); }));
}

} // namespace limn
