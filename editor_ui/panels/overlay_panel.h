// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

namespace limn {

/// The list of overlays, for the bar above the picture.
void overlayCombo(EditorState& state);

/// The overlay's parameter, what its colours mean, and all about a picked cache. Draws into the
/// current window. Precondition: one is shown.
void overlayPanel(EditorState& state);

/// The overlay shows this bake from now on. A picked cache stays picked by its place.
void setOverlayBake(OverlayState& overlay, std::shared_ptr<const Bake> bake,
                    std::shared_ptr<const Scene> scene);

/// Picks a cache for the link cut; one that does not exist: none.
void pickCache(OverlayState& overlay, std::uint32_t cache);

/// Picks the cache that lights the surface under the mouse; keeps the old one where there is none.
void pickCacheAt(EditorState& state, glm::vec2 mouse);

} // namespace limn
