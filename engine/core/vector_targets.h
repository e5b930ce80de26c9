// SPDX-License-Identifier: MIT
// Include before Highway, in sources that are compiled once for each kind of vector unit.
#pragma once

/// Kinds of vector unit that nothing is compiled for: plain code, AVX2 and AVX-512 are enough. The
/// sanitizers do without AVX-512: its kernels would take the compiler five minutes a file there.
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define LIMN_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define LIMN_ADDRESS_SANITIZER
#endif
#ifdef LIMN_ADDRESS_SANITIZER
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | HWY_AVX3)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#endif
