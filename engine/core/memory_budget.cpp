// SPDX-License-Identifier: MIT
#include "engine/core/memory_budget.h"

#include <fmt/format.h>
#include <unistd.h>

namespace limn {

std::uint64_t halfOfMemory() {
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    constexpr std::uint64_t kUnknown = std::uint64_t(4) << 30;
    return pages > 0 && size > 0 ? std::uint64_t(pages) * std::uint64_t(size) / 2 : kUnknown;
}

std::string bytesText(std::uint64_t bytes) {
    constexpr double kMiB = 1 << 20, kGiB = 1 << 30;
    const auto b = double(bytes);
    return b < kGiB ? fmt::format("{:.3g} MiB", b / kMiB) : fmt::format("{:.3g} GiB", b / kGiB);
}

Result<void> MemoryBudget::allow(const std::string& what, std::uint64_t needed) const {
    if (needed <= maxBytes)
        return {};
    return fail(fmt::format("{} would need {} of memory, {} are allowed (--memory)", what,
                            bytesText(needed), bytesText(maxBytes)));
}

} // namespace limn
