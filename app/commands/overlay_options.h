// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"
#include "engine/core/result.h"
#include "engine/json/json.h"
#include "engine/lighting/overlay_source.h"
#include "engine/lighting/technique.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace limn {

/// Flags that select the overlay drawn over a picture.
struct OverlayFlags {
    std::string name = "none";
    std::optional<std::uint32_t> depth, cache;
    std::vector<std::uint32_t> pick; ///< x, y [pixels]; empty: none

    bool wanted() const { return name != "none"; }
};
void addOverlayFlags(Command& command, OverlayFlags& flags);

/// Fails if a flag does not apply to the named overlay or a flag that it needs is missing.
Result<void> checkOverlayFlags(const OverlayFlags& flags);

/// The overlay that `flags` select; null: none.
const OverlayKind* overlayKindOf(const OverlayFlags& flags);

/// Fails if the overlay is not one of that technique's.
Result<void> checkOverlayTechnique(const OverlayFlags& flags, const Technique& technique);

/// The overlay of `source` that `flags` select. Precondition: checkOverlayFlags() succeeded. Fails
/// if there is no such number, or nothing to pick at the pixel of a picture of that size.
Result<OverlayRequest> overlayRequest(const OverlayFlags& flags, const OverlaySource& source,
                                      const TraceScene& trace, const Camera& camera,
                                      std::uint32_t width, std::uint32_t height);

/// Title, colours as #rrggbb with their meaning, and notes.
Json legendJson(const OverlayLegend& legend);
std::string legendText(const OverlayLegend& legend);

} // namespace limn
