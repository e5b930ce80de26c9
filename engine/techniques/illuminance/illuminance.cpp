// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/illuminance.h"

#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/illuminance/cpu_illuminance.h"
#include "engine/techniques/illuminance/format/bake_file.h"
#include "engine/techniques/illuminance/overlay/overlay.h"

#include <utility>

namespace limn {

static Result<std::shared_ptr<const Precomputed>> wrapped(Result<Bake> bake) {
    if (!bake)
        return tl::make_unexpected(bake.error());
    return std::make_shared<const BakedIlluminance>(std::make_shared<const Bake>(std::move(*bake)));
}

static Result<std::shared_ptr<const Precomputed>>
prepare(const TraceScene& trace, const PrepareOptions& options, const Progress& progress) {
    return wrapped(bake(trace, progress, options.store, options.settings, options.memory));
}

static Result<std::shared_ptr<const Precomputed>> read(const std::string& path,
                                                       const MemoryBudget& memory) {
    return wrapped(readBake(path, memory));
}

static std::unique_ptr<Lighting> light(const Prepared& prepared) {
    return std::make_unique<CpuIlluminance>(bakeOf(*prepared.data), prepared.scene);
}

static constexpr Precomputation kPrecomputation = {.fileMark = kBakeMark,
                                                   .version = kBakerVersion,
                                                   .inputHash = bakeInputHash,
                                                   .predict = predictIlluminance,
                                                   .preview = previewSettings,
                                                   .prepare = prepare,
                                                   .read = read};

constinit const Technique kIlluminanceTechnique = {
    .name = "illuminance",
    .label = "Illuminance composition",
    .summary = "Surfels light clusters, clusters light caches of spherical harmonics through "
               "precomputed links. Needs a bake; every light then moves freely",
    .source =
        "Jendersie, Kuri, Grosch. Real-Time Global Illumination Using Precomputed Illuminance "
        "Composition with Chrominance Compression. 2016",
    .settings = {},
    .overlays = std::span(kOverlays).subspan(1), // Overlay::None is nobody's
    .precomputation = &kPrecomputation,
    .light = light};

} // namespace limn
