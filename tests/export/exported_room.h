// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/export/export_format.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace limn {

/// A document with its bake, lit until bounces change nothing, to export.
struct ExportedRoom {
    ExportedRoom(Document d, std::shared_ptr<const Assets> a)
        : document(std::move(d)), scene(flatten(document, std::move(a))), trace(scene),
          baked(bakeOf(trace)), relighter(baked) {
        relighter.relight(scene, trace, 64);
    }

    ExportScene view() const {
        return {document, scene, trace, baked->lightmap, relighter.field(), &data};
    }

    Document document;
    Scene scene;
    TraceScene trace;
    std::shared_ptr<const Bake> baked;
    BakedIlluminance data{baked};
    Relighter relighter;

private:
    static std::shared_ptr<const Bake> bakeOf(const TraceScene& trace) {
        Result<Bake> made = bake(trace);
        EXPECT_TRUE(made) << made.error().message;
        return std::make_shared<const Bake>(std::move(*made));
    }
};

} // namespace limn
