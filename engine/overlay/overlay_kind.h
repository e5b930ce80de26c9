// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace limn {

/// Whether an overlay shows one picked thing, such as one light cache.
enum class OverlayPick : std::uint8_t { None, Optional, Required };

/// An overlay that can be drawn over a picture to inspect what a technique computed. Techniques
/// list theirs; menus, --overlay and the overlay panel read the lists.
struct OverlayKind {
    const char* name; ///< on the command line
    const char *label, *tooltip;
    bool showsLight = false;     ///< needs the light, not only what was precomputed
    bool showsMaterials = false; ///< changes with the materials of the scene
    bool hasDepth = false;       ///< OverlayRequest::depth applies
    OverlayPick pick = OverlayPick::None;
    bool ofObject = false;        ///< shows the whole object that what is picked belongs to
    bool describesPick = false;   ///< what is picked is described in words below the legend
    const char* picked = "Cache"; ///< name of the things that are picked
    const char* pickedTooltip =
        "Number of the cache shown; -1: none picked. Lightmap texels first, "
        "then the grid's cells";
};

/// An overlay with its parameters.
struct OverlayRequest {
    const OverlayKind* kind = nullptr; ///< null: none
    std::uint32_t depth = 6;           ///< of a tree, where the kind has one; 0: the root
    std::uint32_t pick = ~0u;          ///< number of what is picked; ~0: nothing

    bool operator==(const OverlayRequest&) const = default;
};

/// A line of what is told about a picked thing.
struct OverlayLine {
    enum class Style : std::uint8_t { Plain, Heading, Separator } style = Style::Plain;
    std::string text;         ///< empty for Separator
    const char* tooltip = ""; ///< empty: none
};

} // namespace limn
