// SPDX-License-Identifier: MIT
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace limn {

/// For as long as the object lives, this thread's float arithmetic takes denormal numbers, those
/// below 2^-126, for 0, and gives 0 for them: some processors do them many times more slowly. On
/// x86; elsewhere nothing changes. What was set before holds again afterwards.
class FlushDenormals {
public:
#if defined(__SSE2__)
    FlushDenormals() : m_before(_mm_getcsr()) {
        constexpr unsigned kFlushToZero = 1U << 15, kDenormalsAreZero = 1U << 6; // of MXCSR
        _mm_setcsr(m_before | kFlushToZero | kDenormalsAreZero);
    }
    ~FlushDenormals() {
        _mm_setcsr(m_before);
    }
#else
    FlushDenormals() {}
    ~FlushDenormals() {}
#endif
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
#if defined(__SSE2__)
    unsigned m_before;
#endif
};

} // namespace limn
