// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>

namespace limn {

/// Half of the machine's memory [bytes].
std::uint64_t halfOfMemory();

/// Formats a size for people: "7.5 GiB", "20 MiB".
std::string bytesText(std::uint64_t bytes);

/// Maximum memory that a job may use. Readers check it before they allocate an amount that a file
/// or an option can make large.
struct MemoryBudget {
    std::uint64_t maxBytes = halfOfMemory(); ///< [bytes]

    /// Fails if `needed` exceeds the budget: "{what} would need 7.5 GiB of memory, 4 GiB are
    /// allowed (--memory)".
    Result<void> allow(const std::string& what, std::uint64_t needed) const;
};

} // namespace limn
