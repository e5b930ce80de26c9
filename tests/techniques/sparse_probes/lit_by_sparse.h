// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/sparse_probes/prepared_sparse.h"
#include "engine/techniques/sparse_probes/sparse_probes.h"
#include "tests/techniques/room_with_lamps.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>

namespace limn {

/// A scene with sparse probes, quickly precomputed.
struct LitBySparse {
    Scene scene;
    std::shared_ptr<const TraceScene> trace;
    Prepared prepared;
    std::unique_ptr<Lighting> lighting;

    explicit LitBySparse(Scene s, std::map<std::string, double> settings = {},
                         std::uint32_t texels = 1500)
        : scene(std::move(s)) {
        settings.try_emplace("sparse-probes.count", 27);
        settings.try_emplace("sparse-probes.cells", 12);
        scene.technique = {"sparse-probes", std::move(settings)};
        scene.bake.lightmapCaches = texels;
        scene.bake.rays = 128;
        trace = std::make_shared<const TraceScene>(scene);
        const auto made = kSparseProbesTechnique.precomputation->prepare(*trace, {}, {});
        if (!made) {
            ADD_FAILURE() << made.error().message;
            return;
        }
        prepared = {*made, std::make_shared<const Scene>(scene)};
        lighting = kSparseProbesTechnique.light(prepared);
    }
    LightingReport update(std::uint32_t bounces = 64) {
        return lighting->update({.scene = scene, .trace = trace.get(), .bounces = bounces}, {});
    }
    const SparseBake& bake() const {
        return *static_cast<const PreparedSparse&>(*prepared.data).bake();
    }
    const std::vector<glm::vec4>& lightmap() const { return lighting->field()->lightmap; }
    /// Irradiance of a receiver.
    glm::vec3 ofReceiver(std::size_t r) const {
        return glm::vec3(lightmap()[bake().receivers.texel[r]]) *
               float(std::sqrt(std::numbers::pi) / 2);
    }
    /// Mean irradiance of all receivers, by area.
    glm::dvec3 mean() const {
        glm::dvec3 sum(0);
        double area = 0;
        for (std::size_t r = 0; r < bake().receivers.size(); ++r) {
            const double a = std::pow(double(bake().receivers.width[r]), 2);
            sum += glm::dvec3(ofReceiver(r)) * a;
            area += a;
        }
        return sum / area;
    }
};

} // namespace limn
