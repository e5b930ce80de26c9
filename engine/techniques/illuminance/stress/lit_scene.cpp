// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/lit_scene.h"
#include "engine/techniques/illuminance/bake/baker.h"

#include <utility>

namespace limn {

RelitState lightOf(const Relighter& relighter, const RelightStats& stats) {
    return {relighter.radiosity(), relighter.cacheSh(), relighter.field(), stats};
}

RelitState lightOf(const std::shared_ptr<const Bake>& bake, const Scene& scene,
                   const TraceScene& trace, std::uint32_t bounces, const Progress& progress) {
    Relighter relighter(bake);
    const RelightStats stats = relighter.relight(scene, trace, bounces, progress);
    return lightOf(relighter, stats);
}

Result<LitScene> bakeAndLight(const Scene& scene, const Progress& progress) {
    LitScene lit{scene, std::make_shared<const TraceScene>(scene), nullptr, {}};
    Result<Bake> made = bake(*lit.trace, progress);
    if (!made)
        return tl::make_unexpected(made.error());
    lit.bake = std::make_shared<const Bake>(std::move(*made));
    lit.light = lightOf(lit.bake, scene, *lit.trace, scene.relight.maxBounces, progress);
    if (progress.cancelled())
        return fail("cancelled");
    return lit;
}

} // namespace limn
