// SPDX-License-Identifier: MIT
#include "engine/measure/gaussian_filter.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace limn {

static constexpr std::size_t kRows = 16; ///< per task

Plane convolve(const Plane& plane, const std::vector<float>& kernelX,
               const std::vector<float>& kernelY) {
    const int w = int(plane.width), h = int(plane.height);
    const int rx = int(kernelX.size()) / 2, ry = int(kernelY.size()) / 2;
    Plane rows = plane, result = plane;
    parallelRanges(plane.height, kRows, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            const float* in = &plane.values[y * plane.width];
            for (int x = 0; x < w; ++x) {
                float sum = 0;
                for (int k = -rx; k <= rx; ++k)
                    sum += kernelX[std::size_t(k + rx)] * in[std::clamp(x + k, 0, w - 1)];
                rows.values[y * plane.width + std::size_t(x)] = sum;
            }
        }
    });
    parallelRanges(plane.height, kRows, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            float* out = &result.values[y * plane.width];
            std::fill(out, out + w, 0.f);
            for (int k = -ry; k <= ry; ++k) {
                const auto row = std::size_t(std::clamp(int(y) + k, 0, h - 1));
                const float* in = &rows.values[row * plane.width];
                const float weight = kernelY[std::size_t(k + ry)];
                for (int x = 0; x < w; ++x)
                    out[x] += weight * in[x];
            }
        }
    });
    return result;
}

std::vector<float> gaussianKernel(float sigma, int radius) {
    std::vector<float> kernel;
    float sum = 0;
    for (int x = -radius; x <= radius; ++x) {
        kernel.push_back(std::exp(-float(x * x) / (2 * sigma * sigma)));
        sum += kernel.back();
    }
    for (float& k : kernel)
        k /= sum;
    return kernel;
}

} // namespace limn
