// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

namespace limn {

struct EditorState;
struct FieldEdit;

/// Properties of the active object. Draws into the current window.
void inspectorPanel(EditorState& state);

/// Sections of the inspector, one per kind of object; `edit` is of that object.
void nodeSection(FieldEdit& edit, Node& node);
void lightSection(FieldEdit& edit, Light& light);
void materialSection(FieldEdit& edit, Material& material);
void skySection(FieldEdit& edit, Sky& sky);
void cameraSection(FieldEdit& edit, Camera& camera);
void bakeSection(FieldEdit& edit, BakeSettings& settings);
void techniqueSection(FieldEdit& edit, TechniqueChoice& choice);
void relightSection(FieldEdit& edit, RelightSettings& settings);

} // namespace limn
