// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

namespace limn {

/// The entry for no overlay in lists of overlays.
inline constexpr OverlayKind kNoOverlay = {
    .name = "none", .label = "No overlay", .tooltip = "The picture alone"};

/// The list of overlays, for the bar above the picture.
void overlayCombo(EditorState& state, float width);

/// Shows the overlay's parameter, the meaning of its colours, and details of what is picked. Draws
/// into the current window. Precondition: an overlay is shown.
void overlayPanel(EditorState& state);

/// Sets what the overlay is made of. What was picked of the same technique is replaced by the
/// nearest thing of the same kind.
void setOverlaySource(OverlayState& overlay, std::shared_ptr<const OverlaySource> source,
                      std::shared_ptr<const Scene> scene);

/// Picks a cache, or whatever the source has, to show and to describe; a number out of range clears
/// the pick.
void pickNumber(OverlayState& overlay, std::uint32_t number);

/// Picks what lights the surface under the mouse; keeps the old pick if there is none.
void pickAt(EditorState& state, glm::vec2 mouse);

/// Picks what lights the active object once it has become active while an overlay of whole objects
/// is shown. Call each frame.
void followSelection(EditorState& state);

/// Shows what the overlay says in colours as numbers, beside the mouse. Draws into the current
/// window. Reads the surface again only where mouse, camera, overlay or light has changed.
void overlayNumbers(EditorState& state);

} // namespace limn
