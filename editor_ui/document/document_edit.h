// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/document/gesture.h"

#include <glm/mat4x4.hpp>

namespace limn {

struct EditorState;

/// Does and records an edit of the document. An edit without changes is ignored.
void applyEdit(EditorState& state, Edit edit);

/// Each of these functions is one undo step. Where it does not apply, it changes and records
/// nothing.

/// Adds `light` under a name no other light has, and selects it.
ObjectId addLight(EditorState& state, Light light);

/// The same, and makes `sky` that of the document where it is another.
void addLightAndSky(EditorState& state, Light light, const Sky& sky);

/// Gives the sky the kind, the image and the panorama of `image`.
void setSkyImage(EditorState& state, const Sky& image);

/// Makes the sun of the sky's panorama a light, as extractSun() does. False if it has none.
bool extractSkySun(EditorState& state);

/// Gives a point or spot light the profile of a photometric file and its intensity. Other lights
/// become points.
void setLightProfile(EditorState& state, ObjectId light, const LightProfile& profile);

/// Makes `settings` those of the document. Records nothing where they are already.
void setExportSettings(EditorState& state, const ExportSettings& settings);

/// Makes these the document's bake settings, if they differ; `label` names the edit.
void setBakeSettings(EditorState& state, const BakeSettings& settings, const char* label);

/// Deletes the selected nodes (with everything below them), lights and cameras.
void deleteSelection(EditorState& state);

/// Copies of objects, under ids that the document has not given yet.
struct Copies {
    ObjectsById objects;
    std::vector<ObjectId> tops; ///< those that are below no other copy
};

/// `wanted`, or it with the first number that makes it no other object's name.
std::string freeName(const Document& document, const std::string& wanted);

/// Copies of `originals`, which need not be in the document, under names of their own. Nodes stand
/// below the copies of their parents, else below their own.
Copies copiesOf(const Document& document, const ObjectsById& originals);

/// Copies of the selected nodes (with everything below them), lights and cameras.
Copies copiesOfSelection(const EditorState& state);

/// Copies the selected nodes (with everything below them), lights and cameras, and selects the
/// copies.
void duplicateSelection(EditorState& state);

/// Hides the selected nodes and turns off the selected lights, or turns all on if all are off.
void toggleHidden(EditorState& state);
void showAll(EditorState& state);

/// Hides all nodes that carry meshes except the selected ones and those below or above them. If
/// that is done already, shows those again that it hid.
void toggleIsolated(EditorState& state);

/// Whether some of what toggleIsolated() hid is still hidden.
bool isIsolated(const EditorState& state);

/// Makes the selected nodes dynamic, or static if all of them are dynamic.
void toggleDynamic(EditorState& state);

/// Renames an object. An empty or unchanged name is ignored.
void rename(EditorState& state, ObjectId id, const std::string& name);

bool undoEdit(EditorState& state);
bool redoEdit(EditorState& state);

/// Object-to-world matrix of a node, including its parents, as in the flattened scene.
glm::mat4 worldMatrix(const Document& document, ObjectId node);

} // namespace limn
