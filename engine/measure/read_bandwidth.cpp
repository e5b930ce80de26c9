// SPDX-License-Identifier: MIT
#include "engine/measure/read_bandwidth.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

namespace limn {

double measureReadBandwidth(std::size_t bytes) {
    constexpr int kPasses = 7;
    const std::vector<std::uint64_t> data(std::max<std::size_t>(bytes / sizeof(std::uint64_t), 1),
                                          1);
    std::atomic<std::uint64_t> sum = 0; // read, so that the passes are not optimised away
    double best = 1e30;
    for (int pass = 0; pass < kPasses; ++pass) {
        const auto start = std::chrono::steady_clock::now();
        parallelRanges(data.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
            std::uint64_t part[8] = {};
            for (std::size_t i = begin; i + 8 <= end; i += 8)
                for (std::size_t k = 0; k < 8; ++k)
                    part[k] += data[i + k];
            for (const std::uint64_t p : part)
                sum += p;
        });
        best = std::min(
            best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return sum > 0 ? double(data.size() * sizeof(std::uint64_t)) / best : 0;
}

} // namespace limn
