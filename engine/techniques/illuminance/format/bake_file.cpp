// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/bake_file.h"

#include "engine/stages/chunk_file.h"
#include "engine/techniques/illuminance/format/bake_defect.h"
#include "engine/techniques/illuminance/format/bake_fields.h"

#include <fmt/format.h>

namespace limn {

static constexpr ChunkFormat kFormat = {kBakeMark, 7, "BAKER   "};

static constexpr auto kForChunks = [](const auto& visit) {
    forBakeChunks(nullptr, visit);
    visit("BAKER   ", [](auto& a, auto& bake) { a("baker", bake.baker, rule::any); });
};

Result<void> writeBake(const std::string& path, const Bake& bake) {
    return writeChunks(path, kFormat, bake, kForChunks);
}

Result<Bake> readBake(const std::string& path, const MemoryBudget& memory) {
    Result<Bake> bake = readChunks<Bake>(path, kFormat, memory, kForChunks);
    if (!bake)
        return bake;
    if (const std::string defect = bakeDefect(*bake, nullptr); !defect.empty())
        return fail(fmt::format("{}: {}", path, defect));
    if (bake->baker < kBakerVersion)
        bake->notes.push_back(fmt::format(
            "made by version {} of the baker; this Limn has version {}, whose light is closer to "
            "the truth: bake again",
            bake->baker, kBakerVersion));
    return bake;
}

} // namespace limn
