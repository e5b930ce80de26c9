// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <set>

namespace limn {

/// Whether an object can be muted: a light, the sky, or a node, which has meshes or none.
bool canMute(const Object& object);

/// Shows the scene without what `muted` names: lights and the sky send no light, and the surfaces
/// of nodes reflect nothing diffusely. Neither geometry nor what emits changes, so a bake stays up
/// to date. `scene` was flattened from `document`.
void applyMuted(Scene& scene, const Document& document, const std::set<ObjectId>& muted);

} // namespace limn
