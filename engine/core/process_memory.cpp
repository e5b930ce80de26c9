// SPDX-License-Identifier: MIT
#include "engine/core/process_memory.h"

#include <cstdio>

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

namespace limn {

std::uint64_t residentMemory() {
    std::FILE* file = std::fopen("/proc/self/statm", "r");
    if (!file)
        return 0;
    unsigned long long all = 0, resident = 0;
    const bool read = std::fscanf(file, "%llu %llu", &all, &resident) == 2;
    std::fclose(file);
    return read ? resident * std::uint64_t(sysconf(_SC_PAGESIZE)) : 0;
}

std::uint64_t peakMemory() {
    rusage usage{};
    constexpr std::uint64_t kUnit = 1024; // ru_maxrss is in KiB
    return getrusage(RUSAGE_SELF, &usage) == 0 ? std::uint64_t(usage.ru_maxrss) * kUnit : 0;
}

void releaseFreedMemory() {
    malloc_trim(0);
}

} // namespace limn
