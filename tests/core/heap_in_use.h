// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <malloc.h>

namespace limn {

/// Memory that was allocated from the main arena and not freed [bytes]. Threads that started before
/// mallopt(M_ARENA_MAX, 1) may have arenas of their own, which do not count.
inline std::size_t heapInUse() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

} // namespace limn
