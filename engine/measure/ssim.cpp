// SPDX-License-Identifier: MIT
#include "engine/measure/ssim.h"

namespace limn {

static Plane product(const Plane& a, const Plane& b) {
    Plane p = a;
    for (std::size_t i = 0; i < p.values.size(); ++i)
        p.values[i] *= b.values[i];
    return p;
}

Plane ssimMap(const Plane& a, const Plane& b) {
    constexpr float c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;
    const std::vector<float> window = gaussianKernel(1.5f, 5);
    const Plane ma = convolve(a, window, window), mb = convolve(b, window, window);
    const Plane aa = convolve(product(a, a), window, window);
    const Plane bb = convolve(product(b, b), window, window);
    const Plane ab = convolve(product(a, b), window, window);
    Plane result = a;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float x = ma.values[i], y = mb.values[i];
        const float varA = aa.values[i] - x * x, varB = bb.values[i] - y * y;
        const float cov = ab.values[i] - x * y;
        result.values[i] =
            (2 * x * y + c1) * (2 * cov + c2) / ((x * x + y * y + c1) * (varA + varB + c2));
    }
    return result;
}

} // namespace limn
