// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/fitted_layout.h"

#include "editor_ui/jobs/scene_changes.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <map>
#include <utility>

namespace limn {

/// Layout of `scene`'s instances in the atlas of `baked`. Instances unknown to `baked` have no
/// place.
static LightmapLayout layoutFor(const Scene& scene, const Scene& baked,
                                const LightmapLayout& layout) {
    LightmapLayout fitted = layout;
    fitted.instances.assign(scene.instances.size(), {});
    fitted.meshes.resize(std::max(fitted.meshes.size(), scene.assets->meshes.size()));
    std::map<std::pair<ObjectId, std::uint32_t>, std::size_t> known;
    for (std::size_t i = 0; i < baked.instances.size(); ++i)
        known.emplace(std::pair(baked.instances[i].node, baked.instances[i].mesh), i);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (const auto found = known.find({scene.instances[i].node, scene.instances[i].mesh});
            found != known.end())
            fitted.instances[i] = layout.instances[found->second];
    return fitted;
}

std::shared_ptr<const LightmapLayout> layoutOf(const Scene& scene, const BakedScene& baked) {
    const Technique* technique = findTechnique(scene.technique.technique);
    if (!technique || !technique->precomputation)
        return std::make_shared<const LightmapLayout>(layoutWithoutLightmap(scene));
    if (!baked.bake)
        return nullptr;
    if (sameInstanceList(scene, *baked.scene)) // a pointer into the bake, which it keeps alive
        return {baked.bake, &baked.bake->layout()};
    return std::make_shared<const LightmapLayout>(
        layoutFor(scene, *baked.scene, baked.bake->layout()));
}

} // namespace limn
