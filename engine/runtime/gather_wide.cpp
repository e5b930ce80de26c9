// SPDX-License-Identifier: MIT
#include "engine/runtime/gather.h"

#if LIMNRT_WIDE_VECTORS
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif
#define LIMNRT_LANES 8
#include "engine/runtime/gather_range.h"

namespace limn::runtime {

void gatherWide(const Gather& gather, std::uint32_t begin, std::uint32_t end) {
    gatherRange(gather, begin, end);
}

} // namespace limn::runtime
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
