// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace limn {

/// Memory of this process that lies in the machine's RAM [bytes].
std::uint64_t residentMemory();

/// The most that it has been since the process started [bytes].
std::uint64_t peakMemory();

/// Gives memory that was freed, but kept to be used again, back to the machine. After a job that
/// made many small arrays they are most of what the process holds.
void releaseFreedMemory();

} // namespace limn
