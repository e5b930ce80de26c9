// SPDX-License-Identifier: MIT
#include "engine/measure/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

// Converts linear Rec. 709 to XYZ, divided by the white point, which (1, 1, 1) maps to.
glm::vec3 toXyz(glm::vec3 c) {
    const glm::mat3 m(0.4124564f, 0.2126729f, 0.0193339f, 0.3575761f, 0.7151522f, 0.1191920f,
                      0.1804375f, 0.0721750f, 0.9503041f);
    return (m * c) / (m * glm::vec3(1));
}

glm::vec3 fromXyz(glm::vec3 xyz) {
    const glm::mat3 m(0.4124564f, 0.2126729f, 0.0193339f, 0.3575761f, 0.7151522f, 0.1191920f,
                      0.1804375f, 0.0721750f, 0.9503041f);
    static const glm::mat3 inverse = glm::inverse(m);
    return inverse * (xyz * (m * glm::vec3(1)));
}

// Opponent colours Y Cx Cz: CIELab without its cube root.
glm::vec3 toOpponent(glm::vec3 c) {
    const glm::vec3 t = toXyz(c);
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

glm::vec3 fromOpponent(glm::vec3 o) {
    const float y = (o.x + 16) / 116;
    return fromXyz({y + o.y / 500, y, y - o.z / 200});
}

float labCurve(float t) {
    constexpr float delta = 6.f / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.f / 29;
}

// CIELab with the Hunt effect: colours of dark surfaces look less colourful.
glm::vec3 huntLab(glm::vec3 c) {
    const glm::vec3 xyz = toXyz(c);
    const glm::vec3 f(labCurve(xyz.x), labCurve(xyz.y), labCurve(xyz.z));
    const float L = 116 * f.y - 16;
    return {L, 0.01f * L * 500 * (f.x - f.y), 0.01f * L * 200 * (f.y - f.z)};
}

float hyab(glm::vec3 a, glm::vec3 b) {
    const glm::vec3 d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

/// Contrast sensitivity of one opponent channel: sum of a sqrt(pi / b) exp(-pi^2 x^2 / b), x [deg].
struct Sensitivity {
    float a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivity = {Sensitivity{1, 0.0047f, 0, 1e-5f},
                                                     Sensitivity{1, 0.0053f, 0, 1e-5f},
                                                     Sensitivity{34.1f, 0.04f, 13.5f, 0.025f}};
constexpr float kWidestB = 0.04f;
constexpr float kQc = 0.7f, kPc = 0.4f, kPt = 0.95f; // colour: exponent and knee
constexpr float kGw = 0.082f, kQf = 0.5f;            // features: width [deg] and exponent

Plane channelOf(const std::vector<glm::vec3>& pixels, const Plane& shape, int channel) {
    Plane plane = shape;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        plane.values[i] = pixels[i][channel];
    return plane;
}

std::vector<float> rawGaussian(float b, int radius, float ppd) {
    std::vector<float> kernel;
    for (int x = -radius; x <= radius; ++x) {
        const float d = float(x) / ppd;
        kernel.push_back(std::exp(-glm::pi<float>() * glm::pi<float>() * d * d / b));
    }
    return kernel;
}

float sumOf(const std::vector<float>& v) {
    float sum = 0;
    for (float x : v)
        sum += x;
    return sum;
}

// The kernel's two Gaussians are separable one by one; together they sum to 1.
Plane filterByEye(const Plane& plane, const Sensitivity& s, float ppd) {
    const float pi = glm::pi<float>();
    const int radius = int(std::ceil(3 * std::sqrt(kWidestB / (2 * pi * pi)) * ppd));
    const std::vector<float> g1 = rawGaussian(s.b1, radius, ppd),
                             g2 = rawGaussian(s.b2, radius, ppd);
    const float w1 = s.a1 * std::sqrt(pi / s.b1), w2 = s.a2 * std::sqrt(pi / s.b2);
    const float sum1 = sumOf(g1), sum2 = sumOf(g2);
    const float total = w1 * sum1 * sum1 + w2 * sum2 * sum2;
    Plane result = convolve(plane, g1, g1);
    for (float& v : result.values)
        v *= w1 / total;
    if (w2 == 0)
        return result;
    const Plane second = convolve(plane, g2, g2);
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] += w2 / total * second.values[i];
    return result;
}

std::vector<glm::vec3> perceivedColors(const std::vector<glm::vec3>& opponent, const Plane& shape,
                                       float ppd) {
    std::array<Plane, 3> filtered;
    for (int c = 0; c < 3; ++c)
        filtered[std::size_t(c)] =
            filterByEye(channelOf(opponent, shape, c), kSensitivity[std::size_t(c)], ppd);
    std::vector<glm::vec3> lab(opponent.size());
    for (std::size_t i = 0; i < lab.size(); ++i) {
        const glm::vec3 o(filtered[0].values[i], filtered[1].values[i], filtered[2].values[i]);
        lab[i] = huntLab(glm::clamp(fromOpponent(o), 0.f, 1.f));
    }
    return lab;
}

// Differences up to kPc of the largest use kPt of the range.
float redistribute(float power, float largest) {
    const float knee = kPc * largest;
    return power < knee ? kPt / knee * power : kPt + (power - knee) / (largest - knee) * (1 - kPt);
}

/// First (edges) and second (points) derivative of a Gaussian; each sign's weights sum to 1.
struct FeatureKernels {
    std::vector<float> smooth, edge, point;
};

FeatureKernels featureKernels(float ppd) {
    const float sd = 0.5f * kGw * ppd;
    const int radius = int(std::ceil(3 * sd));
    FeatureKernels k;
    k.smooth = gaussianKernel(sd, radius);
    for (int x = -radius; x <= radius; ++x) {
        const float g = k.smooth[std::size_t(x + radius)], fx = float(x);
        k.edge.push_back(-fx * g);
        k.point.push_back((fx * fx / (sd * sd) - 1) * g);
    }
    for (std::vector<float>* kernel : {&k.edge, &k.point}) {
        float positive = 0, negative = 0;
        for (float w : *kernel)
            (w > 0 ? positive : negative) += std::abs(w);
        for (float& w : *kernel)
            w /= w > 0 ? positive : negative;
    }
    return k;
}

Plane magnitude(const Plane& grey, const std::vector<float>& derivative,
                const std::vector<float>& smooth) {
    Plane x = convolve(grey, derivative, smooth);
    const Plane y = convolve(grey, smooth, derivative);
    for (std::size_t i = 0; i < x.values.size(); ++i)
        x.values[i] = std::hypot(x.values[i], y.values[i]);
    return x;
}

std::vector<glm::vec3> opponentOf(const ImageF& image) {
    std::vector<glm::vec3> result;
    result.reserve(image.rgb.size());
    for (glm::vec3 c : image.rgb)
        result.push_back(toOpponent(glm::clamp(c, 0.f, 1.f)));
    return result;
}

Plane greyOf(const std::vector<glm::vec3>& opponent, const Plane& shape) {
    Plane grey = channelOf(opponent, shape, 0);
    for (float& v : grey.values)
        v = (v + 16) / 116;
    return grey;
}

} // namespace

Plane flipMap(const ImageF& test, const ImageF& reference, float ppd) {
    assert(test.width == reference.width && test.height == reference.height);
    Plane result{test.width, test.height, std::vector<float>(test.rgb.size())};
    const std::vector<glm::vec3> ot = opponentOf(test), oref = opponentOf(reference);
    const std::vector<glm::vec3> labT = perceivedColors(ot, result, ppd),
                                 labR = perceivedColors(oref, result, ppd);
    const FeatureKernels k = featureKernels(ppd);
    const Plane greyT = greyOf(ot, result), greyR = greyOf(oref, result);
    const Plane edgeT = magnitude(greyT, k.edge, k.smooth),
                edgeR = magnitude(greyR, k.edge, k.smooth);
    const Plane pointT = magnitude(greyT, k.point, k.smooth),
                pointR = magnitude(greyR, k.point, k.smooth);
    const float largest = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), kQc);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float color = redistribute(std::pow(hyab(labT[i], labR[i]), kQc), largest);
        const float feature = std::max(std::abs(edgeT.values[i] - edgeR.values[i]),
                                       std::abs(pointT.values[i] - pointR.values[i]));
        const float amplify = std::pow(feature / glm::root_two<float>(), kQf);
        result.values[i] = std::pow(color, 1 - amplify);
    }
    return result;
}

} // namespace limn
