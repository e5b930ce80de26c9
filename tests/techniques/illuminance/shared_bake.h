// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

namespace limn {

/// The bake of a scene, which a test program makes once for all scenes of the same inputs. Tests of
/// the baker itself make their own.
inline std::shared_ptr<const Bake> sharedBake(const TraceScene& trace,
                                              const BakeSettings& settings) {
    static std::map<std::uint64_t, std::shared_ptr<const Bake>> bakes;
    Scene scene = trace.scene();
    scene.bake = settings;
    std::shared_ptr<const Bake>& kept = bakes[bakeInputHash(scene)];
    if (!kept) {
        Result<Bake> made = bake(trace, {}, nullptr, &settings);
        EXPECT_TRUE(made) << (made ? "" : made.error().message);
        kept = std::make_shared<const Bake>(made ? std::move(*made) : Bake{});
    }
    return kept;
}

inline std::shared_ptr<const Bake> sharedBake(const TraceScene& trace) {
    return sharedBake(trace, trace.scene().bake);
}

} // namespace limn
