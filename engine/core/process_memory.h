// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace limn {

/// Resident memory of this process [bytes].
std::uint64_t residentMemory();

/// Maximum resident memory since the process started [bytes].
std::uint64_t peakMemory();

/// Returns memory that the allocator has kept after it was freed to the operating system. After a
/// job that made many small arrays, it is most of what the process holds.
void releaseFreedMemory();

} // namespace limn
