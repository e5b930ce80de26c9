// SPDX-License-Identifier: MIT
#pragma once

#include "engine/final_lightmap/cut_mesh.h"
#include "engine/scene/scene.h"

#include <memory>
#include <vector>

namespace limn {

/// A scene whose meshes are cut along pieces of their charts, for lightmaps.
struct CutScene {
    Scene scene;                    ///< with meshes of its own, and without images
    std::vector<MeshCharts> charts; ///< per mesh
    /// Per instance; null: its mesh is that of the scene before.
    std::vector<std::shared_ptr<const CutSource>> sources;

    /// The same point in the scene before.
    MeshPoint toSource(std::uint32_t instance, const MeshPoint& point) const {
        return sources[instance] ? sources[instance]->toSource(point) : point;
    }
    MeshPoint fromSource(std::uint32_t instance, const MeshPoint& point) const {
        return sources[instance] ? sources[instance]->fromSource(point) : point;
    }
    /// The chart before from which a chart was cut, and the number of the piece.
    CutSource::Chart chartBefore(std::uint32_t instance, std::uint32_t chart) const {
        return sources[instance] ? sources[instance]->charts[chart] : CutSource::Chart{chart, 0};
    }
};

/// Per instance and chart; empty, as a whole or for an instance: all stay whole.
using SceneCuts = std::vector<std::vector<ChartCuts>>;

/// Cuts the meshes of those instances that have cuts, each for itself, and straightens all charts.
/// `charts` are per mesh, as Assets::meshes.
CutScene cutScene(const Scene& scene, const std::vector<MeshCharts>& charts, const SceneCuts& cuts);

} // namespace limn
