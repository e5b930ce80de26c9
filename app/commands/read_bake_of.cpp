// SPDX-License-Identifier: MIT
#include "app/commands/read_bake_of.h"

#include "engine/core/log.h"

#include <fmt/format.h>

namespace limn {

Result<std::shared_ptr<const Precomputed>> readBakeOf(Scene& scene, const std::string& sceneName,
                                                      const Precomputation& precomputation,
                                                      const std::string& file,
                                                      const MemoryBudget& memory) {
    auto read = precomputation.read(file, memory);
    if (!read)
        return read;
    scene.bake = (*read)->settings();
    if ((*read)->inputHash() != precomputation.inputHash(scene))
        return fail(
            fmt::format("{}: is the bake of another scene than {}, or of an older state of it",
                        file, sceneName));
    if (const std::string defect = (*read)->defect(scene); !defect.empty())
        return fail(fmt::format("{}: {}", file, defect));
    for (const std::string& note : (*read)->report().notes)
        logWarning(fmt::format("{}: {}", file, note));
    return read;
}

} // namespace limn
