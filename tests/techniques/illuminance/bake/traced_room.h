// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/grid_placement.h"
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/charts.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/rays/trace_stage.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace limn {

/// A bake of a small scene up to what its caches see: 1 500 surfels, 300 texels unless told
/// otherwise, eight grid caches, 256 rays.
struct TracedRoom {
    static constexpr glm::uvec3 kGrid{2};
    Scene scene;
    TraceScene trace;
    SurfelSet set;
    ClusterTree tree;
    CachePoints points;
    Caches caches; ///< without links
    GatherHits hits;
    glm::uvec2 lightmap{0}; ///< texels

    explicit TracedRoom(Scene s, std::uint32_t texels = 300)
        : scene(std::move(s)), trace(scene), set(placeSurfels(scene, 1500)),
          tree(buildClusterTree(scene, set)) {
        scene.bake.lightmapCaches = texels;
        std::vector<MeshCharts> charts;
        for (const Mesh& m : scene.assets->meshes)
            charts.push_back(buildCharts(m));
        const Atlas atlas = buildAtlas(scene, std::move(charts), scene.bake);
        lightmap = {atlas.layout.width, atlas.layout.height};
        caches = placeCaches(scene, atlas, points);
        addGridCaches(kGrid, gridBoundsOf(scene), caches, points);
        const OwnerTables owners(scene, set);
        EXPECT_TRUE(
            traceHits({trace, set, owners, caches, points, Linker::Gather, 256, hashMeshes(scene)},
                      {}, nullptr, hits));
    }
};

} // namespace limn
