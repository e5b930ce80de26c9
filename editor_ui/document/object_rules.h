// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <string>

namespace limn {

/// True if every number is finite and in the range its header states. Widgets that produce anything
/// else are undone.
bool isValid(const Object& object);

/// Only nodes, lights and cameras come and go; meshes name materials by their order.
bool canDelete(const Object& object);

/// The name, or null for objects without one.
std::string* nameOf(Object& object);

/// Name of a kind of light for users: "Spot light".
const char* lightKindName(LightKind kind);

/// "Node", "Point light", "Material", ...
const char* kindName(const Object& object);

} // namespace limn
