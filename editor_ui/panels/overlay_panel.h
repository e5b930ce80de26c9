// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

namespace limn {

/// The entry for no overlay in lists of overlays.
inline constexpr OverlayKind kNoOverlay = {
    .name = "none", .label = "No overlay", .tooltip = "The picture alone"};

/// The list of overlays, for the bar above the picture.
void overlayCombo(EditorState& state, float width);

/// Shows the overlay's parameter, the meaning of its colours, and details of a picked cache. Draws
/// into the current window. Precondition: an overlay is shown.
void overlayPanel(EditorState& state);

/// Sets the bake that the overlay shows. A picked cache is replaced by the nearest one of the same
/// kind.
void setOverlayBake(OverlayState& overlay, std::shared_ptr<const Precomputed> bake,
                    std::shared_ptr<const Scene> scene);

/// Picks a cache to show and to describe; an index out of range clears the pick.
void pickCache(OverlayState& overlay, std::uint32_t cache);

/// Picks the cache that lights the surface under the mouse; keeps the old one if there is none.
void pickCacheAt(EditorState& state, glm::vec2 mouse);

} // namespace limn
