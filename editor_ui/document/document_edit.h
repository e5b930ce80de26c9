// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <glm/mat4x4.hpp>

namespace limn {

struct EditorState;

/// Each of these is one undo step; nothing happens, and nothing is recorded, where it does not
/// apply.

/// Adds `light` under a name no other light has, and selects it.
ObjectId addLight(EditorState& state, Light light);

/// Gives the sky the kind, the image and the panorama of `image`.
void setSkyImage(EditorState& state, const Sky& image);

/// Deletes the selected nodes (with everything below them), lights and cameras.
void deleteSelection(EditorState& state);

/// Copies them, nodes with everything below, and selects the copies.
void duplicateSelection(EditorState& state);

/// Turns visibility (nodes) or light (lights) of the selection off, or on where all of it is off.
void toggleHidden(EditorState& state);
void showAll(EditorState& state);

/// An empty or unchanged name is ignored.
void rename(EditorState& state, ObjectId id, const std::string& name);

bool undoEdit(EditorState& state);
bool redoEdit(EditorState& state);

/// Drops ids from the selection that the document no longer has.
void pruneSelection(EditorState& state);

/// Object to world of a node, through its parents, as in the flattened scene.
glm::mat4 worldMatrix(const Document& document, ObjectId node);

/// Where the gizmo stands: the mean of the places of the selected nodes, lights and cameras. False:
/// nothing to move.
bool selectionOrigin(const EditorState& state, glm::vec3& origin);

/// The object displaced in world space by `d`. Nodes are moved in their parent's space.
Object displaced(const Document& document, const Object& object, glm::vec3 d);

/// The selected objects the gizmo moves: a node whose ancestor is selected moves with it and is
/// left out.
std::map<ObjectId, Object> movableSelection(const EditorState& state);

/// World box of the selection (or of the scene when nothing placed is selected). A light is a
/// point.
Bounds selectionBounds(const EditorState& state);

} // namespace limn
