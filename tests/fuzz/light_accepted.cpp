// SPDX-License-Identifier: MIT
// What replays do with accepted scenes and bakes: they bake and light them.
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/trace/trace_scene.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/small_bake.h"

#include <memory>

namespace limn {

static bool allFinite(const std::vector<glm::vec4>& values) {
    return std::ranges::all_of(values, [](const glm::vec4& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    });
}

static void light(const Scene& scene, const TraceScene& trace, Bake bake) {
    Relighter relighter(std::make_shared<const Bake>(std::move(bake)));
    relighter.relight(scene, trace, 2);
    require(allFinite(relighter.field().lightmap), "the light of a lightmap is finite");
    require(allFinite(relighter.field().grid), "the light of a grid is finite");
}

void light(const Scene& scene, const Bake& bake) {
    light(scene, TraceScene(scene), bake);
}

void bakeAndLight(const Scene& scene) {
    constexpr std::size_t kMaxTriangles = 2000; // bakes of more rightly take long
    std::size_t triangles = 0;
    for (const Instance& instance : scene.instances)
        triangles += scene.meshOf(instance).triangleCount();
    if (triangles > kMaxTriangles)
        return;
    const TraceScene trace(scene);
    const BakeSettings settings = smallBake();
    if (Result<Bake> made = bake(trace, {}, nullptr, &settings, kFuzzMemory))
        light(scene, trace, std::move(*made));
}

} // namespace limn
