// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <set>

namespace limn {

/// Leaves on, of the scene's lights and its sky, those whose ids are in `solo`; all if none of the
/// document's is. Emissive surfaces stay on: a bake depends on which surfaces emit. `scene` was
/// flattened from `document`.
void applySolo(Scene& scene, const Document& document, const std::set<ObjectId>& solo);

} // namespace limn
