// SPDX-License-Identifier: MIT
#include "app/commands/light_on_cpu.h"

#include "app/commands/progress_line.h"
#include "app/commands/read_bake_of.h"

#include "engine/techniques/technique_table.h"

#include <utility>

#include <fmt/format.h>

namespace limn {

Result<ConvergedLight> lightOnCpu(const SceneOptions& options, const std::string& bakeFile,
                                  Scene scene, LitFor reader, const Viewpoint* view) {
    const Technique& technique = *findTechnique(scene.technique.technique);
    const Precomputation* precomputation = technique.precomputation;
    const MemoryBudget& memory = options.import.memory;
    Result<std::shared_ptr<const Precomputed>> data;
    if (!bakeFile.empty()) {
        if (!precomputation)
            return fail(fmt::format("--bake: the technique \"{}\" needs none", technique.name));
        data = readBakeOf(scene, options.scene, *precomputation, bakeFile, memory);
    }
    const auto shared = std::make_shared<const Scene>(std::move(scene));
    const auto trace = std::make_shared<const TraceScene>(*shared);
    if (precomputation && bakeFile.empty())
        data = precomputation->prepare(*trace, {.memory = memory}, progressOnStderr());
    if (!data) {
        endProgressLine();
        return tl::make_unexpected(data.error());
    }
    Result<ConvergedLight> lit =
        convergeLight(shared, trace, technique, {*data, shared}, reader, progressOnStderr(), view);
    endProgressLine();
    return lit;
}

} // namespace limn
