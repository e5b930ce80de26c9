// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/field/indirect_field.h"
#include "engine/final_lightmap/cut_scene.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/export_settings.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// The light from which a final lightmap is gathered.
struct FinalLightmapInput {
    const TraceScene& trace;
    const LightmapLayout& layout; ///< of the fields; its charts are cut for the final lightmap
    const IndirectField& field;   ///< converged light
    const IndirectField& emitted; ///< Lighting::emittedField(), or a field without any light
};

struct FinalLightmapOptions {
    std::uint32_t texels = 1; ///< about the number of texels, > 0
    /// Longest side of a chart, or of the whole lightmap if it is to be one page [texels]. There
    /// are as many fewer texels as that takes.
    std::uint32_t maxSide = 1U << 14;
    bool onePage = false;
    LightmapQuantity quantity = LightmapQuantity::Irradiance; ///< of a single band
    bool direct = false; ///< adds the direct light of the scene's lights
    /// 1: texels hold the quantity; 2 or 3: harmonics of incident radiance, whose irradiance at the
    /// surface's normal is that of the map with a single band.
    std::uint32_t bands = 1;
    /// Cuts charts into pieces of different density, so that the map belongs to a mesh with more
    /// triangles.
    bool cutCharts = true;
    std::uint32_t raysPerSample = 4, seed = 1;
};

/// A lightmap for programs that look up texels bilinearly and know nothing of
/// LightmapLayout::snaps.
struct FinalLightmap {
    CutScene cut;          ///< whose meshes the layout is of
    LightmapLayout layout; ///< without snaps
    /// Index of the texel at y * width + x, kNoTexel where no lookup reads any.
    std::vector<std::uint32_t> texelAt;
    std::uint32_t layers = 1; ///< number of coefficients
    /// Value of texel t in layer l at values[l * texels + t].
    std::vector<glm::vec3> values;
    std::uint64_t samples = 0; ///< number of samples that were gathered

    std::size_t texels() const { return values.size() / layers; }
};

/// Backs that face sealed dark space get no texels, and points in it have no weight (dark_backs.h).
/// Gathers light at points on the lit surface under each texel (gather_texels.h) and fits the
/// texels to it, so that what a plain bilinear lookup shows has the least squared error
/// (fit_texels.h). Returns std::nullopt when cancelled.
std::optional<FinalLightmap> makeFinalLightmap(const FinalLightmapInput& input,
                                               const FinalLightmapOptions& options,
                                               const Progress& progress);

} // namespace limn
