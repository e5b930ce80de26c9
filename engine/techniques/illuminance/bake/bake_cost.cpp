// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/bake_cost.h"

#include "engine/lightmap/atlas_stage.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/techniques/illuminance/bake/bake_prediction.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limn {

static constexpr std::array kQuantities = {
    &BakeWork::triangles, &BakeWork::surfels, &BakeWork::texels, &BakeWork::lampTexels,
    &BakeWork::grid,      &BakeWork::rays,    &BakeWork::leaves, &BakeWork::links,
    &BakeWork::bands,     &BakeWork::chroma,  &BakeWork::bytes};

BakeWork BakeWork::operator*(const BakeWork& factor) const {
    BakeWork product;
    for (const auto q : kQuantities)
        product.*q = this->*q * factor.*q;
    return product;
}

BakeWork BakeWork::operator/(const BakeWork& divisor) const {
    BakeWork quotient;
    for (const auto q : kQuantities)
        quotient.*q = divisor.*q > 0 ? this->*q / divisor.*q : 1;
    return quotient;
}

BakeWork expectedWork(const Scene& scene) {
    const BakeSettings& s = scene.bake;
    const BakePrediction p = predictBake(scene);
    const int bands = receiverBands(scene, int(s.bands));
    const auto texels = double(p.caches - p.gridCaches);
    BakeWork work{.surfels = double(s.surfels),
                  .texels = texels,
                  .lampTexels = refinesNearLamps(scene) ? texels : 0,
                  .grid = double(p.gridCaches),
                  .rays = double(s.rays),
                  .leaves = p.leaves,
                  .links = p.links,
                  .bands = double(bands),
                  .chroma = double(std::min(chromaBandsOf(s), std::uint32_t(bands))),
                  .bytes = double(p.bytes.total())};
    for (const Instance& i : scene.instances)
        work.triangles += double(scene.meshOf(i).triangleCount());
    return work;
}

BakeWork workOf(const Bake& bake, BakeWork expected) {
    expected.surfels = double(bake.surfels.size());
    expected.texels = double(bake.caches.lightmapCount);
    expected.grid = double(bake.caches.size() - bake.caches.lightmapCount);
    expected.links = double(bake.caches.linkCount());
    expected.bytes = double(bytesOf(bake).total());
    return expected;
}

// The weights are microseconds of one thread of the machine that they were measured on; only their
// ratios matter. They were fitted to bakes of Cornell, atrium and Sponza with a quarter to four
// times the surfels, rays, links and texels of draft (`limn bench predict`).

double stageWork(std::string_view stage, const BakeWork& w) {
    if (stage == "charts")
        return 29 * w.texels + 70 * w.lampTexels + 4 * w.triangles;
    if (stage == "surfels")
        return 8 * w.surfels + 0.5 * w.triangles;
    if (stage == "caches") {
        // One ray in 16 looks for the surfels' places, and none in quick bakes.
        const double looks = w.rays < 128 ? 0 : std::min(w.rays / 16, 32.);
        return 25 * w.surfels + 2.5 * w.triangles + w.caches() * (5 + 2 * looks);
    }
    if (stage == "trace") // 40 more rays find walls and lamps; a finer tree is a little deeper
        return w.caches() * (w.rays + 40) * std::pow(w.surfels, 0.06);
    if (stage == "training")
        return std::pow(w.surfels, 0.9);
    if (stage == "cut")
        return w.caches() * (9.6 + 0.65 * w.leaves) + 0.3 * w.links + 6.1 * w.surfels;
    return w.surfels;
}

double updateWork(std::string_view step, const BakeWork& w) {
    const double texels = w.texels / std::max(w.caches(), 1.); // the grid is lit where it is read
    if (step == "cache_light")
        return w.links * texels * (3 + 0.3 * w.bands * w.bands + 0.15 * w.chroma * w.chroma);
    if (step == "field")
        return w.texels * w.bands * w.bands;
    return w.surfels;
}

} // namespace limn
