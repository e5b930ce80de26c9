// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/cut_scene.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/straight_charts.h"

#include <algorithm>
#include <utility>

namespace limn {

CutScene cutScene(const Scene& scene, const std::vector<MeshCharts>& charts,
                  const SceneCuts& cuts) {
    CutScene cut{scene, charts, {}};
    cut.sources.resize(scene.instances.size());
    auto assets = std::make_shared<Assets>();
    assets->meshes = scene.assets->meshes;
    std::vector<std::uint32_t> cutInstances;
    for (std::uint32_t i = 0; i < cuts.size(); ++i)
        if (std::ranges::any_of(cuts[i], [](const ChartCuts& c) { return !c.nodes.empty(); }))
            cutInstances.push_back(i);
    std::vector<CutMesh> meshes(cutInstances.size());
    parallelRanges(meshes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const std::uint32_t mesh = scene.instances[cutInstances[k]].mesh;
            meshes[k] = cutMesh(scene.assets->meshes[mesh], charts[mesh], cuts[cutInstances[k]]);
        }
    });
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        cut.scene.instances[cutInstances[k]].mesh = std::uint32_t(assets->meshes.size());
        assets->meshes.push_back(std::move(meshes[k].mesh));
        cut.charts.push_back(std::move(meshes[k].charts));
        cut.sources[cutInstances[k]] =
            std::make_shared<const CutSource>(std::move(meshes[k].source));
    }
    parallelRanges(cut.charts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m)
            straightenCharts(cut.charts[m]);
    });
    cut.scene.assets = std::move(assets);
    return cut;
}

} // namespace limn
