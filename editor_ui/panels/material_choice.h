// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <optional>
#include <vector>

namespace limn {

struct EditorState;

/// Rows of the inspector that show and assign the material of `nodes`, or only of one mesh of them
/// (an index into Assets::meshes): a list of the document's materials, and buttons that add one.
void materialChoice(EditorState& state, const std::vector<ObjectId>& nodes,
                    std::optional<std::uint32_t> mesh = {});

/// Lets the last item, a material's row in the list of objects, be dragged onto objects.
void dragMaterial(EditorState& state, ObjectId material);

/// Makes the last item a place where a dragged material can be dropped. Returns the material in the
/// frame in which that happens, else 0.
ObjectId droppedMaterial();

} // namespace limn
