// SPDX-License-Identifier: MIT
// replay FOLDER: calls the target with each file of a corpus, as a test without libFuzzer. Fails
// where there is none, where one takes too long and where all together take too much memory;
// crashes where the target does.
#include "engine/core/process_memory.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <chrono>
#include <vector>

using namespace limn;

int main(int argc, char** argv) {
    constexpr double kMaxSeconds = 20;               // as .ci/fuzz allows
    constexpr std::uint64_t kMaxMemory = 2ULL << 30; // of resident memory [bytes]
    std::vector<std::filesystem::path> files;
    std::error_code error;
    if (argc == 2)
        for (const auto& entry : std::filesystem::directory_iterator(argv[1], error))
            files.push_back(entry.path());
    std::ranges::sort(files);
    if (files.empty()) {
        std::fprintf(stderr, "usage: %s FOLDER, with a corpus\n", argv[0]);
        return 2;
    }
    for (const std::filesystem::path& file : files) {
        std::fprintf(stderr, "%s\n", file.filename().c_str());
        const std::string bytes = fileBytes(file.string());
        const auto begin = std::chrono::steady_clock::now();
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        require(took.count() < kMaxSeconds, "an input takes less than 20 s");
    }
    require(peakMemory() < kMaxMemory, "a corpus takes less than 2 GiB");
    std::fprintf(stderr, "%zu inputs\n", files.size());
    return 0;
}
