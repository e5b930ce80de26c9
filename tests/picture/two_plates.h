// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "tests/trace/simple_scene.h"

#include <cmath>
#include <memory>

#include <glm/gtc/constants.hpp>

namespace limn {

/// The plane y = 0, 4 m wide, facing up, and above it or beside it another plate of 4 m, each with
/// texels of its own: 4 x 4 that are 4/3 m wide, so that what is nearer than 2/3 m is near.
struct TwoPlates {
    static constexpr float kReach = 2.f / 3;

    simple::SceneBuilder builder;
    std::shared_ptr<LightmapLayout> layout = std::make_shared<LightmapLayout>();
    IndirectField field;

    /// Material 0 is the plane's, 1 the plate's.
    explicit TwoPlates(const Mesh& plate, float albedo = 0.5f) {
        builder.addMaterial(simple::lambert(glm::vec3(albedo)));
        builder.addMaterial(simple::lambert(glm::vec3(albedo)));
        builder.add(simple::quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
        builder.add(plate);
        builder.scene.instances[1].material = 1;
        layout->width = 8;
        layout->height = 4;
        const MeshCharts charts{{0, 1, 2, 3}, {0, 1, 2, 0, 2, 3}, {0, 0}, {}, {{4, 4}}};
        layout->meshes = {charts, charts};
        for (const float left : {0.5f, 4.5f}) {
            const float right = left + 3;
            layout->instances.push_back({{{left / 8, 0.5f / 4},
                                          {right / 8, 0.5f / 4},
                                          {right / 8, 3.5f / 4},
                                          {left / 8, 3.5f / 4}},
                                         0});
        }
        field.version = 1;
        field.lightmapWidth = 8;
        field.lightmapHeight = 4;
        field.lightmap.assign(9 * 32, glm::vec4(0));
    }

    /// Gives the back of the plate texels, below those of its front; setField() sets both.
    void addBack() {
        for (InstanceLightmap& instance : layout->instances)
            for (glm::vec2& uv : instance.uv)
                uv.y /= 2;
        layout->instances[1].backRows = layout->height;
        field.lightmapHeight = layout->height *= 2;
        field.lightmap.assign(2 * field.lightmap.size(), glm::vec4(0));
    }

    /// Lets constant radiance arrive from above a surface with unit normal `n`: on the plane
    /// (plate = 0) or on the plate (1).
    void setField(std::uint32_t plate, glm::vec3 n, glm::vec3 radiance) {
        const float pi = glm::pi<float>();
        const glm::vec3 first = pi * std::sqrt(3 / (4 * pi)) * glm::vec3(n.y, n.z, n.x);
        const std::uint32_t texels = field.lightmapWidth * field.lightmapHeight;
        for (std::uint32_t t = 0; t < texels; ++t) {
            const std::uint32_t rows = layout->instances[1].backRows > 0 ? 8 : 4;
            const bool ofPlate = t / 8 < rows && t % 8 >= 4; // finer texels are the plane's
            if (ofPlate != (plate == 1))
                continue;
            field.lightmap[t] = glm::vec4(std::sqrt(pi) * radiance, 0);
            for (std::uint32_t i = 0; i < 3; ++i)
                field.lightmap[(1 + i) * texels + t] = glm::vec4(first[int(i)] * radiance, 0);
        }
    }

    /// Gives the plane texels of a quarter of the width where |x| and |z| are below 2/3 m. Sets the
    /// field to 0.
    void refineMiddle() {
        layout->height = field.lightmapHeight = 4 + kFineCells + 1;
        for (InstanceLightmap& i : layout->instances)
            for (glm::vec2& uv : i.uv)
                uv.y *= 4.f / float(layout->height);
        layout->snaps.assign(8 * layout->height, 0);
        layout->snaps[8 + 1] = kFineLookup + 4 * 8; // a block below the texels of both
        field.lightmap.assign(9 * layout->snaps.size(), glm::vec4(0));
    }
};

/// The plate, facing down, `height` above the plane.
inline Mesh plateAbove(float height) {
    return simple::quad({-2, height, -2}, {4, 0, 0}, {0, 0, 4}, 1);
}

/// The plate as a wall at z = 0, facing +z, that stands on the plane.
inline Mesh wall() {
    return simple::quad({-2, 0, 0}, {4, 0, 0}, {0, 4, 0}, 1);
}

} // namespace limn
