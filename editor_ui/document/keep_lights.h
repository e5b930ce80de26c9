// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <functional>

namespace limn {

/// Switches off the lights and the sky of `scene`, which was flattened from `document`, for whose
/// ids `keep` is false.
void keepLights(Scene& scene, const Document& document, const std::function<bool(ObjectId)>& keep);

} // namespace limn
