// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/papers/composition.h"

#include "engine/techniques/illuminance/format/bake_bytes.h"

#include <array>

#include <fmt/format.h>

namespace limn {

namespace {

/// A part of the memory: what is counted, and how much Table 4 prints.
struct MemoryPart {
    const char* name;
    std::uint64_t bytes, count;
    std::optional<double> mebibytes, bytesEach;
};

PaperLine lineOf(const MemoryPart& part) {
    PaperLine line;
    line.figures.push_back({"MiB", double(part.bytes) / (1 << 20), 0, part.mebibytes});
    if (part.count > 0) {
        line.figures.push_back(
            {"bytes each", double(part.bytes) / double(part.count), 0, part.bytesEach});
        line.figures.push_back({"count", double(part.count), 0, {}});
    }
    return line;
}

/// A bake of Table 4 and of the totals in Section 5.3.4.
struct MemoryBake {
    const char* name;
    BakeSettings settings;
    double total; ///< printed [MiB]
};

Result<std::vector<MemoryPart>> partsOf(PaperRun& run, const MemoryBake& wanted) {
    const Result<const FrontScene*> front = run.scene(kPaperSponza);
    if (!front)
        return tl::make_unexpected(front.error());
    const auto baked = bakeFor(run, **front, wanted.settings);
    if (!baked)
        return tl::make_unexpected(baked.error());
    const Bake& bake = **baked;
    const RelightStats stats = relightRuns(**front, *baked, 1).back();
    const BakeBytes bytes = bytesOf(bake);
    // The paper's counts are of settings 1: 128 k surfels, 256 k nodes, 2 689 k links.
    const bool one = wanted.settings.bands == 4, rtp = wanted.settings.storage == LinkStorage::Rtp;
    const auto ifOne = [&](double value) { return one ? std::optional(value) : std::nullopt; };
    return std::vector<MemoryPart>{
        {"surfels", bytes.surfels, bake.surfels.position.size(), ifOne(1.46), ifOne(12)},
        {"hierarchy", bytes.clusters, bake.tree.size(), ifOne(8.30), ifOne(34)},
        {"caches", bytes.caches, bake.caches.size(), ifOne(1.71), ifOne(96)},
        {"links", bytes.links, bake.caches.linkCount(), ifOne(rtp ? 30.08 : 92.31),
         ifOne(rtp ? 12 : 36)},
        {"beside the bake", stats.bytes, 0, ifOne(0.57), {}},
        {"all", bytes.total() + stats.bytes, 0, wanted.total, {}}};
}

} // namespace

Result<void> measureMemory(PaperRun& run) {
    std::array<MemoryBake, 4> bakes = {{{"RTP", paperSettings1(LinkMode::Limn), 42.8},
                                        {"SH", paperSettings1(LinkMode::Limn), 104.3},
                                        {"settings 2, RTP", paperSettings2(LinkMode::Limn), 19.3},
                                        {"settings 2, SH", paperSettings2(LinkMode::Limn), 32.2}}};
    bakes[1].settings.storage = bakes[3].settings.storage = LinkStorage::Sh;
    constexpr std::array kParts = {"surfels", "hierarchy",       "caches",
                                   "links",   "beside the bake", "all"};
    for (const MemoryBake& wanted : bakes) {
        std::optional<std::vector<MemoryPart>> parts; // found for the first line that is not kept
        for (std::size_t k = 0; k < kParts.size(); ++k) {
            const auto measure = [&]() -> Result<PaperLine> {
                if (!parts) {
                    Result<std::vector<MemoryPart>> found = partsOf(run, wanted);
                    if (!found)
                        return tl::make_unexpected(found.error());
                    parts = std::move(*found);
                }
                return lineOf((*parts)[k]);
            };
            const std::string name = fmt::format("{}: {}", wanted.name, kParts[k]);
            if (const Result<void> added = run.line("T4", name, measure); !added)
                return added;
        }
    }
    return {};
}

} // namespace limn
