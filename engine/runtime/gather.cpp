// SPDX-License-Identifier: MIT
#include "engine/runtime/gather.h"

namespace limn::runtime {

void gatherCaches(const Gather& gather, std::uint32_t begin, std::uint32_t end) {
#if LIMNRT_WIDE_VECTORS
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma"))
        return gatherWidest(gather, begin, end);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return gatherWide(gather, begin, end);
#endif
    gatherNarrow(gather, begin, end);
}

} // namespace limn::runtime
