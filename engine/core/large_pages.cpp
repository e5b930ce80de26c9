// SPDX-License-Identifier: MIT
#include "engine/core/large_pages.h"

#include <cstdint>

#include <sys/mman.h>

namespace limn {

void preferLargePages(void* begin, std::size_t bytes) {
    constexpr std::uintptr_t kPage = 2U << 20;
    const auto from = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = (from + kPage - 1) / kPage * kPage,
                         last = (from + bytes) / kPage * kPage;
    if (begin && first < last)
        madvise(static_cast<char*>(begin) + (first - from), last - first, MADV_HUGEPAGE);
}

} // namespace limn
