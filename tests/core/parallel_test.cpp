// SPDX-License-Identifier: MIT
#include "engine/core/parallel.h"

#include "engine/core/flush_denormals.h"
#include "engine/core/hash.h"

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cstdint>
#include <vector>

namespace limn::parallel_test {
namespace {

TEST(ParallelRanges, VisitEveryItemOnce) {
    for (const std::size_t count :
         {std::size_t(0), std::size_t(1), std::size_t(7), std::size_t(100000)})
        for (const std::size_t grain : {std::size_t(1), std::size_t(64), std::size_t(1000000)}) {
            if (count == 100000 && grain == 1)
                continue;
            std::vector<int> visits(count), withProgress(count);
            parallelRanges(count, grain, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    ++visits[i];
            });
            EXPECT_TRUE(parallelRanges(count, grain, Progress{}, "test",
                                       [&](std::size_t begin, std::size_t end) {
                                           for (std::size_t i = begin; i < end; ++i)
                                               ++withProgress[i];
                                       }));
            EXPECT_EQ(visits, std::vector<int>(count, 1));
            EXPECT_EQ(withProgress, std::vector<int>(count, 1));
        }
}

#if defined(__SSE2__)

/// Whether arithmetic makes denormals, and whether it takes them.
bool makesDenormals() {
    volatile float least = 0x1p-126f, half = 0.5f;
    return std::bit_cast<std::uint32_t>(least * half) != 0; // compared as floats they may be 0
}
bool takesDenormals() {
    volatile float denormal = 0x1p-130f, much = 0x1p100f;
    return denormal * much != 0;
}

TEST(FlushDenormals, AreZeroForAsLongAsItLives) {
    EXPECT_TRUE(makesDenormals() && takesDenormals());
    {
        const FlushDenormals outer;
        {
            const FlushDenormals inner;
            EXPECT_FALSE(makesDenormals() || takesDenormals());
        }
        EXPECT_FALSE(makesDenormals() || takesDenormals());
    }
    EXPECT_TRUE(makesDenormals() && takesDenormals());
}

TEST(ParallelRanges, FlushDenormalsOnEveryThreadAndOnlyWithin) {
    std::atomic<int> wrong = 0;
    const auto check = [&](std::size_t, std::size_t) {
        wrong += makesDenormals() || takesDenormals();
    };
    parallelRanges(1000, 1, check);
    EXPECT_TRUE(parallelRanges(1000, 1, Progress{}, "test", check));
    EXPECT_EQ(wrong, 0);
    EXPECT_TRUE(makesDenormals() && takesDenormals());
}

#endif

TEST(ParallelRanges, StopSoonAfterTheyAreCancelled) {
    std::atomic<bool> cancel = false;
    std::atomic<int> ranges = 0;
    Progress progress;
    progress.cancel = &cancel;
    const ThreadLimit one(1);
    EXPECT_FALSE(parallelRanges(1000, 1, progress, "test", [&](std::size_t, std::size_t) {
        if (++ranges == 10)
            cancel = true;
    }));
    EXPECT_EQ(ranges, 10);
}

TEST(ParallelRanges, ReportTheirStageUpToTheEnd) {
    float last = -1;
    Progress progress;
    progress.report = [&](const char* stage, float fraction) {
        EXPECT_STREQ(stage, "test");
        EXPECT_GE(fraction, last);
        last = fraction;
    };
    const ThreadLimit one(1);
    EXPECT_TRUE(parallelRanges(10, 3, progress, "test", [](std::size_t, std::size_t) {}));
    EXPECT_EQ(last, 1);
}

TEST(Hash, DependsOnEveryByteTheLengthAndTheOrder) {
    const std::vector<std::uint32_t> a = {1, 2, 3}, b = {1, 2}, c = {3};
    EXPECT_NE(hashVector(a, 0), hashVector(std::vector<std::uint32_t>{1, 2, 4}, 0));
    EXPECT_NE(hashVector(c, hashVector(b, 0)), hashVector(b, hashVector(c, 0)));
    EXPECT_NE(hashVector(a, 0), hashVector(c, hashVector(b, 0)));
    EXPECT_EQ(hexHash(0xabcULL), "0000000000000abc");
}

} // namespace
} // namespace limn::parallel_test
