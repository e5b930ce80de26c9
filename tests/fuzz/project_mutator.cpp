// SPDX-License-Identifier: MIT
// Changes a project value by value.
#include "tests/fuzz/json_mutation.h"

using namespace limn;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    std::string text(data, data + size);
    const bool changed = seed % 8 != 0 && mutateJson(text, seed);
    const std::size_t done = changed ? putText(text, data, most) : 0;
    return done ? done : LLVMFuzzerMutate(data, size, most);
}
