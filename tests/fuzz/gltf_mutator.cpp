// SPDX-License-Identifier: MIT
// Changes the JSON of a glTF value by value, and keeps the lengths of a .glb right.
#include "tests/fuzz/json_mutation.h"

#include <algorithm>
#include <cstring>

using namespace limn;

namespace {

constexpr std::size_t kHeader = 20; // of the file and of its first chunk

std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
}

void setWord(std::string& bytes, std::size_t at, std::size_t value) {
    const auto narrow = std::uint32_t(value);
    std::memcpy(&bytes[at], &narrow, sizeof narrow);
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    std::string file(data, data + size);
    const bool binary =
        file.starts_with("glTF") && size >= kHeader && word(file, 12) <= size - kHeader;
    if (seed % 8 == 0) // anything anywhere
        return LLVMFuzzerMutate(data, size, most);
    if (!binary) {
        const bool changed = mutateJson(file, seed);
        const std::size_t done = changed ? putText(file, data, most) : 0;
        return done ? done : LLVMFuzzerMutate(data, size, most);
    }
    std::string json = file.substr(kHeader, word(file, 12)),
                rest = file.substr(kHeader + json.size());
    if (seed % 8 < 3 && rest.size() > 8) { // the buffer
        std::string content = rest.substr(8);
        const std::size_t had = content.size();
        content.resize(had + 16);
        content.resize(
            LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(content.data()), had, content.size()));
        rest = rest.substr(0, 8) + content;
        setWord(rest, 0, content.size());
    } else if (mutateJson(json, seed)) {
        json.resize((json.size() + 3) / 4 * 4, ' ');
    }
    file = file.substr(0, kHeader) + json + rest;
    setWord(file, 8, file.size());
    setWord(file, 12, json.size());
    const std::size_t done = putText(file, data, most);
    return done ? done : LLVMFuzzerMutate(data, size, most);
}
