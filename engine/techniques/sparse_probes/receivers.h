// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// The lightmap texels that receive light. Structure of arrays.
struct Receivers {
    std::vector<std::uint32_t> texel;    ///< y * width + x, ascending
    std::vector<std::uint32_t> instance; ///< of Scene::instances
    /// The texel's point next to the middle of them all: triangle of the instance's mesh, and
    /// barycentrics with weights (1-u-v, u, v).
    std::vector<std::uint32_t> triangle;
    std::vector<glm::vec2> barycentric;
    std::vector<std::uint8_t> back; ///< 1: the texel is of the back of a two-sided surface
    std::vector<float> width;       ///< of the texel [m], > 0

    std::size_t size() const { return texel.size(); }
    bool operator==(const Receivers&) const = default;
};

Receivers placeReceivers(const Scene& scene, const Atlas& atlas);

/// Where the receivers lie, one entry each.
struct ReceiverPoints {
    std::vector<glm::vec3> position; ///< world
    std::vector<glm::vec3> normal;   ///< unit, interpolated, on the side that receives
};
ReceiverPoints pointsOf(const Scene& scene, const Receivers& receivers);

/// Finds the receiver whose texel contains a point of a surface.
class ReceiverAt {
public:
    static constexpr std::uint32_t kNone = ~0U;

    /// Keeps a reference to `layout`.
    ReceiverAt(const LightmapLayout& layout, const Receivers& receivers);

    /// kNone for the back of a one-sided surface and for an instance without lightmap.
    std::uint32_t operator()(const Scene& scene, const Hit& hit) const;

private:
    const LightmapLayout& m_layout;
    std::vector<std::uint32_t> m_receiverOf; ///< per texel
};

} // namespace limn
