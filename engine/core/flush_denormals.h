// SPDX-License-Identifier: MIT
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace limn {

/// While the object lives, this thread's float arithmetic treats denormal inputs and results (below
/// 2^-126) as 0, because some processors are many times slower with them. Only on x86; elsewhere it
/// has no effect. The destructor restores the previous mode.
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
