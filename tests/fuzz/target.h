// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/parallel.h"
#include "tests/core/temporary_folder.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

/// What a fuzzer, or the replay of a corpus, calls with one input. Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace limn {

/// What readers may take for one input.
inline constexpr MemoryBudget kFuzzMemory{std::uint64_t(64) << 20};

/// Stops the program, and so reports the input, where `holds` is false.
inline void require(bool holds, std::string_view what) {
    if (holds)
        return;
    std::fprintf(stderr, "broken promise: %.*s\n", int(what.size()), what.data());
    std::abort();
}

/// A file of this process that holds `bytes`; returns its path.
inline std::string scratchFile(const std::string& name, std::string_view bytes) {
    static const TemporaryFolder folder;
    const std::string path = folder.file(name);
    writeFile(path, std::string(bytes));
    return path;
}

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// One thread works on an input, so that each run of it is the same.
inline void useOneThread() {
    static const ThreadLimit one(1);
}

} // namespace limn
