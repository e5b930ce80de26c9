// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <cstdint>
#include <span>
#include <string>

#include <glm/vec4.hpp>

namespace limn {

/// A lightmap whose texels are weighted means of texels of a bake's lightmap.
struct TransportLightmap {
    std::uint32_t width = 0, height = 0; ///< texels, at most 65536 each
    /// Per texel, row by row from the top, the texels y * width + x of the bake's lightmap that it
    /// is made of, and their weights, >= 0, of sum 1, or all 0 where no chart lies.
    std::span<const glm::uvec4> texel;
    std::span<const glm::vec4> weight;
};

/// What a transport file is made of.
struct TransportInput {
    const Bake& bake;
    const Scene& scene; ///< the baked one; gives lights, materials and sky to start with
    /// Null: the bake's own lightmap, whose texels are looked up by LightmapLayout::snaps.
    const TransportLightmap* lightmap = nullptr;
    std::string program; ///< name and version of what writes the file, for its receipt
    /// Rounds links to a third fewer bits, by roundLinks(), so that the file compresses better.
    bool roundedLinks = false;
};

/// Writes the relightable transport file that docs/transport-format.md specifies: the bake's
/// senders, receivers and links, the static surfaces as occluders, and the scene's own lights,
/// albedo, emission and sky to start with. The same input gives the same bytes. Dynamic objects are
/// left out: they are the application's to draw, and neither cast shadows nor occlude links. Fails
/// where the bake does not fit the scene, has links that are not cones, or where the lightmap names
/// a texel without cache.
Result<std::string> transportFile(const TransportInput& input);

} // namespace limn
