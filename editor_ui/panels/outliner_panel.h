// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <set>
#include <string>

namespace limn {

struct EditorState;

struct OutlinerState {
    std::string filter;
    std::set<ObjectId> collapsed; ///< nodes whose children are not listed
    std::set<std::string> closed; ///< headings of sections that are not listed
    ObjectId renaming = 0;
    std::string newName;
    bool focusName = false;
    ObjectId anchor = 0;   ///< start of a Shift-click range
    ObjectId revealed = 0; ///< the last active object scrolled to
};

/// The tree of nodes, then lights, materials, cameras, sky and bake settings, with a filter box.
/// Draws into the current window.
void outlinerPanel(EditorState& state);

} // namespace limn
