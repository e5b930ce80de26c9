// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/techniques/illuminance/shared_bake.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace limn {

inline std::shared_ptr<const Bake> bakeOf(const TraceScene& trace) {
    return sharedBake(trace);
}

/// A bake whose surfels are lit at their middles alone, as those of older transport files are.
inline std::shared_ptr<const Bake> bakeOfMiddles(const TraceScene& trace) {
    Bake made = *bakeOf(trace);
    made.surfels.lightPoints.clear();
    made.surfels.lightNormals.clear();
    return std::make_shared<const Bake>(std::move(made));
}

/// A scene with its bake, lit until bounces change nothing, in 3 bands.
struct Relit {
    explicit Relit(const Scene& scene) : trace(scene) { relighter.relight(scene, trace, 64); }

    /// Of bounced light, at a cache's own place.
    double irradiance(std::uint32_t cache) const {
        return double(shIrradiance(3, relighter.cacheSh().data() + std::size_t(9) * cache,
                                   caches.normal[cache])
                          .x);
    }

    TraceScene trace;
    std::shared_ptr<const Bake> baked = bakeOf(trace);
    const Caches& caches = baked->caches;
    Relighter relighter{baked};
};

} // namespace limn
