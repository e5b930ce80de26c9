// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/sparse_probes.h"

#include "engine/techniques/sparse_probes/prepared_sparse.h"
#include "engine/techniques/sparse_probes/sparse_lighting.h"
#include "engine/techniques/sparse_probes/sparse_overlay.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace limn {

static Result<std::shared_ptr<const Precomputed>> wrapped(Result<SparseBake> bake) {
    if (!bake)
        return tl::make_unexpected(bake.error());
    return std::make_shared<const PreparedSparse>(
        std::make_shared<const SparseBake>(std::move(*bake)));
}

static Result<std::shared_ptr<const Precomputed>>
prepare(const TraceScene& trace, const PrepareOptions& options, const Progress& progress) {
    return wrapped(bakeSparse(trace, options, progress));
}

static Result<std::shared_ptr<const Precomputed>> read(const std::string& path,
                                                       const MemoryBudget& memory) {
    return wrapped(readSparse(path, memory));
}

static BakeSettings preview(BakeSettings settings) {
    settings.rays = std::min(settings.rays, 64U);
    return settings;
}

static std::unique_ptr<Lighting> light(const Prepared& prepared) {
    assert(&prepared.data->technique() == &kSparseProbesTechnique);
    return std::make_unique<SparseLighting>(
        static_cast<const PreparedSparse&>(*prepared.data).bake(), *prepared.scene);
}

static constexpr Precomputation kPrecomputation = {.fileMark = kSparseMark,
                                                   .inputHash = sparseInputHash,
                                                   .predict = predictSparse,
                                                   .preview = preview,
                                                   .prepare = prepare,
                                                   .read = read};

constinit const Technique kSparseProbesTechnique = {
    .name = "sparse-probes",
    .label = "Sparse probes",
    .summary = "Few probes hold the radiance around them; precomputed matrices make of it the "
               "irradiance of lightmap texels. Needs a bake; every light then moves freely",
    .source = "Silvennoinen, Lehtinen. Real-time Global Illumination by Precomputed Local "
              "Reconstruction from Sparse Radiance Probes. 2017",
    .settings = kSparseSettings,
    .overlays = kSparseOverlays,
    .precomputation = &kPrecomputation,
    .light = light};

} // namespace limn
